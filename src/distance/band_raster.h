// The narrow band: every triangle lowers the voxels around it.
#pragma once

#include <span>

#include "base/parallel.h"
#include "kernel/triangle_distance.h"
#include "tetsoup/types.h"

namespace tetsoup {

/// What a soup would cost: decides whether to raster it or to ask a tree of boxes.
struct RasterWork {
  double looks = 0;       ///< Voxels that raster_band() would look at, roughly, once for every triangle near them.
  double box_voxels = 0;  ///< Volume of the triangles' own boxes: how much the boxes of a tree would overlap.
};
RasterWork estimate_work(std::span<const kernel::TrianglePlan> triangles, float band_voxels);

/// Sets every value to the squared distance, in voxels, to the nearest triangle where that is below band_voxels^2;
/// elsewhere to something not below it. Parallel over slabs of z.
void raster_band(std::span<const kernel::TrianglePlan> triangles, float band_voxels, Grid<float>& squares,
                 StageWatch& watch);

}  // namespace tetsoup
