// Distances in the whole grid, once the band is known.
#pragma once

#include "base/parallel.h"
#include "distance/soup_features.h"
#include "tetsoup/types.h"

namespace tetsoup {

inline constexpr double kFarField = 4;  ///< Voxels; the band that must be known.

/// The field with its unknown voxels filled: at most 0.045 voxels too far, never too near (surface_points.h).
BlockGrid fill_far_field(const BlockGrid& band, const SoupFeatures& features, StageWatch& watch);

}  // namespace tetsoup
