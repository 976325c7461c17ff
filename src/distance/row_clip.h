// The rows of voxels within many regions, stored compactly.
#pragma once

#include <vector>

#include "distance/feature_region.h"
#include "kernel/clip_rows.h"

namespace tetsoup {

/// What is left of a region on the rows of its box: per half-space, a bound on x that is linear in y and z.
class RowClips {
 public:
  void append(const FeatureRegion& region);

  std::size_t size() const { return clips_.size(); }
  /// Layers the region reaches into.
  IndexRange layers(std::size_t i) const { return {clips_[i].begin[2], clips_[i].end[2]}; }

  /// Calls row(y, z, x_begin, x_end) for what the region holds of `layers`. `scratch` is the caller's.
  template <class Row>
  void visit(std::size_t i, IndexRange layers, std::vector<std::int32_t>& scratch, const Row& row) const {
    const Clip& clip = clips_[i];
    const kernel::RowBound* bounds = bounds_.data() + clip.first_bound;
    const kernel::RowBounds all{
        {bounds, clip.lowers}, {bounds + clip.lowers, clip.uppers}, clip.end[0] - clip.begin[0]};
    const int rows = clip.end[1] - clip.begin[1], z_end = std::min<int>(clip.end[2], layers.end);
    const std::size_t room = static_cast<std::size_t>(rows) + kSpare;
    if (scratch.size() < 2 * room) scratch.resize(2 * room);
    std::int32_t *begin = scratch.data(), *end = begin + room;
    for (int z = std::max<int>(clip.begin[2], layers.begin); z < z_end; ++z) {
      kernel::clip_rows(all, rows, z - clip.begin[2], begin, end);
      for (int y = 0; y < rows; ++y)
        if (begin[y] < end[y]) row(clip.begin[1] + y, z, clip.begin[0] + begin[y], clip.begin[0] + end[y]);
    }
  }

 private:
  static constexpr std::size_t kSpare = 16;  ///< Rows that clip_rows() may write beyond the last.
  struct Clip {
    std::size_t first_bound = 0;
    std::array<std::uint16_t, 3> begin{}, end{};
    std::uint8_t lowers = 0, uppers = 0;
  };

  std::vector<Clip> clips_;
  std::vector<kernel::RowBound> bounds_;  ///< Of each clip, counted from its box's first voxel, the lower ones first.
};

}  // namespace tetsoup
