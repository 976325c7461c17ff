// How large is the largest hole that was closed? The one assumption of a pseudo volume that its user should know.
#pragma once

#include "base/parallel.h"
#include "pseudo_volume/score.h"
#include "tetsoup/types.h"

namespace tetsoup {

/// Twice the largest distance, in voxels, between the soup and a face between an inside and an outside voxel: about the
/// diameter of the largest hole, wherever its surface had to be made up. A face is as near as the nearer of its two
/// voxels; nearer than 0.9 voxels it is the soup's own, and 0 is returned if all are. Exact where the distance is
/// known, beyond from voxels the soup touches, to a voxel. Cost: a pass over the bits; beyond the known distance,
/// little more.
double largest_closure_voxels(const BitGrid& inside, const BlockGrid& distance, const SoupMarks& marks,
                              StageWatch& watch);

}  // namespace tetsoup
