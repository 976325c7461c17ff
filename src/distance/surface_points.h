// The soup as points, for distances from afar.
#pragma once

#include "distance/soup_features.h"
#include "kernel/nearest_points.h"

namespace tetsoup {

/// Points on all corners, edges and faces, none of whose points is farther than kPointSpacing / sqrt(2) from a point on
/// the same corner, edge or face. The foot of a voxel at distance d lies on such a feature, at a right angle, so the
/// nearest point is at most kPointSpacing^2 / (4 d) too far.
inline constexpr float kPointSpacing = 0.82F;  // voxels
kernel::PointColumns surface_points(const SoupFeatures& features);

}  // namespace tetsoup
