// A binary tree of boxes over things that are near each other along a Morton curve.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/morton.h"
#include "base/parallel.h"
#include "base/vec.h"
#include "tetsoup/types.h"

namespace tetsoup {

/// Split where the highest bit of the Morton code changes: the boxes are those of an octree's cells.
struct BoxHierarchy {
  static constexpr std::uint32_t kLeafSize = 4;
  static constexpr int kMaxDepth = 96;  ///< 48 bits of the code, then halves of what shares a code.

  struct Box {
    Vec3 lo, hi;
  };
  struct Node {
    Vec3 lo, hi;
    std::uint32_t next = 0;   ///< Inner: the second child (the first follows its parent). Leaf: first of `order`.
    std::uint32_t count = 0;  ///< Things of a leaf; 0 for an inner node.
  };
  std::vector<Node> nodes;           ///< The root first; parents before children.
  std::vector<std::uint32_t> order;  ///< The things, leaf after leaf.
};

/// Over the things 0 to count - 1: box(i) is a Box around thing i, place(i) where it lies, in the unit of
/// morton_code(). O(n log n), partly on all threads.
template <class BoxOf, class Place>
BoxHierarchy make_box_hierarchy(std::size_t count, const BoxOf& box, const Place& place, StageWatch& watch);

namespace detail {
std::vector<BoxHierarchy::Node> make_box_nodes(std::span<const MortonEntry> sorted,
                                               std::span<const BoxHierarchy::Box> boxes);
}

template <class BoxOf, class Place>
BoxHierarchy make_box_hierarchy(std::size_t count, const BoxOf& box, const Place& place, StageWatch& watch) {
  const std::vector<MortonEntry> sorted = morton_order(count, place, watch);
  BoxHierarchy tree;
  tree.order.resize(count);
  std::vector<BoxHierarchy::Box> boxes(count);  // side by side for the leaves
  parallel_for(static_cast<std::int64_t>(count), 8192, watch, [&](std::int64_t begin, std::int64_t end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      tree.order[i] = sorted[i].index;
      boxes[i] = box(sorted[i].index);
    }
  });
  if (count > 0) tree.nodes = detail::make_box_nodes(sorted, boxes);
  watch.step(0);
  return tree;
}

/// Over a soup's triangles, in the soup's own floats: the boxes hold their triangles exactly.
BoxHierarchy make_triangle_hierarchy(const TriangleSoup& soup, StageWatch& watch);

}  // namespace tetsoup
