#include "distance/triangle_tree.h"

#include <numeric>

#include "base/require.h"

namespace tetsoup {
namespace {

constexpr std::uint32_t kLeafSize = 4;
constexpr std::uint32_t kStepNodes = 1024;  ///< Nodes between two looks at the progress callback.
constexpr int kMaxDepth = 64;               ///< Median splits of 2^32 triangles are 32 deep.
/// A box is skipped only if it is farther than the best by more than rounding, so that no exact nearest is lost.
constexpr float kSlack = 1.0F + 0x1p-14F;
constexpr float kSlackAbsolute = 1e-6F;  // voxels squared

Vec3 lower(const Vec3& a, const Vec3& b) {
  return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}
Vec3 upper(const Vec3& a, const Vec3& b) {
  return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}

float coordinate(const Vec3& v, int axis) {
  return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

}  // namespace

TriangleTree::TriangleTree(std::span<const kernel::TrianglePlan> triangles, StageWatch& watch)
    : order_(triangles.size()) {
  std::iota(order_.begin(), order_.end(), 0U);
  nodes_.reserve(triangles.size());
  build(triangles, 0, static_cast<std::uint32_t>(triangles.size()), watch);
  triangles_.reserve(triangles.size());
  for (const std::uint32_t i : order_) triangles_.push_back(triangles[i]);
  order_ = {};
}

std::uint32_t TriangleTree::build(std::span<const kernel::TrianglePlan> triangles, std::uint32_t begin,
                                  std::uint32_t end, StageWatch& watch) {
  Node node{triangles[order_[begin]].corner[0], triangles[order_[begin]].corner[0], begin, end - begin};
  for (std::uint32_t i = begin; i < end; ++i) {
    for (const Vec3& v : triangles[order_[i]].corner) {
      node.lo = lower(node.lo, v);
      node.hi = upper(node.hi, v);
    }
  }
  const auto self = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back(node);
  if (end - begin <= kLeafSize) return self;
  if (self % kStepNodes == 0) watch.step(0);

  const Vec3 size{node.hi.x - node.lo.x, node.hi.y - node.lo.y, node.hi.z - node.lo.z};
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const auto centre = [&](std::uint32_t i) {
    const auto& c = triangles[i].corner;
    return coordinate(c[0], axis) + coordinate(c[1], axis) + coordinate(c[2], axis);
  };
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                   [&](std::uint32_t a, std::uint32_t b) {
                     const float ca = centre(a), cb = centre(b);
                     return ca != cb ? ca < cb : a < b;
                   });
  build(triangles, begin, middle, watch);
  const std::uint32_t second = build(triangles, middle, end, watch);
  nodes_[self].next = second;
  nodes_[self].count = 0;
  return self;
}

float TriangleTree::squared_distance(const Node& node, float x, float y, float z) {
  const float dx = std::max({node.lo.x - x, x - node.hi.x, 0.0F});
  const float dy = std::max({node.lo.y - y, y - node.hi.y, 0.0F});
  const float dz = std::max({node.lo.z - z, z - node.hi.z, 0.0F});
  return dx * dx + dy * dy + dz * dz;
}

float TriangleTree::nearest_squared(float x, float y, float z, float bound) const {
  struct Pending {
    std::uint32_t node;
    float square;
  };
  std::array<Pending, kMaxDepth> stack;
  std::size_t depth = 0;
  float best = bound;
  Pending at{0, squared_distance(nodes_[0], x, y, z)};
  for (;;) {
    if (at.square <= best * kSlack + kSlackAbsolute) {
      const Node& node = nodes_[at.node];
      if (node.count == 0) {
        Pending near{at.node + 1, squared_distance(nodes_[at.node + 1], x, y, z)};
        Pending far{node.next, squared_distance(nodes_[node.next], x, y, z)};
        if (far.square < near.square) std::swap(near, far);
        TETSOUP_ASSERT(depth < stack.size());
        stack[depth++] = far;
        at = near;
        continue;
      }
      for (std::uint32_t i = node.next; i < node.next + node.count; ++i)
        best = std::min(best, kernel::squared_distance(triangles_[i], x, y, z));
    }
    if (depth == 0) return best;
    at = stack[--depth];
  }
}

}  // namespace tetsoup
