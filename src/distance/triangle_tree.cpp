#include "distance/triangle_tree.h"

#include <algorithm>
#include <array>

#include "base/require.h"

namespace tetsoup {
namespace {

/// A box is skipped only if it is farther than the best by more than rounding, so that no exact nearest is lost.
constexpr float kSlack = 1.0F + 0x1p-14F;
constexpr float kSlackAbsolute = 1e-6F;  // voxels squared

float squared_distance_to(const BoxHierarchy::Node& node, float x, float y, float z) {
  const float dx = std::max({node.lo.x - x, x - node.hi.x, 0.0F});
  const float dy = std::max({node.lo.y - y, y - node.hi.y, 0.0F});
  const float dz = std::max({node.lo.z - z, z - node.hi.z, 0.0F});
  return dx * dx + dy * dy + dz * dz;
}

}  // namespace

TriangleTree::TriangleTree(const SoupFeatures& features, StageWatch& watch) : features_(features) {
  const auto corner = [&](std::size_t i, std::size_t k) -> const Vec3& {
    return features.corners[features.triangles[i][k]];
  };
  const auto centre = [&](std::size_t i) {
    const Vec3 &p = corner(i, 0), &q = corner(i, 1), &r = corner(i, 2);
    return Vec3{(p.x + q.x + r.x) / 3, (p.y + q.y + r.y) / 3, (p.z + q.z + r.z) / 3};
  };
  const auto box = [&](std::size_t i) {
    const Vec3 &p = corner(i, 0), &q = corner(i, 1), &r = corner(i, 2);
    return BoxHierarchy::Box{min(p, min(q, r)), max(p, max(q, r))};
  };
  tree_ = make_box_hierarchy(features.triangles.size(), box, centre, watch);
}

float TriangleTree::squared_distance(std::size_t triangle, float x, float y, float z) const {
  const auto [a, b, c] = features_.triangles[triangle];
  const Vec3 &p = features_.corners[a], &q = features_.corners[b], &r = features_.corners[c];
  return kernel::squared_distance({{p, q, r},
                                   {kernel::plan_edge(p, q), kernel::plan_edge(q, r), kernel::plan_edge(p, r)},
                                   features_.faces[triangle]},
                                  x, y, z);
}

float TriangleTree::nearest_squared(float x, float y, float z, float bound) const {
  struct Pending {
    std::uint32_t node;
    float square;
  };
  std::array<Pending, BoxHierarchy::kMaxDepth> stack;
  std::size_t depth = 0;
  float best = bound;
  const auto look = [&](std::uint32_t node) { return Pending{node, squared_distance_to(tree_.nodes[node], x, y, z)}; };
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
        best = std::min(best, squared_distance(tree_.order[i], x, y, z));
    }
    if (depth == 0) return best;
    at = stack[--depth];
  }
}

}  // namespace tetsoup
