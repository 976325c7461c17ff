#include "distance/triangle_tree.h"

#include <algorithm>
#include <array>

#include "base/require.h"
#include "kernel/triangle_distance.h"

namespace tetsoup {
TriangleTree::TriangleTree(std::span<const Triangle> triangles, std::span<const Vec3> corners, StageWatch& watch)
    : triangles_(triangles), corners_(corners), tree_(make_box_hierarchy(triangles, corners, watch)) {}

/// Planned anew each time: plans of all triangles would take more memory than all else. Some value not below `bound` if
/// the triangle's box says so.
float TriangleTree::squared_distance(std::size_t triangle, float x, float y, float z, float bound) const {
  const auto [lo, hi] = triangle_box(corners_, triangles_[triangle]);
  const float to_box = squared_distance_to(lo, hi, x, y, z);
  if (to_box > bound * kSlack + kSlackAbsolute) return to_box;
  const auto [a, b, c] = triangles_[triangle];
  return kernel::squared_distance(kernel::plan_triangle(corners_[a], corners_[b], corners_[c]), x, y, z);
}

float TriangleTree::nearest_squared(float x, float y, float z, float bound) const {
  struct Pending {
    std::uint32_t node;
    float square;
  };
  std::array<Pending, BoxHierarchy::kMaxDepth> stack;
  std::size_t depth = 0;
  float best = bound;
  const auto look = [&](std::uint32_t node) {
    return Pending{node, squared_distance_to(tree_.nodes[node].lo, tree_.nodes[node].hi, x, y, z)};
  };
  Pending at = look(0);
  for (;;) {
    if (at.square <= best * kSlack + kSlackAbsolute) {
      const BoxHierarchy::Node& node = tree_.nodes[at.node];
      if (node.count == 0) {
        Pending near = look(at.node + 1), far = look(node.next);
        if (far.square < near.square) std::swap(near, far);
        TETSOUP_ASSERT(depth < stack.size());
        stack[depth++] = far;
        at = near;
        continue;
      }
      for (std::uint32_t i = node.next; i < node.next + node.count; ++i)
        best = std::min(best, squared_distance(tree_.order[i], x, y, z, best));
    }
    if (depth == 0) return best;
    at = stack[--depth];
  }
}

}  // namespace tetsoup
