// Space that parity calls outside although the soup encloses it: where closed parts overlap, between nested shells.
#pragma once

#include "base/parallel.h"
#include "tetsoup/types.h"

namespace tetsoup {

/// Adds to `inside` the outside voxels that cannot be reached from the grid's border without touching the soup, and the
/// crust of voxels between them and the inside.
/// @param near_soup  Voxels that the soup passes so closely that no path may lead through them.
/// @return           Voxels added.
std::size_t fill_cavities(BitGrid& inside, const BitGrid& near_soup, StageWatch& watch);

}  // namespace tetsoup
