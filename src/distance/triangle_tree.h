// A tree of boxes over the triangles, for the nearest one to any point.
#pragma once

#include "base/box_hierarchy.h"
#include "distance/soup_features.h"

namespace tetsoup {

/// A binary tree over the triangles in Morton order.
class TriangleTree {
 public:
  /// Keeps a reference to the features.
  TriangleTree(const SoupFeatures& features, StageWatch& watch);

  /// Squared distance to the nearest triangle if that is below `bound`, else some value not below `bound`.
  /// The same bits as the least of kernel::squared_distance over all triangles.
  float nearest_squared(float x, float y, float z, float bound) const;

 private:
  float squared_distance(std::size_t triangle, float x, float y, float z) const;

  BoxHierarchy tree_;
  const SoupFeatures& features_;
};

}  // namespace tetsoup
