#include "lattice/lattice_table.h"

#include <algorithm>
#include <numbers>

#include "lattice/five_tets.h"

namespace tetsoup {
namespace {

LatticeCorner cube_corner(unsigned corner) {
  return {{static_cast<std::uint8_t>(corner & 1U), static_cast<std::uint8_t>(corner >> 1 & 1U),
           static_cast<std::uint8_t>(corner >> 2 & 1U)},
          0};
}

std::size_t shared_corners(const LatticeTet& a, const LatticeTet& b) {
  return static_cast<std::size_t>(
      std::count_if(a.begin(), a.end(), [&](const LatticeCorner& c) { return std::count(b.begin(), b.end(), c) > 0; }));
}

/// What follows from the points and the tets of even cells.
LatticeTable completed(LatticeTable table) {
  for (std::size_t t = 0; t < table.tet_count; ++t) {
    table.volume[t] = signed_volume(table.corners(t, false));
    for (std::size_t u = 0; u < table.tet_count; ++u)
      if (shared_corners(table.tets[0][t], table.tets[0][u]) == 3)
        table.beside[t] = static_cast<std::uint16_t>(table.beside[t] | 1U << u);
    for (const LatticeCorner& corner : table.tets[0][t])
      for (const int at : table.steps(corner)) table.reach = std::max(table.reach, at);
  }
  return table;
}

/// A point at the cubes' corners; in every other cube the tets are mirrored, so that the diagonals on shared faces
/// match.
LatticeTable make_five() {
  LatticeTable table;
  table.point_count = 1;
  table.tet_count = kTetsPerCell;
  table.mean_edge = (1 + std::numbers::sqrt2) / 2;  // as many edges of the cubes as diagonals
  for (const bool odd : {false, true})
    for (std::size_t t = 0; t < kTetsPerCell; ++t)
      for (std::size_t i = 0; i < 4; ++i) table.tets[odd][t][i] = cube_corner(tet_corners(t, odd)[i]);
  return completed(table);
}

/// Points at the cubes' corners and centres; a tet spans two centres beside each other and an edge of the face between
/// them: to every cell belong the four tets about each of its three upper faces.
LatticeTable make_bcc() {
  LatticeTable table;
  table.point_count = 2;
  table.points[1] = {1, 1, 1};
  table.tet_count = 12;
  table.mean_edge = (3 + 2 * std::numbers::sqrt3) / 7;  // six edges of length 1 and eight of sqrt(3) / 2 a cell
  constexpr std::array<unsigned, 5> kAround{0b00, 0b01, 0b11, 0b10, 0b00};  // corners of a face, counter-clockwise
  for (std::size_t axis = 0; axis < 3; ++axis) {
    LatticeCorner above{{}, 1};
    above.cell[axis] = 1;
    const auto on_face = [&](unsigned corner) {
      LatticeCorner c = cube_corner(1U << axis);
      c.cell[(axis + 1) % 3] = static_cast<std::uint8_t>(corner & 1U);
      c.cell[(axis + 2) % 3] = static_cast<std::uint8_t>(corner >> 1);
      return c;
    };
    for (std::size_t side = 0; side < 4; ++side)
      table.tets[0][4 * axis + side] = {LatticeCorner{{}, 1}, on_face(kAround[side]), on_face(kAround[side + 1]),
                                        above};
  }
  table.tets[1] = table.tets[0];
  return completed(table);
}

}  // namespace

const LatticeTable& lattice_table(LatticeKind kind) {
  static const LatticeTable five = make_five(), bcc = make_bcc();
  return kind == LatticeKind::Bcc ? bcc : five;
}

}  // namespace tetsoup
