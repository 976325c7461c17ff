// Soups of many more triangles than voxels near them: each voxel asks for its nearest triangle.
#pragma once

#include <optional>

#include "base/parallel.h"
#include "distance/corner_tree.h"
#include "tetsoup/types.h"

namespace tetsoup {

/// The voxels that may lie within a band of so many voxels, and some more, if they are so few that asking the tree for
/// each costs less than scan conversion of all triangles; none if not.
std::optional<BitGrid> voxels_worth_asking(std::span<const Triangle> triangles, std::span<const Vec3> corners,
                                           const GridFrame& frame, double band, StageWatch& watch);

/// Distances of these voxels up to a band. The same bits as scan_convert().
BlockGrid ask_voxels(const CornerTree& tree, const BitGrid& wanted, double band, StageWatch& watch);

}  // namespace tetsoup
