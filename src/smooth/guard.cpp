#include "smooth/guard.h"

#include <algorithm>
#include <cmath>

#include "base/elementary.h"

namespace tetsoup {

namespace {

constexpr double kVolumeShare = 0.05;  // Of its first volume a tet keeps at least this much: crumbs stall a simulation.
constexpr double kShortestMove = 0.05;  // Of the way: shorter moves are not worth their tests.
constexpr double kMargin = 1e-9;        // Relative, and radians: another formula for a limit finds it kept, too.

/// What the limits are compared with. Cosines are squared, so that the loop over the tets needs no root.
struct Shape {
  double acute = 0, obtuse = 0;  ///< Largest squared cosine of the acute angles, and of the obtuse ones.
  double edge_ratio = 0;         ///< Squared.
};

Shape shape_of(const TetCorners& p) {
  const Vec3d ab = p[1] - p[0], ac = p[2] - p[0], ad = p[3] - p[0], bc = p[2] - p[1], bd = p[3] - p[1];
  const std::array<Vec3d, 4> normal{cross(bc, bd), cross(ad, ac), cross(ab, ad), cross(ac, ab)};
  std::array<double, 4> square{};
  for (std::size_t i = 0; i < 4; ++i) square[i] = 1 / squared_length(normal[i]);
  Shape shape;
  for (const auto& [i, j] : kTetEdges) {
    const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
    const double product = dot(normal[a], normal[b]);
    const double cosine = product * product * (square[a] * square[b]);
    if (product < 0) {
      shape.acute = std::max(shape.acute, cosine);
    } else {
      shape.obtuse = std::max(shape.obtuse, cosine);
    }
  }
  const std::array<double, 6> edges{squared_length(ab), squared_length(ac), squared_length(ad),
                                    squared_length(bc), squared_length(bd), squared_length(p[3] - p[2])};
  const auto [shortest, longest] = std::minmax_element(edges.begin(), edges.end());
  shape.edge_ratio = *longest / *shortest;
  return shape;
}

}  // namespace

GuardedMesh::GuardedMesh(const TetMesh& start, const Connectivity& links, const ShapeLimits& limits,
                         std::span<const Vec3> sided)
    : start_(start), links_(links), mesh_(start), sheets_(links, start), sided_(sided, start, links) {
  const double min_cosine = elementary::cos(limits.min_dihedral + kMargin),
               max_cosine = elementary::cos(limits.max_dihedral - kMargin);
  const double ratio = limits.max_edge_ratio * (1 - kMargin);
  if (!start.tets.empty()) {
    const TetCorners p = corners_of(start, start.tets[0]);
    to_unit_ = 1 / elementary::nearest_power_of_two(length(p[1] - p[0]));
  }
  limits_.reserve(start.tets.size());
  for (std::size_t t = 0; t < start.tets.size(); ++t) {
    TetCorners p = corners_of(start, start.tets[t]);
    for (Vec3d& corner : p) corner = corner * to_unit_;
    const Shape shape = shape_of(p);
    limits_.push_back({kVolumeShare * start_volume(t) * to_unit_ * to_unit_ * to_unit_,
                       std::max(min_cosine * min_cosine, shape.acute), std::max(max_cosine * max_cosine, shape.obtuse),
                       std::max(ratio * ratio, shape.edge_ratio)});
  }
}

bool GuardedMesh::is_sound(std::size_t tet) const {
  TetCorners p = corners_of(mesh_, mesh_.tets[tet]);
  for (Vec3d& corner : p) corner = corner * to_unit_;
  const Limit& limit = limits_[tet];
  const double volume = signed_volume(p);
  if (!(volume > limit.volume) || !std::isfinite(volume)) return false;
  const Shape shape = shape_of(p);
  return shape.acute <= limit.square_cosine_of_min && shape.obtuse <= limit.square_cosine_of_max &&
         shape.edge_ratio <= limit.square_edge_ratio;
}

bool GuardedMesh::surroundings_are_sound(std::uint32_t vertex) const {
  const auto around = links_.tets[vertex];
  return std::all_of(around.begin(), around.end(), [&](std::uint32_t tet) { return is_sound(tet); });
}

bool GuardedMesh::move(std::uint32_t vertex, const Vec3d& target) {
  const Vec3 before = mesh_.vertices[vertex];
  const Vec3d from = to_double(before), way = target - from;
  const bool on_boundary = !links_.boundary_triangles[vertex].empty();
  for (double share = 1; share > kShortestMove; share /= 2) {
    mesh_.vertices[vertex] = to_float(from + way * share);
    if (share == 1 && mesh_.vertices[vertex] == before) return true;
    if (!surroundings_are_sound(vertex)) continue;
    if (on_boundary && !sheets_.allow(vertex, before, mesh_)) continue;
    if (!sided_.empty() && !sided_.are_kept(vertex, before, mesh_)) continue;
    if (share < 1) ++shortened_moves_;
    return share == 1;
  }
  mesh_.vertices[vertex] = before;
  ++shortened_moves_;
  return false;
}

double GuardedMesh::min_dihedral() const {
  double cosine = -1;
  for (std::size_t t = 0; t < mesh_.tets.size(); ++t) {
    const auto cosines = dihedral_cosines(corners_of(mesh_, mesh_.tets[t]));
    cosine = std::max(cosine, *std::max_element(cosines.begin(), cosines.end()));
  }
  return mesh_.tets.empty() ? 0 : elementary::acos(cosine);
}

}  // namespace tetsoup
