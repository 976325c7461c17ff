#include "distance/region_rows.h"

#include <bit>
#include <cmath>

#include "kernel/clip_rows.h"

namespace tetsoup {
namespace {

/// The half-spaces of a region as bounds on x, counted from the first voxel of its box.
struct BoundLists {
  std::array<kernel::RowBound, FeatureRegion::kMost + 1> lower, upper;  // one more, to be overwritten
  std::size_t lowers = 0, uppers = 0;

  explicit BoundLists(const FeatureRegion& region) {
    const auto from_base = [&](float base, const IndexRange& range) { return base - static_cast<float>(range.begin); };
    const auto size = [](const IndexRange& range) { return static_cast<float>(range.end - range.begin); };
    const float x = from_base(region.base.x, region.box[0]), y = from_base(region.base.y, region.box[1]),
                z = from_base(region.base.z, region.box[2]);
    const float y_reach = size(region.box[1]) + std::abs(y), z_reach = size(region.box[2]) + std::abs(z);
    // A half-space that a row hardly crosses is tilted a little, which gains less than `tilt`.
    constexpr float kFlat = 1.0F / 256, kRounding = 4e-6F;
    const float tilt = 2 * kFlat * (size(region.box[0]) + std::abs(x));
    for (std::size_t i = 0; i < region.count; ++i) {
      const auto& [n, limit] = region.half_spaces[i];
      const bool flat = std::abs(n.x) < kFlat, is_upper = flat || n.x > 0;
      const float inverse = 1 / (flat ? kFlat : n.x), by_y = -n.y * inverse, by_z = -n.z * inverse;
      const float offset = (limit + (flat ? tilt : 0)) * inverse, at = x + offset - y * by_y - z * by_z;
      const float rounding =
          kRounding * (std::abs(x) + std::abs(offset) + std::abs(by_y) * y_reach + std::abs(by_z) * z_reach);
      upper[uppers] = {at + rounding, by_y, by_z};
      lower[lowers] = {at - rounding, by_y, by_z};
      uppers += is_upper;
      lowers += !is_upper;
    }
  }
};

}  // namespace

void RegionRows::append(const FeatureRegion& region, std::uint32_t feature, std::vector<FeatureRow>& rows) {
  const auto& [xs, ys, zs] = region.box;
  if (xs.begin >= xs.end || ys.begin >= ys.end || zs.begin >= zs.end) return;
  const BoundLists bounds(region);
  const int rows_in_layer = ys.end - ys.begin, layers = zs.end - zs.begin, groups = kernel::row_groups(rows_in_layer);
  const auto room = static_cast<std::size_t>(groups) * static_cast<std::size_t>(layers);
  if (some_.size() < room) {
    begins_.resize(kernel::kRowGroup * room);
    ends_.resize(kernel::kRowGroup * room);
    some_.resize(room);
  }
  kernel::clip_rows({{bounds.lower.data(), bounds.lowers}, {bounds.upper.data(), bounds.uppers}, xs.end - xs.begin},
                    rows_in_layer, layers, begins_.data(), ends_.data(), some_.data());
  const auto index = [](int v) { return static_cast<std::uint16_t>(v); };
  for (std::size_t group = 0; group < room; ++group) {
    const int z = zs.begin + static_cast<int>(group) / groups;
    const int y = ys.begin + static_cast<int>(group) % groups * kernel::kRowGroup;
    for (unsigned rest = some_[group]; rest != 0; rest &= rest - 1) {
      const int row = std::countr_zero(rest);
      const std::size_t at = kernel::kRowGroup * group + static_cast<std::size_t>(row);
      if (y + row < ys.end)
        rows.push_back({feature, index(y + row), index(z), index(xs.begin + begins_[at]), index(xs.begin + ends_[at])});
    }
  }
}

}  // namespace tetsoup
