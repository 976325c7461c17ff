// Rays through a soup's triangles.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "base/box_hierarchy.h"
#include "base/triangle_contact.h"
#include "base/vec.h"

namespace tetsoup {

inline TriangleCorners corners_of(const TriangleSoup& soup, std::uint32_t triangle) {
  const auto [a, b, c] = soup.triangles[triangle];
  return {soup.vertices[a], soup.vertices[b], soup.vertices[c]};
}

/// Calls cross(triangle) for the triangles that a ray from `p` along +x crosses: exactly.
template <class Cross>
void visit_crossed(const TriangleSoup& soup, const BoxHierarchy& tree, const Vec3& p, const Cross& cross) {
  std::array<std::uint32_t, BoxHierarchy::kMaxDepth> stack;
  std::size_t depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const std::uint32_t at = stack[--depth];
    const BoxHierarchy::Node& node = tree.nodes[at];
    if (p.x > node.hi.x || p.y < node.lo.y || p.y > node.hi.y || p.z < node.lo.z || p.z > node.hi.z) continue;
    if (node.count == 0) {
      stack[depth++] = node.next;
      stack[depth++] = at + 1;
    }
    for (std::uint32_t i = node.next; i < node.next + node.count; ++i)
      if (crosses_ahead(corners_of(soup, tree.order[i]), p)) cross(tree.order[i]);
  }
}

/// What stands in `crossed` an odd number of times, ascending.
inline void keep_odd(std::vector<std::uint32_t>& crossed) {
  std::sort(crossed.begin(), crossed.end());
  std::size_t kept = 0;
  for (std::size_t i = 0; i < crossed.size();) {
    std::size_t end = i;
    while (end < crossed.size() && crossed[end] == crossed[i]) ++end;
    if ((end - i) % 2 == 1) crossed[kept++] = crossed[i];
    i = end;
  }
  crossed.resize(kept);
}

/// A ray in double precision.
class Ray {
 public:
  Ray(const Vec3d& from, const Vec3d& direction) : from_(from), direction_(direction) {
    constexpr double kFlat = 1e-30;  // of a direction of length 1: parallel to the box's sides
    const auto invert = [](double d) { return d > kFlat || d < -kFlat ? 1 / d : 1 / kFlat; };
    inverse_ = {invert(direction.x), invert(direction.y), invert(direction.z)};
  }

  /// Where it enters the box; beyond `limit` if it does not before. Never late but for rounding, which the caller's
  /// limit must leave room for.
  double enter(const BoxHierarchy::Node& node, double limit) const {
    double begin = 0, end = limit;
    const auto clip = [&](double lo, double hi, double from, double inverse) {
      const double a = (lo - from) * inverse, b = (hi - from) * inverse;
      begin = std::max(begin, std::min(a, b));
      end = std::min(end, std::max(a, b));
    };
    clip(node.lo.x, node.hi.x, from_.x, inverse_.x);
    clip(node.lo.y, node.hi.y, from_.y, inverse_.y);
    clip(node.lo.z, node.hi.z, from_.z, inverse_.z);
    return begin <= end * (1 + 1e-12) ? begin : 2 * limit + 1;
  }

  /// Where it meets the triangle, edges included; negative if it does not.
  double meet(const TriangleCorners& corners) const {
    constexpr double kRounding = 1e-9;  // so that none slips through between two triangles
    const Vec3d a = to_double(corners[0]), u = to_double(corners[1]) - a, v = to_double(corners[2]) - a;
    const Vec3d p = cross(direction_, v);
    const double det = dot(u, p);
    if (det == 0) return -1;
    const Vec3d to = from_ - a, q = cross(to, u);
    const double s = dot(to, p) / det, t = dot(direction_, q) / det;
    if (!(s >= -kRounding && t >= -kRounding && s + t <= 1 + kRounding)) return -1;
    return dot(v, q) / det;
  }

 private:
  Vec3d from_, direction_, inverse_;
};

/// Calls meet(triangle, distance) for triangles that the ray meets, those of the nearest boxes first; `limit` may fall
/// meanwhile, and what lies beyond it is passed over.
template <class Meet>
void visit_met(const TriangleSoup& soup, const BoxHierarchy& tree, const Ray& ray, const double& limit,
               const Meet& meet) {
  struct Pending {
    std::uint32_t node;
    double distance;
  };
  std::array<Pending, BoxHierarchy::kMaxDepth> stack;
  std::size_t depth = 0;
  stack[depth++] = {0, ray.enter(tree.nodes[0], limit)};
  while (depth > 0) {
    const auto [at, distance] = stack[--depth];
    if (distance > limit) continue;
    const BoxHierarchy::Node& node = tree.nodes[at];
    if (node.count == 0) {
      Pending near{at + 1, ray.enter(tree.nodes[at + 1], limit)},
          far{node.next, ray.enter(tree.nodes[node.next], limit)};
      if (far.distance < near.distance) std::swap(near, far);
      if (far.distance <= limit) stack[depth++] = far;
      if (near.distance <= limit) stack[depth++] = near;
    }
    for (std::uint32_t i = node.next; i < node.next + node.count; ++i) {
      const double to = ray.meet(corners_of(soup, tree.order[i]));
      if (to >= 0 && to <= limit) meet(tree.order[i], to);
    }
  }
}

}  // namespace tetsoup
