// Space that parity calls outside although the soup encloses it: where closed parts overlap, between nested shells.
#pragma once

#include "base/parallel.h"
#include "tetsoup/types.h"

namespace tetsoup {

/// Adds to `inside` the outside voxels that cannot be reached from the grid's border without touching the soup, and the
/// crust of voxels between them and the inside.
/// @param sealed  Voxels that the soup passes so closely that no path may lead through them.
/// @return        Voxels added.
std::size_t fill_cavities(BitGrid& inside, const BitGrid& sealed, StageWatch& watch);

/// The same for rooms behind holes that the band closes: space farther from the soup than the band that cannot be
/// reached from the border without coming nearer, and what lies between it and the soup. At the hole it ends half way.
/// @param sealed       As above.
/// @param band         Voxels nearer to the soup than the band; what lies in the padding counts as free.
/// @param band_voxels  How wide that is.
std::size_t fill_rooms(BitGrid& inside, const BitGrid& sealed, const BitGrid& band, double band_voxels,
                       StageWatch& watch);

}  // namespace tetsoup
