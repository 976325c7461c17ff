// The rows of voxels within a region.
#pragma once

#include <cstdint>
#include <vector>

#include "distance/feature_region.h"

namespace tetsoup {

/// Voxels x_begin..x_end of one row that a feature may be nearest to.
struct FeatureRow {
  std::uint32_t feature;
  std::uint16_t y, z, x_begin, x_end;
};

/// Appends the region's rows, layer by layer.
class RegionRows {
 public:
  void append(const FeatureRegion& region, std::uint32_t feature, std::vector<FeatureRow>& rows);

 private:
  std::vector<std::int32_t> begins_, ends_;  ///< Scratch, as `some_`.
  std::vector<std::uint8_t> some_;
};

}  // namespace tetsoup
