// The nearest point of a soup whose triangles are small: by its corners.
#pragma once

#include <span>
#include <vector>

#include "base/box_hierarchy.h"
#include "base/groups.h"

namespace tetsoup {

/// A tree over the corners of triangles, many in each leaf and side by side in memory.
///
/// Where the nearest point lies within a side or a face, the way to it is at a right angle to that, and some corner of
/// it is at most 1/sqrt(3) of the longest side away from it. So of all triangles only those need an exact answer that
/// have a corner of which the squared distance is larger than the least of all corners by a third of that side's
/// square, or less: a handful, however fine the soup. Long triangles make it slow.
class CornerTree {
 public:
  /// Keeps references. Corners are in voxels, and each belongs to a triangle.
  CornerTree(std::span<const Triangle> triangles, std::span<const Vec3> corners, StageWatch& watch);

  /// As TriangleTree::nearest_squared(), with the same bits.
  float nearest_squared(float x, float y, float z, float bound) const;

 private:
  static constexpr std::uint32_t kLeafSize = 48;
  struct Query;

  void look_at_leaf(const BoxHierarchy::Node& node, Query& query) const;
  void ask_found(Query& query) const;
  void find_reaches(StageWatch& watch);

  std::span<const Triangle> triangles_;
  std::span<const Vec3> corners_;
  Groups<std::uint32_t> fans_;  ///< The triangles around each corner.
  BoxHierarchy tree_;
  std::vector<float> x_, y_, z_, reach_;  ///< In the tree's order; a third of the longest side's square.
  std::vector<float> node_reach_;         ///< The largest of a node.
};

}  // namespace tetsoup
