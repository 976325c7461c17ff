// Which steps between neighbouring voxels cross a surface an odd number of times: volume events that need no band.
#pragma once

#include <array>

#include "base/parallel.h"
#include "pseudo_volume/band_bits.h"
#include "tetsoup/distance.h"
#include "tetsoup/soup.h"

namespace tetsoup {

/// For all 13 axes, in the order of the sheets (kernel::kSheetSteps, with dx = -1, 0, 1 each), that along x last:
/// whether the step from a voxel to the next one on the axis crosses the soup an odd number of times.
using CrossingPlanes = std::array<BitGrid, 13>;
CrossingPlanes find_crossings(const TriangleSoup& soup, const GridFrame& frame, StageWatch& watch);

/// What counts for one band.
struct ExactCrossings {
  CrossingPlanes planes;  ///< Without those between two unsound voxels.
  BitGrid unsound;        ///< So near to a rim of a hole that a run has one event, whatever it crosses.
  BandBits near;          ///< Voxels at which rays may change: the band, and those beside a crossing.
};

/// @param rims  Distance to the soup's odd edges.
/// @param soup  Distance to all of it.
ExactCrossings exact_for_band(const CrossingPlanes& planes, const BlockGrid& rims, const BlockGrid& soup,
                              double band_voxels, StageWatch& watch);

}  // namespace tetsoup
