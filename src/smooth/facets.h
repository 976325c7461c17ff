// Triangles of the boundary and whether they pass through each other.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "base/vec.h"
#include "tetsoup/types.h"

namespace tetsoup {

using TriangleCorners = std::array<Vec3d, 3>;

inline TriangleCorners corners_at(const TetMesh& mesh, const Triangle& t) {
  return {to_double(mesh.vertices[t[0]]), to_double(mesh.vertices[t[1]]), to_double(mesh.vertices[t[2]])};
}
inline bool is_equal(const Vec3d& a, const Vec3d& b) {
  return a.x == b.x && a.y == b.y && a.z == b.z;
}
inline bool is_corner(const TriangleCorners& t, const Vec3d& p) {
  return is_equal(t[0], p) || is_equal(t[1], p) || is_equal(t[2], p);
}

/// Whether the line from p to q passes through the triangle or touches it.
inline bool is_pierced(const TriangleCorners& t, const Vec3d& p, const Vec3d& q) {
  const Vec3d way = q - p, a = t[0] - p, b = t[1] - p, c = t[2] - p;
  const double u = dot(way, cross(a, b)), v = dot(way, cross(b, c)), w = dot(way, cross(c, a));
  return (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
}

/// A triangle and its normal.
struct BoundaryFacet {
  explicit BoundaryFacet(const TriangleCorners& corners) : at(corners), normal(cross(at[1] - at[0], at[2] - at[0])) {}
  double side(const Vec3d& p) const { return is_corner(at, p) ? 0 : dot(normal, p - at[0]); }
  std::array<double, 3> sides(const BoundaryFacet& other) const {
    return {side(other.at[0]), side(other.at[1]), side(other.at[2])};
  }

  TriangleCorners at;
  Vec3d normal;
};

inline bool is_one_side(const std::array<double, 3>& side) {
  return (side[0] >= 0 && side[1] >= 0 && side[2] >= 0) || (side[0] <= 0 && side[1] <= 0 && side[2] <= 0);
}

/// Whether two triangles pass through each other; touching in corners, or within one plane, is not enough.
inline bool cross_each_other(const BoundaryFacet& s, const BoundaryFacet& t) {
  const auto of_t = s.sides(t);
  if (is_one_side(of_t)) return false;
  const auto of_s = t.sides(s);
  if (is_one_side(of_s)) return false;
  const auto pierces = [](const TriangleCorners& edges, const std::array<double, 3>& side, const TriangleCorners& by) {
    for (std::size_t i = 0, k = 1; i < 3; ++i, k = (k + 1) % 3) {
      if (side[i] * side[k] < 0 && is_pierced(by, edges[i], edges[k])) return true;
    }
    return false;
  };
  return pierces(t.at, of_t, s.at) || pierces(s.at, of_s, t.at);
}

/// The vertices of a vertex's triangles.
struct BoundaryFan {
  std::vector<Vec3d> points;
  Box3 box;
  std::vector<BoundaryFacet> facets;

  /// Whether all of it lies on one side of the facet's plane or on it, or beyond one side of its box.
  bool is_beside(const BoundaryFacet& facet) const {
    const TriangleCorners& t = facet.at;
    const Vec3d lo = min(min(t[0], t[1]), t[2]), hi = max(max(t[0], t[1]), t[2]);
    if (lo.x > box.hi.x || lo.y > box.hi.y || lo.z > box.hi.z) return true;
    if (hi.x < box.lo.x || hi.y < box.lo.y || hi.z < box.lo.z) return true;
    double least = 0, most = 0;
    for (const Vec3d& p : points) {
      const double away = facet.side(p);
      least = std::min(least, away), most = std::max(most, away);
    }
    return least >= 0 || most <= 0;
  }
};

}  // namespace tetsoup
