#include "distance/triangle_tree.h"

#include <bit>
#include <cmath>
#include <limits>

#include "base/require.h"

namespace tetsoup {
namespace {

constexpr std::size_t kLeafSize = 2;
constexpr int kMaxDepth = 64;
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

/// The triangles sorted along a Morton curve through their centres, at an eighth of a voxel.
std::vector<std::uint32_t> morton_order(const SoupFeatures& features) {
  struct Entry {
    std::uint64_t code;
    std::uint32_t triangle;
  };
  std::vector<Entry> entries;
  entries.reserve(features.triangles.size());
  for (std::uint32_t i = 0; i < features.triangles.size(); ++i) {
    const auto [a, b, c] = features.triangles[i];
    const auto along = [&](auto coordinate) {
      const float centre = (coordinate(a) + coordinate(b) + coordinate(c)) * (8.0F / 3);
      return spread(static_cast<std::uint64_t>(std::clamp(centre, 0.0F, 65535.0F)));
    };
    const std::uint64_t x = along([&](std::uint32_t v) { return features.corners[v].x; });
    const std::uint64_t y = along([&](std::uint32_t v) { return features.corners[v].y; });
    const std::uint64_t z = along([&](std::uint32_t v) { return features.corners[v].z; });
    entries.push_back({x | y << 1 | z << 2, i});
  }
  parallel_sort(entries.begin(), entries.end(), [](const Entry& l, const Entry& r) {
    return l.code != r.code ? l.code < r.code : l.triangle < r.triangle;
  });
  std::vector<std::uint32_t> order;
  order.reserve(entries.size());
  for (const Entry& e : entries) order.push_back(e.triangle);
  return order;
}

}  // namespace

TriangleTree::TriangleTree(const SoupFeatures& features, StageWatch& watch)
    : order_(morton_order(features)), features_(features) {
  watch.step(0);
  const std::size_t leaves = (order_.size() + kLeafSize - 1) / kLeafSize;
  first_leaf_ = std::bit_ceil(leaves) - 1;
  nodes_.resize(first_leaf_ + leaves);
  constexpr float kFar = std::numeric_limits<float>::max();
  constexpr Node kNothing{{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}};
  parallel_for(static_cast<std::int64_t>(leaves), 512, watch, [&](std::int64_t begin, std::int64_t end) {
    for (auto leaf = static_cast<std::size_t>(begin); leaf < static_cast<std::size_t>(end); ++leaf) {
      Node node = kNothing;
      for (std::size_t i = leaf * kLeafSize; i < std::min(order_.size(), (leaf + 1) * kLeafSize); ++i) {
        for (const std::uint32_t corner : features.triangles[order_[i]]) {
          node.lo = lower(node.lo, features.corners[corner]);
          node.hi = upper(node.hi, features.corners[corner]);
        }
      }
      nodes_[first_leaf_ + leaf] = node;
    }
  });
  for (std::size_t i = first_leaf_; i-- > 0;) {
    nodes_[i] = kNothing;
    for (std::size_t child = 2 * i + 1; child < std::min(nodes_.size(), 2 * i + 3);
         ++child)  // the last level ends early
      nodes_[i] = {lower(nodes_[i].lo, nodes_[child].lo), upper(nodes_[i].hi, nodes_[child].hi)};
  }
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
    std::size_t node;
    float square;
  };
  std::array<Pending, kMaxDepth> stack;
  std::size_t depth = 0;
  float best = bound;
  const auto look = [&](std::size_t node) { return Pending{node, squared_distance(nodes_[node], x, y, z)}; };
  Pending at = look(0);
  for (;;) {
    if (at.square <= best * kSlack + kSlackAbsolute) {
      const std::size_t left = 2 * at.node + 1;
      if (left + 1 < nodes_.size()) {
        Pending near = look(left), far = look(left + 1);
        if (far.square < near.square) std::swap(near, far);
        TETSOUP_ASSERT(depth < stack.size());
        stack[depth++] = far;
        at = near;
        continue;
      }
      if (left < nodes_.size()) {
        at = look(left);
        continue;
      }
      if (at.node < first_leaf_) {  // a box of nothing
        if (depth == 0) return best;
        at = stack[--depth];
        continue;
      }
      const std::size_t begin = (at.node - first_leaf_) * kLeafSize;
      for (std::size_t i = begin; i < std::min(order_.size(), begin + kLeafSize); ++i)
        best = std::min(best, squared_distance(order_[i], x, y, z));
    }
    if (depth == 0) return best;
    at = stack[--depth];
  }
}

}  // namespace tetsoup
