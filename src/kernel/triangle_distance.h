// Distance from points to one triangle, in voxel units.
#pragma once

#include <algorithm>
#include <array>
#include <span>

#include "base/vec.h"

namespace tetsoup::kernel {

/// What the distance to a triangle needs, computed once in double precision. Degenerate triangles are their segment or
/// point: the face never wins there.
struct TrianglePlan {
  std::array<Vec3, 3> corner;
  std::array<Vec3, 3> edge;                  ///< From corner i to corner i + 1.
  std::array<float, 3> inverse_edge_square;  ///< 0 for an edge without length.
  std::array<Vec3, 3> inward;                ///< Unit normal of edge i in the triangle's plane, towards the inside.
  Vec3 normal;                               ///< Unit; zero for a triangle without area.
  float face_bias = 0;                       ///< 0; larger than any square for a triangle without area.
};

inline TrianglePlan plan_triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
  constexpr float kNever = 1e30F;  // voxels squared
  TrianglePlan plan;
  plan.corner = {a, b, c};
  const std::array<Vec3d, 3> p{to_double(a), to_double(b), to_double(c)};
  const Vec3d n = cross(p[1] - p[0], p[2] - p[0]);
  const double n_length = length(n);
  const bool has_area = n_length > 0;
  const Vec3d unit = has_area ? n * (1 / n_length) : Vec3d{};
  plan.normal = to_float(unit);
  plan.face_bias = has_area ? 0 : kNever;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3d e = p[(i + 1) % 3] - p[i];
    const double square = squared_length(e);
    plan.edge[i] = to_float(e);
    plan.inverse_edge_square[i] = square > 0 ? static_cast<float>(1 / square) : 0;
    plan.inward[i] = has_area ? to_float(cross(unit, e) * (1 / std::sqrt(square))) : Vec3{};
  }
  return plan;
}

/// Squared distance from (x, y, z) to the triangle: the least over its three edges and, above its inside, its plane.
inline float squared_distance(const TrianglePlan& t, float x, float y, float z) {
  float best = 1e30F;
  float inside = 1e30F;
  for (std::size_t i = 0; i < 3; ++i) {
    const float px = x - t.corner[i].x, py = y - t.corner[i].y, pz = z - t.corner[i].z;
    const Vec3& e = t.edge[i];
    float s = (px * e.x + py * e.y + pz * e.z) * t.inverse_edge_square[i];
    s = s < 0 ? 0 : s;
    s = s > 1 ? 1 : s;
    const float dx = px - s * e.x, dy = py - s * e.y, dz = pz - s * e.z;
    const float square = dx * dx + dy * dy + dz * dz;
    best = square < best ? square : best;
    const float side = px * t.inward[i].x + py * t.inward[i].y + pz * t.inward[i].z;
    inside = side < inside ? side : inside;
  }
  const float height =
      (x - t.corner[0].x) * t.normal.x + (y - t.corner[0].y) * t.normal.y + (z - t.corner[0].z) * t.normal.z;
  const float face = height * height + t.face_bias;
  const float candidate = inside >= 0 ? face : best;
  return candidate < best ? candidate : best;
}

/// row[i] = min(row[i], squared distance from (x0 + i, y, z)).
void lower_row(const TrianglePlan& t, int x0, int y, int z, std::span<float> row);

}  // namespace tetsoup::kernel
