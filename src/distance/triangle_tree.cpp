#include "distance/triangle_tree.h"

#include <bit>
#include <cmath>
#include <limits>

#include "base/require.h"

namespace tetsoup {
namespace {

constexpr std::uint32_t kLeafSize = 2;
constexpr int kMaxDepth = 96;  ///< 48 bits of the code, then halves of what shares a code.
/// A box is skipped only if it is farther than the best by more than rounding, so that no exact nearest is lost.
constexpr float kSlack = 1.0F + 0x1p-14F;
constexpr float kSlackAbsolute = 1e-6F;  // voxels squared

Vec3 lower(const Vec3& a, const Vec3& b) {
  return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}
Vec3 upper(const Vec3& a, const Vec3& b) {
  return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}

/// Bits of a 12-bit number, two zeros between any two.
std::uint64_t spread(std::uint64_t v) {
  v = (v | v << 32) & 0x001F00000000FFFFU;
  v = (v | v << 16) & 0x001F0000FF0000FFU;
  v = (v | v << 8) & 0x100F00F00F00F00FU;
  v = (v | v << 4) & 0x10C30C30C30C30C3U;
  return (v | v << 2) & 0x1249249249249249U;
}

/// Place of a triangle's centre on a Morton curve, at an eighth of a voxel.
std::uint64_t morton_code(const SoupFeatures& features, const Triangle& triangle) {
  const auto along = [&](auto coordinate) {
    const float centre = coordinate(triangle[0]) + coordinate(triangle[1]) + coordinate(triangle[2]);
    return spread(static_cast<std::uint64_t>(std::clamp(centre * (8.0F / 3), 0.0F, 65535.0F)));
  };
  return along([&](std::uint32_t v) { return features.corners[v].x; }) |
         along([&](std::uint32_t v) { return features.corners[v].y; }) << 1 |
         along([&](std::uint32_t v) { return features.corners[v].z; }) << 2;
}

}  // namespace

TriangleTree::TriangleTree(const SoupFeatures& features, StageWatch& watch) : features_(features) {
  const std::size_t count = features.triangles.size();
  std::vector<MortonTriangle> sorted(count);
  parallel_for(static_cast<std::int64_t>(count), 8192, watch, [&](std::int64_t begin, std::int64_t end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i)
      sorted[i] = {morton_code(features, features.triangles[i]), static_cast<std::uint32_t>(i)};
  });
  parallel_sort(sorted.begin(), sorted.end(), [](const MortonTriangle& l, const MortonTriangle& r) {
    return l.code != r.code ? l.code < r.code : l.triangle < r.triangle;
  });
  watch.step(0);
  order_.reserve(count);
  for (const MortonTriangle& m : sorted) order_.push_back(m.triangle);
  nodes_.reserve(count);
  build(sorted, 0, static_cast<std::uint32_t>(count));
  watch.step(0);
}

std::uint32_t TriangleTree::build(const std::vector<MortonTriangle>& sorted, std::uint32_t begin, std::uint32_t end) {
  const auto self = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back({features_.corners[features_.triangles[order_[begin]][0]],
                    features_.corners[features_.triangles[order_[begin]][0]], begin, end - begin});
  if (end - begin <= kLeafSize) {
    Node& leaf = nodes_[self];
    for (std::uint32_t i = begin; i < end; ++i) {
      for (const std::uint32_t corner : features_.triangles[order_[i]]) {
        leaf.lo = lower(leaf.lo, features_.corners[corner]);
        leaf.hi = upper(leaf.hi, features_.corners[corner]);
      }
    }
    return self;
  }
  std::uint32_t middle = begin + (end - begin) / 2;
  const std::uint64_t differing = sorted[begin].code ^ sorted[end - 1].code;
  if (differing != 0) {
    const std::uint64_t bit = std::bit_floor(differing);
    const auto first_set = std::partition_point(sorted.begin() + begin, sorted.begin() + end,
                                                [&](const MortonTriangle& m) { return (m.code & bit) == 0; });
    middle = static_cast<std::uint32_t>(first_set - sorted.begin());
  }
  const std::uint32_t first = build(sorted, begin, middle), second = build(sorted, middle, end);
  nodes_[self] = {lower(nodes_[first].lo, nodes_[second].lo), upper(nodes_[first].hi, nodes_[second].hi), second, 0};
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
