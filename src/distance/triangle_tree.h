// A tree of boxes over the triangles, for the nearest one to any point.
#pragma once

#include <cstdint>
#include <vector>

#include "base/parallel.h"
#include "distance/soup_features.h"

namespace tetsoup {

/// A complete binary tree over the triangles in Morton order: node i has the children 2 i + 1 and 2 i + 2.
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
  };
  static float squared_distance(const Node& node, float x, float y, float z);

  float squared_distance(std::size_t triangle, float x, float y, float z) const;

  std::size_t first_leaf_ = 0;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> order_;  ///< The triangles of the leaves.
  const SoupFeatures& features_;
};

}  // namespace tetsoup
