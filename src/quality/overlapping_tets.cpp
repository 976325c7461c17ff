#include "quality/overlapping_tets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/groups.h"
#include "base/parallel.h"
#include "base/vec.h"

namespace tetsoup {

namespace {

constexpr double kDepth = 1e-3;  ///< Mean edges: tets that reach into each other by less only touch.

struct Body {
  TetCorners at;
  Vec3d lo, hi;
  bool counts = false;
};

/// How far the tets reach into each other along an axis; negative where it parts them.
double depth_along(const Vec3d& axis, const TetCorners& a, const TetCorners& b) {
  const auto range = [&](const TetCorners& p) {
    std::array<double, 4> x{dot(axis, p[0]), dot(axis, p[1]), dot(axis, p[2]), dot(axis, p[3])};
    return std::minmax({x[0], x[1], x[2], x[3]});
  };
  const auto [a_low, a_high] = range(a);
  const auto [b_low, b_high] = range(b);
  return std::min(a_high - b_low, b_high - a_low);
}

bool parted_by(const Vec3d& axis, const TetCorners& a, const TetCorners& b, double depth) {
  const double size = length(axis);
  return size > 0 && depth_along(axis, a, b) <= depth * size;
}

bool parted_by_faces(const TetCorners& of, const TetCorners& a, const TetCorners& b, double depth) {
  for (const auto& f : kTetFaces) {
    const Vec3d p = of[static_cast<std::size_t>(f[0])];
    if (parted_by(cross(of[static_cast<std::size_t>(f[1])] - p, of[static_cast<std::size_t>(f[2])] - p), a, b, depth))
      return true;
  }
  return false;
}

bool overlap(const TetCorners& a, const TetCorners& b, double depth, double edge) {
  if (parted_by_faces(a, a, b, depth) || parted_by_faces(b, a, b, depth)) return false;
  constexpr double kParallel = 1e-6;  // sine below which two edges span no plane
  for (const auto& [i, j] : kTetEdges) {
    for (const auto& [k, l] : kTetEdges) {
      const Vec3d axis = cross(a[static_cast<std::size_t>(j)] - a[static_cast<std::size_t>(i)],
                               b[static_cast<std::size_t>(l)] - b[static_cast<std::size_t>(k)]);
      if (length(axis) > kParallel * edge * edge && parted_by(axis, a, b, depth)) return false;
    }
  }
  return true;
}

/// Tets by the cells of a grid that their boxes reach into.
struct Cells {
  Vec3d lo;
  double edge = 1;
  std::array<std::int64_t, 3> count{1, 1, 1};

  std::array<std::int64_t, 3> cell_of(const Vec3d& p) const {
    const auto number = [&](double x, double from, std::int64_t most) {
      return std::clamp(static_cast<std::int64_t>((x - from) / edge), std::int64_t{0}, most - 1);
    };
    return {number(p.x, lo.x, count[0]), number(p.y, lo.y, count[1]), number(p.z, lo.z, count[2])};
  }
  template <class Visit>
  void visit(const Body& body, const Visit& visit) const {
    const auto first = cell_of(body.lo), last = cell_of(body.hi);
    for (std::int64_t z = first[2]; z <= last[2]; ++z)
      for (std::int64_t y = first[1]; y <= last[1]; ++y)
        for (std::int64_t x = first[0]; x <= last[0]; ++x)
          visit(static_cast<std::size_t>((z * count[1] + y) * count[0] + x));
  }
};

Cells lay_cells(const std::vector<Body>& bodies, double edge) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Vec3d lo{kInfinity, kInfinity, kInfinity}, hi = lo * -1;
  for (const Body& body : bodies)
    if (body.counts) lo = min(lo, body.lo), hi = max(hi, body.hi);
  constexpr double kMostCells = 256;  // along a side
  Cells cells{lo, std::max(edge, std::max({hi.x - lo.x, hi.y - lo.y, hi.z - lo.z}) / kMostCells)};
  const auto count = [&](double size) { return static_cast<std::int64_t>(size / cells.edge) + 1; };
  cells.count = {count(hi.x - lo.x), count(hi.y - lo.y), count(hi.z - lo.z)};
  return cells;
}

std::vector<Body> gather(const TetMesh& mesh) {
  std::vector<Body> bodies(mesh.tets.size());
  for (std::size_t t = 0; t < bodies.size(); ++t) {
    if (!is_valid_tet(mesh.tets[t], mesh.vertices.size())) continue;
    const TetCorners p = corners_of(mesh, mesh.tets[t]);
    const double volume = signed_volume(p);
    bodies[t] = {p, min(min(p[0], p[1]), min(p[2], p[3])), max(max(p[0], p[1]), max(p[2], p[3])),
                 volume > 0 && std::isfinite(volume)};
  }
  return bodies;
}

int shared_corners(const Tet& a, const Tet& b) {
  int shared = 0;
  for (const std::uint32_t v : a) shared += std::find(b.begin(), b.end(), v) != b.end() ? 1 : 0;
  return shared;
}

bool boxes_apart(const Body& a, const Body& b, double depth) {
  return a.hi.x - b.lo.x <= depth || b.hi.x - a.lo.x <= depth || a.hi.y - b.lo.y <= depth || b.hi.y - a.lo.y <= depth ||
         a.hi.z - b.lo.z <= depth || b.hi.z - a.lo.z <= depth;
}

}  // namespace

