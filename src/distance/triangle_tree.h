// A tree of boxes over the triangles, for the nearest one to any point.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "kernel/triangle_distance.h"

namespace tetsoup {

class TriangleTree {
 public:
  TriangleTree(std::span<const kernel::TrianglePlan> triangles, StageWatch& watch);

  /// Squared distance to the nearest triangle if that is below `bound`, else some value not below `bound`.
  /// The same bits as the least of kernel::squared_distance over all triangles.
  float nearest_squared(float x, float y, float z, float bound) const;

 private:
  struct Node {
    Vec3 lo, hi;
    std::uint32_t next = 0;   ///< Inner: the second child (the first follows its parent). Leaf: first triangle.
    std::uint32_t count = 0;  ///< Triangles of a leaf; 0 for an inner node.
  };
  std::uint32_t build(std::span<const kernel::TrianglePlan> triangles, std::uint32_t begin, std::uint32_t end,
                      StageWatch& watch);
  static float squared_distance(const Node& node, float x, float y, float z);

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> order_;
  std::vector<kernel::TrianglePlan> triangles_;  ///< In the order of the leaves.
};

}  // namespace tetsoup
