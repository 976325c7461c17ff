// The nearest of many points to all voxels of a brick at once, through a tree of boxes.
#pragma once

#include <cstdint>
#include <span>

#include "tetsoup/types.h"

namespace tetsoup::kernel {

struct PointNode {
  Vec3 lo, hi;
  std::uint32_t next = 0;   ///< Inner: the second child (the first follows its parent). Leaf: its first point.
  std::uint32_t count = 0;  ///< Points of a leaf; 0 for an inner node.
};

struct PointTreeView {
  std::span<const PointNode> nodes;
  std::span<const Vec3> points;  ///< In the order of the leaves.
};

inline constexpr int kPointTreeDepth = 96;  ///< No tree is deeper.
inline constexpr int kBrick = 8;            ///< Voxels along each edge of a brick.
using BrickSquares = std::span<float, kBrick * kBrick * kBrick>;

/// squares[(z 8 + y) 8 + x] = min(itself, squared distance from (x0 + x, y0 + y, z0 + z) to the nearest point).
/// Squares of 0 ask for nothing.
/// @param hint  A leaf that is probably near (0 in the beginning); set to the one that was nearest last.
void lower_brick(const PointTreeView& tree, int x0, int y0, int z0, BrickSquares squares, std::uint32_t& hint);

}  // namespace tetsoup::kernel