OverlappingTets find_overlapping_tets(const TetMesh& mesh, const MeshSkin& skin) {
  const std::vector<Body> bodies = gather(mesh);
  if (std::none_of(bodies.begin(), bodies.end(), [](const Body& b) { return b.counts; })) return {};
  const Cells cells = lay_cells(bodies, skin.mean_edge);
  const Groups<std::uint32_t> in_cell(static_cast<std::size_t>(cells.count[0] * cells.count[1] * cells.count[2]),
                                      [&](const auto& put) {
                                        for (std::uint32_t t = 0; t < bodies.size(); ++t)
                                          if (bodies[t].counts)
                                            cells.visit(bodies[t], [&](std::size_t cell) { put(cell, t); });
                                      });
  // A pair is looked at where the cell holds the lower corner of what both boxes share.
  const auto tell = [&](std::uint32_t a, std::uint32_t b, std::size_t cell, OverlappingTets& found) {
    const double depth = kDepth * skin.mean_edge;
    if (boxes_apart(bodies[a], bodies[b], depth)) return;
    const auto home = cells.cell_of(max(bodies[a].lo, bodies[b].lo));
    if (static_cast<std::size_t>((home[2] * cells.count[1] + home[1]) * cells.count[0] + home[0]) != cell) return;
    if (shared_corners(mesh.tets[a], mesh.tets[b]) >= 3) return;  // neighbours lie on the two sides of their face
    if (!overlap(bodies[a].at, bodies[b].at, depth, skin.mean_edge)) return;
    ++(skin.piece[a] == skin.piece[b] ? found.in_piece : found.apart);
  };
  const Progress nobody;
  StageWatch watch(nobody, "quality");
  constexpr std::int64_t kGrain = 64;
  const auto count = static_cast<std::int64_t>(in_cell.size());
  std::vector<OverlappingTets> chunks(static_cast<std::size_t>(chunk_count(count, kGrain)));
  parallel_for(count, kGrain, watch, [&](std::int64_t begin, std::int64_t end) {
    for (auto cell = static_cast<std::size_t>(begin); cell < static_cast<std::size_t>(end); ++cell) {
      const auto tets = in_cell[cell];
      for (std::size_t i = 0; i < tets.size(); ++i)
        for (std::size_t j = i + 1; j < tets.size(); ++j)
          tell(tets[i], tets[j], cell, chunks[static_cast<std::size_t>(begin / kGrain)]);
    }
  });
  OverlappingTets all;
  for (const OverlappingTets& chunk : chunks) all.in_piece += chunk.in_piece, all.apart += chunk.apart;
  return all;
}

}  // namespace tetsoup
