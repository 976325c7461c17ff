#include "embed/tet_finder.h"

#include <numeric>

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
      boxes_(boundary_, watch) {}

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

std::uint32_t TetFinder::nearest(const Vec3d& point) const {
  std::uint32_t best = kNone;
  double square = std::numeric_limits<double>::infinity(), least = 0;
  std::uint32_t triangle = 0;
  float bound = std::numeric_limits<float>::infinity();
  const Vec3d p = boxes_.to_unit(point);
  boxes_.visit_near(to_float(p), bound, [&](std::uint32_t t) {
    const double to_t = squared_length(p - closest_on_triangle(boxes_.corners_in_unit(t), p));
    if (!(to_t <= square * (1 + kSameDistance))) return;
    const auto tet = static_cast<std::uint32_t>(slots_[t] / 4);
    const double least_t = least_weight(corners_of(mesh_, mesh_.tets[tet]), point);
    const bool is_nearer = to_t < square * (1 - kSameDistance);
    if (!is_nearer && (least_t < least || (least_t == least && t > triangle))) return;
    best = tet;
    square = to_t, least = least_t, triangle = t;
    bound = TriangleBoxes::bound_above(square * (1 + 2 * kSameDistance));
  });
  return best;
}

}  // namespace tetsoup
