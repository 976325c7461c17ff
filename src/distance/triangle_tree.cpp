#include "distance/triangle_tree.h"

#include <bit>
#include <cmath>
#include <limits>

#include "base/require.h"

namespace tetsoup {
namespace {

constexpr std::uint32_t kLeafSize = 4;
constexpr int kMaxDepth = 96;  ///< 48 bits of the code, then halves of what shares a code.
/// A box is skipped only if it is farther than the best by more than rounding, so that no exact nearest is lost.
constexpr float kSlack = 1.0F + 0x1p-14F;
constexpr float kSlackAbsolute = 1e-6F;  // voxels squared

}  // namespace

TriangleTree::TriangleTree(const SoupFeatures& features, StageWatch& watch) : features_(features) {
  const std::size_t count = features.triangles.size();
  const auto centre = [&](std::size_t i) {
    const auto [a, b, c] = features.triangles[i];
    const Vec3 &p = features.corners[a], &q = features.corners[b], &r = features.corners[c];
    return Vec3{(p.x + q.x + r.x) / 3, (p.y + q.y + r.y) / 3, (p.z + q.z + r.z) / 3};
  };
  const std::vector<MortonEntry> sorted = morton_order(count, centre, watch);
  order_.resize(count);
  std::vector<Node> boxes(count);  // of single triangles, side by side for the leaves
  parallel_for(static_cast<std::int64_t>(count), 8192, watch, [&](std::int64_t begin, std::int64_t end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      order_[i] = sorted[i].index;
      const auto [a, b, c] = features.triangles[order_[i]];
      const Vec3 &p = features.corners[a], &q = features.corners[b], &r = features.corners[c];
      boxes[i] = {min(p, min(q, r)), max(p, max(q, r)), 0, 0};
    }
  });
  nodes_.reserve(count);
  build(sorted, boxes, 0, static_cast<std::uint32_t>(count));
  watch.step(0);
}

std::uint32_t TriangleTree::build(std::span<const MortonEntry> sorted, std::span<const Node> boxes, std::uint32_t begin,
                                  std::uint32_t end) {
  const auto self = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back({boxes[begin].lo, boxes[begin].hi, begin, end - begin});
  if (end - begin <= kLeafSize) {
    for (const Node& box : boxes.subspan(begin, end - begin)) {
      nodes_[self].lo = min(nodes_[self].lo, box.lo);
      nodes_[self].hi = max(nodes_[self].hi, box.hi);
    }
    return self;
  }
  const std::uint32_t middle = morton_split(sorted, begin, end);
  const std::uint32_t first = build(sorted, boxes, begin, middle), second = build(sorted, boxes, middle, end);
  nodes_[self] = {min(nodes_[first].lo, nodes_[second].lo), max(nodes_[first].hi, nodes_[second].hi), second, 0};
  return self;
}

float TriangleTree::squared_distance(const Node& node, float x, float y, float z) {
  const float dx = std::max({node.lo.x - x, x - node.hi.x, 0.0F});
  const float dy = std::max({node.lo.y - y, y - node.hi.y, 0.0F});
  const float dz = std::max({node.lo.z - z, z - node.hi.z, 0.0F});
  return dx * dx + dy * dy + dz * dz;
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
  std::array<Pending, kMaxDepth> stack;
  std::size_t depth = 0;
  float best = bound;
  const auto look = [&](std::uint32_t node) { return Pending{node, squared_distance(nodes_[node], x, y, z)}; };
  Pending at = look(0);
  for (;;) {
    if (at.square <= best * kSlack + kSlackAbsolute) {
      const Node& node = nodes_[at.node];
      if (node.count == 0) {
        Pending near = look(at.node + 1), far = look(node.next);
        if (far.square < near.square) std::swap(near, far);
        TETSOUP_ASSERT(depth < stack.size());
        stack[depth++] = far;
        at = near;
        continue;
      }
      for (std::uint32_t i = node.next; i < node.next + node.count; ++i)
        best = std::min(best, squared_distance(order_[i], x, y, z));
    }
    if (depth == 0) return best;
    at = stack[--depth];
  }
}

}  // namespace tetsoup
