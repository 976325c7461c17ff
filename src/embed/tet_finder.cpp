#include "embed/tet_finder.h"

#include <algorithm>
#include <cmath>

#include "base/tet_faces.h"

namespace tetsoup {
namespace {

/// Least weight of a point well inside of a tet: a point on a face that two tets share has 0 in both, within rounding.
constexpr double kWellInside = 1e-3;

/// Edges of a tet: what enclosing and smoothing take for inside stays inside.
constexpr double kOnFace = 5e-5;

/// Squared distances that differ by less, relative to themselves, are of one corner or edge seen from two triangles.
constexpr double kSameDistance = 1e-6;

/// Slots of the boundary; of a mesh without any (every tet twice), of all faces.
std::vector<std::uint64_t> surface_slots(const TetMesh& mesh) {
  const std::vector<TetFace> faces = sorted_faces(mesh);
  std::vector<std::uint64_t> slots = lone_slots(faces);
  if (slots.empty())
    for (const TetFace& face : faces) slots.push_back(face.slot);
  return slots;
}

TriangleSoup surface_of(const TetMesh& mesh, const std::vector<std::uint64_t>& slots) {
  TriangleSoup soup{mesh.vertices, {}};
  soup.triangles.reserve(slots.size());
  for (const std::uint64_t slot : slots) soup.triangles.push_back(face_at(mesh, slot));
  return soup;
}

}  // namespace

TetFinder::TetFinder(const TetMesh& mesh, StageWatch& watch)
    : mesh_(mesh),
      locator_(mesh, kOnFace),
      slots_(surface_slots(mesh)),
      boundary_(surface_of(mesh, slots_)),
      boxes_(boundary_, watch) {
  faces_.reserve(slots_.size());
  for (std::uint32_t t = 0; t < slots_.size(); ++t) {
    Face face{boxes_.corners_in_unit(t), {}, 0};
    const auto& [a, b, c] = face.corners;
    face.centre = (a + b + c) * (1.0 / 3);
    face.radius = std::sqrt(
        std::max({squared_length(a - face.centre), squared_length(b - face.centre), squared_length(c - face.centre)}));
    faces_.push_back(face);
  }
}

std::uint32_t TetFinder::holder(const Vec3d& point) const {
  std::uint32_t first = kNone;
  locator_.visit_holders(point, [&](std::uint32_t tet) { first = std::min(first, tet); });
  return first;
}

bool TetFinder::is_in_several(const Vec3d& point) const {
  int count = 0;
  locator_.visit_holders(point, [&](std::uint32_t tet) {
    count += least_weight(corners_of(mesh_, mesh_.tets[tet]), point) > kWellInside;
  });
  return count > 1;
}

std::uint32_t TetFinder::nearest(const Vec3d& point, std::uint32_t& near) const {
  const Vec3d p = boxes_.to_unit(point);
  const auto square_to = [&](std::uint32_t t) { return squared_length(p - closest_on_triangle(faces_[t].corners, p)); };
  const auto tet_of = [&](std::uint32_t t) { return static_cast<std::uint32_t>(slots_[t] / 4); };
  const auto least = [&](std::uint32_t t) { return least_weight(corners_of(mesh_, mesh_.tets[tet_of(t)]), point); };
  std::uint32_t best = near;
  double square = square_to(near);
  double within = 0;
  float bound = 0;
  const auto take = [&](std::uint32_t t, double to_t) {
    best = t;
    square = to_t;
    within = std::sqrt(to_t) * (1 + kSameDistance);
    bound = TriangleBoxes::bound_above(square * (1 + 2 * kSameDistance));
  };
  take(near, square);
  boxes_.visit_near(to_float(p), bound, [&](std::uint32_t t) {
    const double reach = faces_[t].radius + within;
    if (squared_length(p - faces_[t].centre) > reach * reach) return;
    const double to_t = square_to(t);
    if (t == best || !(to_t <= square * (1 + kSameDistance))) return;
    if (to_t >= square * (1 - kSameDistance)) {
      const double of_t = least(t), of_best = least(best);
      if (of_t < of_best || (of_t == of_best && t > best)) return;
    }
    take(t, std::min(square, to_t));
  });
  near = best;
  return tet_of(best);
}

}  // namespace tetsoup
