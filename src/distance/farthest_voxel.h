// d_max: how far the farthest voxel of the soup's box is from the soup.
#pragma once

#include <functional>

#include "base/parallel.h"
#include "tetsoup/types.h"

namespace tetsoup {

/// Squared distance of x, y, z to the soup if that is below a bound, else some value not below it.
using NearestSquared = std::function<float(float x, float y, float z, float bound)>;

/// Largest squared distance, in voxels, over the voxels of the unpadded box. Exact, by branch and bound over blocks:
/// the distance changes by at most the step between two points, so a block's centre bounds all of it.
float farthest_voxel_squared(const NearestSquared& nearest, const GridFrame& frame, StageWatch& watch);

}  // namespace tetsoup
