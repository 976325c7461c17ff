#include "smooth/guard.h"

#include <algorithm>
#include <cmath>

namespace tetsoup {

namespace {

constexpr double kVolumeShare = 0.05;  // Of its first volume a tet keeps at least this much: crumbs stall a simulation.
constexpr double kShortestMove = 0.05;  // Of the way: shorter moves are not worth their tests.
constexpr double kFloorMargin = 1e-9;   // Radians above the floor, so that another formula for the angle finds it kept.

double largest_cosine(const TetCorners& p) {
  const auto cosines = dihedral_cosines(p);
  return *std::max_element(cosines.begin(), cosines.end());
}

}  // namespace

GuardedMesh::GuardedMesh(const TetMesh& start, const Connectivity& links, double min_dihedral)
    : start_(start), links_(links), mesh_(start) {
  const double floor = std::cos(min_dihedral + kFloorMargin);
  limits_.reserve(start.tets.size());
  for (std::size_t t = 0; t < start.tets.size(); ++t) {
    limits_.push_back({kVolumeShare * start_volume(t), std::max(floor, largest_cosine(corners(start, t)))});
  }
}

TetCorners GuardedMesh::corners(const TetMesh& mesh, std::size_t tet) {
  const Tet& v = mesh.tets[tet];
  return {to_double(mesh.vertices[v[0]]), to_double(mesh.vertices[v[1]]), to_double(mesh.vertices[v[2]]),
          to_double(mesh.vertices[v[3]])};
}

bool GuardedMesh::is_sound(std::size_t tet) const {
  const TetCorners p = corners(mesh_, tet);
  const double volume = signed_volume(p);
  return volume > limits_[tet].volume && std::isfinite(volume) && largest_cosine(p) <= limits_[tet].cosine;
}

bool GuardedMesh::surroundings_are_sound(std::uint32_t vertex) const {
  const auto around = links_.tets[vertex];
  return std::all_of(around.begin(), around.end(), [&](std::uint32_t tet) { return is_sound(tet); });
}

bool GuardedMesh::move(std::uint32_t vertex, const Vec3d& target) {
  const Vec3 before = mesh_.vertices[vertex];
  const Vec3d from = to_double(before), way = target - from;
  for (double share = 1; share > kShortestMove; share /= 2) {
    mesh_.vertices[vertex] = to_float(from + way * share);
    if (share == 1 && mesh_.vertices[vertex] == before) return true;
    if (!surroundings_are_sound(vertex)) continue;
    if (share < 1) ++shortened_moves_;
    return share == 1;
  }
  mesh_.vertices[vertex] = before;
  ++shortened_moves_;
  return false;
}

double GuardedMesh::min_dihedral() const {
  double cosine = -1;
  for (std::size_t t = 0; t < mesh_.tets.size(); ++t) cosine = std::max(cosine, largest_cosine(corners(mesh_, t)));
  return mesh_.tets.empty() ? 0 : std::acos(cosine);
}

}  // namespace tetsoup
