// d_max: how far the farthest voxel of the soup's box is from the soup.
#pragma once

#include "base/parallel.h"
#include "distance/triangle_tree.h"
#include "tetsoup/types.h"

namespace tetsoup {

/// Largest squared distance, in voxels, over the voxels of the unpadded box. Exact, by branch and bound over blocks:
/// the distance changes by at most the step between two points, so a block's centre bounds all of it.
float farthest_voxel_squared(const TriangleTree& tree, const GridFrame& frame, StageWatch& watch);

}  // namespace tetsoup
