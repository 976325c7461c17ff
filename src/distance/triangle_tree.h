// A tree of boxes over the triangles, for the nearest one to any point.
#pragma once

#include <algorithm>
#include <span>

#include "base/box_hierarchy.h"

namespace tetsoup {

/// A box is skipped only if it is farther than the best by more than rounding, so that no exact nearest is lost.
inline constexpr float kSlack = 1.0F + 0x1p-14F;
inline constexpr float kSlackAbsolute = 1e-6F;  // voxels squared

inline float squared_distance_to(const Vec3& lo, const Vec3& hi, float x, float y, float z) {
  const float dx = std::max({lo.x - x, x - hi.x, 0.0F});
  const float dy = std::max({lo.y - y, y - hi.y, 0.0F});
  const float dz = std::max({lo.z - z, z - hi.z, 0.0F});
  return dx * dx + dy * dy + dz * dz;
}

/// A binary tree over the triangles in Morton order.
class TriangleTree {
 public:
  /// Keeps references. Corners are in voxels.
  TriangleTree(std::span<const Triangle> triangles, std::span<const Vec3> corners, StageWatch& watch);

  /// Squared distance to the nearest triangle if that is below `bound`, else some value not below `bound`.
  /// The same bits as the least of kernel::squared_distance over all triangles.
  float nearest_squared(float x, float y, float z, float bound) const;

 private:
  float squared_distance(std::size_t triangle, float x, float y, float z, float bound) const;

  std::span<const Triangle> triangles_;
  std::span<const Vec3> corners_;
  BoxHierarchy tree_;
};

}  // namespace tetsoup
