// The narrow band: every corner, edge and face of the soup lowers the voxels that may be nearest to it.
#pragma once

#include "base/parallel.h"
#include "distance/soup_features.h"
#include "tetsoup/types.h"

namespace tetsoup {

/// Distance to the nearest triangle for all voxels within `band_voxels` of the soup: the bits of
/// kernel::squared_distance's least over all triangles. Work grows with the features' number and the voxels in the
/// band, not with their product. Parallel over slabs of z.
BlockGrid scan_convert(const SoupFeatures& features, const GridFrame& frame, float band_voxels, StageWatch& watch);

}  // namespace tetsoup
