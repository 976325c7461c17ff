// The lattices, each as one table: the points of a cell, and the tets that belong to it. Whatever lays out, counts or
// numbers tets reads these tables and knows no lattice by name.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "base/tet_geometry.h"
#include "lattice/lattice_frame.h"
#include "tetsoup/lattice.h"

namespace tetsoup {

inline constexpr std::size_t kMostTetsPerCell = 12;
inline constexpr std::size_t kMostPointsPerCell = 2;
inline constexpr int kStepsPerCell = 2;  ///< The tables' unit of length: all points lie at halves of a cell.

using Steps = std::array<int, 3>;

/// A tet's corner: a point of the tet's own cell, or of one that lies one cell up along some axes.
struct LatticeCorner {
  std::array<std::uint8_t, 3> cell{};  ///< 0 or 1 along x, y, z.
  std::uint8_t point = 0;              ///< Which of the cell's points.
  bool operator==(const LatticeCorner&) const = default;
};
using LatticeTet = std::array<LatticeCorner, 4>;

struct LatticeTable {
  std::size_t point_count = 0;  ///< Points a cell,
  std::array<Steps, kMostPointsPerCell> points{};
  std::size_t tet_count =
      0;  ///< and tets a cell: those of even and of odd cells, by the sum of the cell's coordinates.
  std::array<std::array<LatticeTet, kMostTetsPerCell>, 2> tets{};
  std::array<std::uint16_t, kMostTetsPerCell> beside{};  ///< Bit u of entry t: tets t and u of a cell share a face.
  std::array<double, kMostTetsPerCell> volume{};         ///< In cells; the same in odd ones.
  int reach = 0;         ///< Steps: the tets of a cell lie within [0, reach] of its lower corner, along every axis.
  double mean_edge = 0;  ///< Of the lattice's edges, in cells.

  const LatticeTet& tet(std::size_t t, bool odd) const { return tets[odd][t]; }
  Steps steps(const LatticeCorner& corner) const {
    Steps at = points[corner.point];
    for (std::size_t i = 0; i < 3; ++i) at[i] += kStepsPerCell * corner.cell[i];
    return at;
  }
  /// In cells, relative to the tet's cell.
  Vec3d position(const LatticeCorner& corner) const {
    const Steps at = steps(corner);
    return {at[0] * (1.0 / kStepsPerCell), at[1] * (1.0 / kStepsPerCell), at[2] * (1.0 / kStepsPerCell)};
  }
  TetCorners corners(std::size_t t, bool odd) const {
    const LatticeTet& tet = tets[odd][t];
    return {position(tet[0]), position(tet[1]), position(tet[2]), position(tet[3])};
  }
  std::uint16_t all_tets() const { return static_cast<std::uint16_t>((1U << tet_count) - 1); }
};

const LatticeTable& lattice_table(LatticeKind kind);

}  // namespace tetsoup
