// A binary tree of boxes over things that are near each other along a Morton curve.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "base/morton.h"
#include "base/parallel.h"
#include "base/vec.h"
#include "tetsoup/types.h"

namespace tetsoup {

/// Split where the highest bit of the Morton code changes: the boxes are those of an octree's cells.
struct BoxHierarchy {
  static constexpr int kMaxDepth = 64;  ///< 30 bits of the code, then halves of what shares a code.

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

/// The box around some corners' triangle.
inline BoxHierarchy::Box triangle_box(std::span<const Vec3> corners, const Triangle& t) {
  const Vec3 &p = corners[t[0]], &q = corners[t[1]], &r = corners[t[2]];
  return {min(p, min(q, r)), max(p, max(q, r))};
}

/// Over things 0 to count - 1, of which each leaf has so many at most; box(i) holds thing i, and `bounds` all of them.
/// O(n), on all threads.
BoxHierarchy make_box_hierarchy(std::size_t count, std::uint32_t leaf_size, const Box3& bounds,
                                const std::function<BoxHierarchy::Box(std::size_t)>& box, StageWatch& watch);

/// Over triangles, in the floats of their corners: the boxes hold their triangles exactly.
BoxHierarchy make_box_hierarchy(std::span<const Triangle> triangles, std::span<const Vec3> corners, StageWatch& watch);

}  // namespace tetsoup
