// Where a corner, edge or face of the soup can be the nearest feature.
//
// A corner is nearest only where every edge that meets in it leads away, an edge only where every face beside it does,
// a face only above and below itself [Mauch03, characteristic/scan conversion]. What is left is thin: on a closed
// surface the regions of all features hardly overlap.
#pragma once

#include <array>

#include "distance/soup_features.h"
#include "kernel/cone_reach.h"

namespace tetsoup {

struct IndexRange {
  int begin, end;
};

/// Intersection of half-spaces, within a box of voxels. Holds every voxel within the band where the feature's computed
/// distance can be the least of all, whatever the rounding of its rivals.
struct FeatureRegion {
  static constexpr std::size_t kMost = 12;  ///< Half-spaces; more would be thrown away, which only widens the region.

  Vec3 base;
  std::array<kernel::HalfSpace, kMost> half_spaces;  ///< About `base`.
  std::size_t count = 0;
  std::array<IndexRange, 3> box{};

  void add(const Vec3& normal, float limit) { half_spaces[count++] = {normal, limit}; }
};

FeatureRegion corner_region(const SoupFeatures& features, std::uint32_t corner, float band, const GridFrame& frame);
FeatureRegion edge_region(const SoupFeatures& features, std::uint32_t edge, float band, const GridFrame& frame);
FeatureRegion face_region(const SoupFeatures& features, std::uint32_t face, float band, const GridFrame& frame);

}  // namespace tetsoup
