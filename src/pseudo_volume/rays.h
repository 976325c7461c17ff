// Volume events along the 26 rays through every voxel, for one band.
#pragma once

#include <vector>

#include "base/parallel.h"
#include "pseudo_volume/votes.h"
#include "tetsoup/pseudo_volume.h"

namespace tetsoup {

/// Counts, for every voxel, the rays that call it inside, with volume events where the distance is below `band`.
/// `votes` is cleared first. The watch's current part is covered from `begin` to `end`.
void cast_rays(const Grid<float>& distance, float band, int rays, Placement placement, std::vector<VoteWord>& votes,
               StageWatch& watch, double begin, double end);

}  // namespace tetsoup
