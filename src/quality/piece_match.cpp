#include "quality/piece_match.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "base/groups.h"
#include "base/tet_locator.h"
#include "base/unions.h"
#include "quality/surface_cells.h"

namespace tetsoup {

namespace {

/// Over the soup's longest side: what is closer than a cell hangs together. A mesh of one piece needs to know less.
constexpr double kCellsAlong = 256, kCellsOfOne = 128;
constexpr std::size_t kAsked = 48;  ///< Places of a piece that are asked.
constexpr double kReach = 0.75;     ///< Edges; as for what is lost.
constexpr double kSpeck = 0.75;     ///< Edges; pieces of a soup smaller than that are not told to be joined or lost.
constexpr std::uint32_t kNone = ~0U;

struct Nearest {
  std::uint32_t triangle = kNone;
  double distance = 0;
};

Nearest nearest(const TriangleBoxes& boxes, const Vec3d& at) {
  const Vec3d p = boxes.to_unit(at);
  Nearest found{boxes.any(), 0};
  double least = squared_length(closest_on_triangle(boxes.corners_in_unit(found.triangle), p) - p);
  float best = TriangleBoxes::bound_above(least);
  boxes.visit_near(to_float(p), best, [&](std::uint32_t t) {
    const double square = squared_length(closest_on_triangle(boxes.corners_in_unit(t), p) - p);
    if (square < least) least = square, found.triangle = t, best = TriangleBoxes::bound_above(square);
  });
  found.distance = std::sqrt(least) / boxes.scale();
  return found;
}

/// Up to kAsked members of a group, evenly spread.
template <class Members, class Visit>
void visit_some(const Members& members, const Visit& visit) {
  const std::size_t count = std::min(members.size(), kAsked);
  for (std::size_t i = 0; i < count; ++i) visit(members[i * members.size() / count]);
}

/// What most of the votes are for; the lowest where several have as many.
std::uint32_t most_of(const std::map<std::uint32_t, std::size_t>& votes) {
  std::uint32_t winner = kNone;
  std::size_t most = 0;
  for (const auto& [choice, count] : votes)
    if (count > most) winner = choice, most = count;
  return winner;
}

struct SoupPieces {
  std::vector<std::uint32_t> of_part;
  std::uint32_t count = 0;
  std::vector<SurfaceCell> cells;
};

SoupPieces find_soup_pieces(const TriangleSoup& soup, const SoupFacts& facts, double cells_along) {
  const Box3 box = box_of(soup.vertices);
  double cell = std::max({box.hi.x - box.lo.x, box.hi.y - box.lo.y, box.hi.z - box.lo.z}) / cells_along;
  SoupPieces pieces;
  pieces.cells = find_surface_cells(soup, facts.part, cell);
  std::uint32_t groups = 0;
  const std::vector<std::uint32_t> label = label_cells(pieces.cells, groups);
  Unions joined(facts.parts + groups);
  for (std::size_t i = 0; i < pieces.cells.size(); ++i)
    joined.join(facts.part[pieces.cells[i].triangle], facts.parts + label[i]);
  pieces.of_part.resize(facts.parts);
  for (std::uint32_t p = 0; p < facts.parts; ++p)
    pieces.of_part[p] = joined.find(p) == p ? pieces.count++ : pieces.of_part[joined.find(p)];
  return pieces;
}

double extent(std::span<const std::uint32_t> members, const std::vector<SurfaceCell>& cells) {
  Vec3d lo = cells[members[0]].at, hi = lo;
  for (const std::uint32_t i : members) lo = min(lo, cells[i].at), hi = max(hi, cells[i].at);
  return length(hi - lo);
}

}  // namespace

void match_pieces(const TetMesh& mesh, const MeshSkin& skin, const TriangleBoxes& of_skin, const TriangleSoup& soup,
                  const SoupFacts& facts, const TriangleBoxes& of_soup, Fidelity& found) {
  found.soup_pieces = 1;
  if (facts.parts <= 1) return void(found.torn_pieces = skin.pieces > 1 ? skin.pieces - 1 : 0);
  const SoupPieces pieces = find_soup_pieces(soup, facts, skin.pieces > 1 ? kCellsAlong : kCellsOfOne);
  found.soup_pieces = pieces.count;
  const auto piece_of = [&](std::uint32_t triangle) { return pieces.of_part[facts.part[triangle]]; };

  const Groups<std::uint32_t> tets(skin.pieces, [&](const auto& put) {
    for (std::uint32_t t = 0; t < mesh.tets.size(); ++t)
      if (is_valid_tet(mesh.tets[t], mesh.vertices.size())) put(skin.piece[t], t);
  });
  std::vector<std::uint32_t> stands_for;  // of every piece of the mesh
  std::vector<char> taken(pieces.count, 0);
  for (std::size_t p = 0; p < skin.pieces; ++p) {
    std::map<std::uint32_t, std::size_t> votes;
    visit_some(tets[p], [&](std::uint32_t t) {
      const TetCorners c = corners_of(mesh, mesh.tets[t]);
      ++votes[piece_of(nearest(of_soup, (c[0] + c[1] + c[2] + c[3]) * 0.25).triangle)];
    });
    stands_for.push_back(most_of(votes));
    found.torn_pieces += taken[stands_for.back()] != 0 ? 1 : 0;
    taken[stands_for.back()] = 1;
  }
  if (pieces.count <= 1) return;
  const Groups<std::uint32_t> cells(pieces.count, [&](const auto& put) {
    for (std::uint32_t i = 0; i < pieces.cells.size(); ++i) put(piece_of(pieces.cells[i].triangle), i);
  });
  std::optional<TetLocator> locator;  // made for the few that lie deep in the mesh or are lost
  for (std::uint32_t p = 0; p < pieces.count; ++p) {
    const auto members = cells[p];
    if (members.empty() || extent(members, pieces.cells) < kSpeck * found.mean_edge) continue;
    std::map<std::uint32_t, std::size_t> votes;
    std::size_t far = 0, held = 0, asked = 0;
    visit_some(members, [&](std::uint32_t i) {
      const Nearest near = nearest(of_skin, pieces.cells[i].at);
      ++asked;
      if (near.distance > kReach * found.mean_edge) {
        if (!locator) locator.emplace(mesh);
        bool inside = false;
        locator->visit_holders(pieces.cells[i].at, [&](std::uint32_t) { inside = true; });
        return void(++(inside ? held : far));
      }
      ++votes[skin.piece[skin.triangle_tet[near.triangle]]];
    });
    if (2 * far > asked) {
      ++found.lost_pieces;
    } else if (2 * held < asked && stands_for[most_of(votes)] != p) {
      ++found.joined_pieces;
    }
  }
}

}  // namespace tetsoup
