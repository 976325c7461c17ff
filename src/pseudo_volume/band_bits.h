// Which voxels lie within some distances of the soup.
#pragma once

#include <span>
#include <vector>

#include "base/parallel.h"
#include "tetsoup/types.h"

namespace tetsoup {

/// For each limit the voxels whose distance is below it, found in one pass.
std::vector<BitGrid> voxels_below(const BlockGrid& distance, std::span<const float> limits, StageWatch& watch);

}  // namespace tetsoup
