#include "distance/row_clip.h"

#include <cmath>

namespace tetsoup {

void RowClips::append(const FeatureRegion& region) {
  Clip clip;
  clip.first_bound = bounds_.size();
  bool empty = false;
  for (const IndexRange& range : region.box) empty |= range.begin >= range.end;
  if (empty) {
    clips_.push_back(clip);
    return;
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    clip.begin[axis] = static_cast<std::uint16_t>(region.box[axis].begin);
    clip.end[axis] = static_cast<std::uint16_t>(region.box[axis].end);
  }
  const double x = region.base.x - clip.begin[0], y = region.base.y - clip.begin[1], z = region.base.z - clip.begin[2];
  const double nx = clip.end[0] - clip.begin[0], ny = clip.end[1] - clip.begin[1], nz = clip.end[2] - clip.begin[2];
  // A half-space that a row hardly crosses is tilted a little, which gains less than `tilt`.
  constexpr double kFlat = 1.0 / 256;
  const double tilt = 2 * kFlat * (nx + std::abs(x));
  std::array<kernel::RowBound, FeatureRegion::kMost> lower, upper;
  for (std::size_t i = 0; i < region.count; ++i) {
    const auto& [n, limit] = region.half_spaces[i];
    const bool flat = std::abs(n.x) < kFlat, is_upper = flat || n.x > 0;
    const double inverse = 1 / (flat ? kFlat : double{n.x});
    const double by_y = -n.y * inverse, by_z = -n.z * inverse;
    const double at = x + (limit + (flat ? tilt : 0)) * inverse - y * by_y - z * by_z;
    const double rounding = 1e-6 * (std::abs(at) + std::abs(by_y) * ny + std::abs(by_z) * nz);
    const kernel::RowBound bound{static_cast<float>(is_upper ? at + rounding : at - rounding), static_cast<float>(by_y),
                                 static_cast<float>(by_z)};
    if (is_upper)
      upper[clip.uppers++] = bound;
    else
      lower[clip.lowers++] = bound;
  }
  bounds_.insert(bounds_.end(), lower.begin(), lower.begin() + clip.lowers);
  bounds_.insert(bounds_.end(), upper.begin(), upper.begin() + clip.uppers);
  clips_.push_back(clip);
}

}  // namespace tetsoup
