// Distance from a point to a triangle's corners, edges and face, in voxel units.
//
// A corner's and an edge's distance depend on their own vertices only, so all triangles that share them agree to the
// bit, and the least over a soup's triangles is the least over its distinct vertices, edges and faces.
#pragma once

#include <algorithm>
#include <array>

#include "base/vec.h"

namespace tetsoup::kernel {

inline constexpr float kBeyond = 1e30F;  ///< Voxels squared; more than any true square.

/// Planned from the lower vertex to the higher one.
struct EdgePlan {
  Vec3 from, along;
  float inverse_square = 0;  ///< 0 for an edge without length, which its corners answer for.
};

/// The inside of a triangle, planned in double precision; a triangle without area has none.
struct FacePlan {
  std::array<Vec3, 3> base;    ///< A point of each edge.
  std::array<Vec3, 3> inward;  ///< Unit normal of each edge in the triangle's plane, towards the inside.
  Vec3 normal;                 ///< Unit.
  bool has_area = false;
};

struct TrianglePlan {
  std::array<Vec3, 3> corner;
  std::array<EdgePlan, 3> edge;
  FacePlan face;
};

inline EdgePlan plan_edge(const Vec3& from, const Vec3& to) {
  const Vec3 along{to.x - from.x, to.y - from.y, to.z - from.z};
  const float square = along.x * along.x + along.y * along.y + along.z * along.z;
  return {from, along, square > 0 ? 1 / square : 0};
}

/// Edges run from a to b, b to c and a to c.
inline FacePlan plan_face(const Vec3& a, const Vec3& b, const Vec3& c) {
  const std::array<Vec3d, 3> along{to_double(b) - to_double(a), to_double(c) - to_double(b),
                                   to_double(c) - to_double(a)};
  const Vec3d n = cross(along[0], along[2]);
  const double n_length = length(n);
  if (!(n_length > 0)) return {};
  const Vec3d unit = n * (1 / n_length);
  const auto inward = [&](std::size_t i, double turn) {
    return to_float(cross(unit, along[i]) * (turn / length(along[i])));
  };
  return {{a, b, a}, {inward(0, 1), inward(1, 1), inward(2, -1)}, to_float(unit), true};
}

inline TrianglePlan plan_triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
  return {{a, b, c}, {plan_edge(a, b), plan_edge(b, c), plan_edge(a, c)}, plan_face(a, b, c)};
}

inline float corner_square(const Vec3& corner, float x, float y, float z) {
  const float dx = x - corner.x, dy = y - corner.y, dz = z - corner.z;
  return dx * dx + dy * dy + dz * dz;
}

/// Squared distance to the edge where the nearest point lies between its ends, else kBeyond.
inline float edge_square(const EdgePlan& e, float x, float y, float z) {
  const float px = x - e.from.x, py = y - e.from.y, pz = z - e.from.z;
  const float s = (px * e.along.x + py * e.along.y + pz * e.along.z) * e.inverse_square;
  const float dx = px - s * e.along.x, dy = py - s * e.along.y, dz = pz - s * e.along.z;
  const float square = dx * dx + dy * dy + dz * dz;
  return ((s > 0) & (s < 1)) ? square : kBeyond;
}

/// Squared distance to the plane where the nearest point lies within the triangle, else kBeyond.
inline float face_square(const FacePlan& f, float x, float y, float z) {
  float inside = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const float side =
        (x - f.base[i].x) * f.inward[i].x + (y - f.base[i].y) * f.inward[i].y + (z - f.base[i].z) * f.inward[i].z;
    inside = side < inside ? side : inside;
  }
  const float height = (x - f.base[0].x) * f.normal.x + (y - f.base[0].y) * f.normal.y + (z - f.base[0].z) * f.normal.z;
  return inside < 0 ? kBeyond : height * height;
}

/// Squared distance from (x, y, z) to the triangle.
inline float squared_distance(const TrianglePlan& t, float x, float y, float z) {
  float best = t.face.has_area ? face_square(t.face, x, y, z) : kBeyond;
  for (std::size_t i = 0; i < 3; ++i) {
    best = std::min(best, corner_square(t.corner[i], x, y, z));
    best = std::min(best, edge_square(t.edge[i], x, y, z));
  }
  return best;
}

}  // namespace tetsoup::kernel
