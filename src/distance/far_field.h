// Distances in the whole grid or in a wide band, once a narrow one is known.
#pragma once

#include "base/parallel.h"
#include "distance/soup_features.h"
#include "tetsoup/types.h"

namespace tetsoup {

inline constexpr double kFarField = 4;  ///< Voxels; the band that must be known.

/// The field with its unknown voxels filled that are nearer than `limit` voxels, infinity for all: at most 0.045 voxels
/// too far, never too near (surface_points.h). Whatever the limit, a value that is known has the same bits.
BlockGrid fill_far_field(const BlockGrid& band, const SoupFeatures& features, double limit, StageWatch& watch);

}  // namespace tetsoup
