// A tree of boxes over the triangles, for the nearest one to any point.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "base/morton.h"
#include "distance/soup_features.h"

namespace tetsoup {

/// A binary tree over the triangles in Morton order, split where the highest bit of the code changes: its boxes are
/// those of an octree's cells.
class TriangleTree {
 public:
  /// Keeps a reference to the features.
  TriangleTree(const SoupFeatures& features, StageWatch& watch);

  /// Squared distance to the nearest triangle if that is below `bound`, else some value not below `bound`.
  /// The same bits as the least of kernel::squared_distance over all triangles.
  float nearest_squared(float x, float y, float z, float bound) const;

 private:
  struct Node {
    Vec3 lo, hi;
    std::uint32_t next = 0;   ///< Inner: the second child (the first follows its parent). Leaf: first of `order_`.
    std::uint32_t count = 0;  ///< Triangles of a leaf; 0 for an inner node.
  };
  std::uint32_t build(std::span<const MortonEntry> sorted, std::span<const Node> boxes, std::uint32_t begin,
                      std::uint32_t end);
  static float squared_distance(const Node& node, float x, float y, float z);
  float squared_distance(std::size_t triangle, float x, float y, float z) const;

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> order_;
  const SoupFeatures& features_;
};

}  // namespace tetsoup
