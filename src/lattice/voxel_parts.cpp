#include "lattice/voxel_parts.h"

#include <algorithm>

#include "base/bits.h"
#include "base/unions.h"

namespace tetsoup {

VoxelParts::VoxelParts(const BitGrid& bits, StageWatch& watch) : frame_(bits.frame) {
  row_begin_.assign(1, 0);
  for (int z = 0; z < frame_.size[2]; ++z) {
    watch.poll();
    for (int y = 0; y < frame_.size[1]; ++y) {
      const std::uint64_t* words = bits.words.data() + bits.row(y, z);
      for (int x = 0; x < frame_.size[0];) {
        const int begin = find_bit(words, x, frame_.size[0], true);
        x = find_bit(words, begin, frame_.size[0], false);
        if (begin < x) runs_.push_back({begin, x, y, z, 0});
      }
      row_begin_.push_back(runs_.size());
    }
  }
  watch.throw_if_stopped();
  Unions parts(runs_.size());
  const auto join_rows = [&](std::size_t a, std::size_t b) {
    std::size_t i = row_begin_[a], j = row_begin_[b];
    while (i < row_begin_[a + 1] && j < row_begin_[b + 1]) {
      if (runs_[i].begin <= runs_[j].end && runs_[j].begin <= runs_[i].end) parts.join(i, j);
      runs_[i].end < runs_[j].end ? ++i : ++j;
    }
  };
  for (int z = 0; z < frame_.size[2]; ++z) {
    for (int y = 0; y < frame_.size[1]; ++y) {
      if (y > 0) join_rows(row(y - 1, z), row(y, z));
      if (z == 0) continue;
      for (int other = std::max(0, y - 1); other <= std::min(frame_.size[1] - 1, y + 1); ++other)
        join_rows(row(other, z - 1), row(y, z));
    }
  }
  for (std::size_t r = 0; r < runs_.size(); ++r) {
    runs_[r].part = static_cast<std::uint32_t>(parts.find(r));
    count_ += runs_[r].part == r ? 1 : 0;
  }
}

std::size_t VoxelParts::row(int y, int z) const {
  return static_cast<std::size_t>(z) * static_cast<std::size_t>(frame_.size[1]) + static_cast<std::size_t>(y);
}

std::uint32_t VoxelParts::at(int x, int y, int z) const {
  if (!frame_.contains(x, y, z)) return kNone;
  const auto begin = runs_.begin() + static_cast<std::ptrdiff_t>(row_begin_[row(y, z)]);
  const auto end = runs_.begin() + static_cast<std::ptrdiff_t>(row_begin_[row(y, z) + 1]);
  const auto after = std::upper_bound(begin, end, x, [](int at, const VoxelRun& run) { return at < run.begin; });
  if (after == begin || x >= (after - 1)->end) return kNone;
  return (after - 1)->part;
}

}  // namespace tetsoup
