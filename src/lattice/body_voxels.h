// The voxels that the mesh is to cover.
#pragma once

#include "base/parallel.h"
#include "tetsoup/soup.h"
#include "tetsoup/types.h"

namespace tetsoup {

/// Voxels that the soup passes through. Cost: O(soup's area in voxels).
BitGrid soup_voxels(const GridFrame& frame, const CleanSoup& soup, StageWatch& watch);

/// The inside voxels, and those of the soup where it has none beside it: leaves, wires, fins thinner than the grid can
/// tell; so too beside small parts of the inside that the soup joins with a larger one. Where the soup bounds a volume
/// nothing is added.
BitGrid body_voxels(const BitGrid& inside, const CleanSoup& soup, StageWatch& watch);

}  // namespace tetsoup
