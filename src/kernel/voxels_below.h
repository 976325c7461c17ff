// Which voxels are nearer than a limit.
#pragma once

#include <span>
#include <vector>

#include "base/parallel.h"
#include "tetsoup/types.h"

namespace tetsoup::kernel {

/// For each limit the voxels whose distance is below it, found in one pass.
std::vector<BitGrid> voxels_below(const BlockGrid& distance, std::span<const float> limits, StageWatch& watch);

}  // namespace tetsoup::kernel
