// The narrow band: every triangle lowers the voxels around it.
#pragma once

#include <span>

#include "base/parallel.h"
#include "kernel/triangle_distance.h"
#include "tetsoup/types.h"

namespace tetsoup {

/// Voxels that raster_band() will have to look at, roughly, counted once for every triangle that comes near them.
double raster_work(std::span<const kernel::TrianglePlan> triangles, float band_voxels);

/// Sets every value to the squared distance, in voxels, to the nearest triangle where that is below band_voxels^2;
/// elsewhere to something not below it. Parallel over slabs of z.
void raster_band(std::span<const kernel::TrianglePlan> triangles, float band_voxels, Grid<float>& squares,
                 StageWatch& watch);

}  // namespace tetsoup
