// The soup as points, for distances from afar.
#pragma once

#include <vector>

#include "base/morton.h"
#include "distance/soup_features.h"
#include "kernel/brick_query.h"

namespace tetsoup {

/// Points on all corners, edges and faces, none of whose points is farther than kPointSpacing / sqrt(2) from a point on
/// the same corner, edge or face. The foot of a voxel at distance d lies on such a feature, at a right angle, so the
/// nearest point is at most kPointSpacing^2 / (4 d) too far.
inline constexpr float kPointSpacing = 0.82F;  // voxels
std::vector<Vec3> surface_points(const SoupFeatures& features);

/// A tree over points in Morton order.
class PointTree {
 public:
  PointTree(const std::vector<Vec3>& points, StageWatch& watch);
  kernel::PointTreeView view() const { return {nodes_, points_}; }

 private:
  std::uint32_t build(const std::vector<MortonEntry>& sorted, std::uint32_t begin, std::uint32_t end);

  std::vector<kernel::PointNode> nodes_;
  std::vector<Vec3> points_;
};

}  // namespace tetsoup
