// Whether a box of voxels is wholly inside, wholly outside or mixed, without looking at every voxel.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "base/parallel.h"
#include "tetsoup/types.h"

namespace tetsoup {

struct VoxelRange {
  std::array<int, 3> begin{}, end{};
};

enum class Content { Outside, Inside, Mixed };

/// The bits of a grid, and of every block of 8 x 8 rows along x what any of them and what all of them hold.
class InsideBlocks {
 public:
  /// `bits` must outlive this. O(voxels / 64), all threads.
  InsideBlocks(const BitGrid& bits, StageWatch& watch);

  const BitGrid& bits() const { return bits_; }
  /// Voxels beyond the grid are outside. The range must not be empty.
  Content content(const VoxelRange& range) const;
  /// Bit i: whether voxel begin + i of the row (y, z) is inside, for at most 64 voxels [begin, end) anywhere.
  std::uint64_t word(int begin, int end, int y, int z) const {
    const auto& size = bits_.frame.size;
    const int first = std::max(begin, 0), last = std::min(end, size[0]) - 1;
    if (first > last || y < 0 || z < 0 || y >= size[1] || z >= size[2]) return 0;
    const std::uint64_t* row = bits_.words.data() + bits_.row(y, z);
    std::uint64_t word = row[first >> 6] >> (first & 63);
    if (first >> 6 != last >> 6) word |= row[last >> 6] << (63 - (first & 63)) << 1;
    return (word & ~std::uint64_t{0} >> (63 - (last - first))) << (first - begin);
  }

 private:
  struct Found {
    bool inside = false, outside = false;
    void add(std::uint64_t bits, std::uint64_t mask) {
      inside |= (bits & mask) != 0;
      outside |= (~bits & mask) != 0;
    }
  };
  void look_at_block(const VoxelRange& within, int by, int bz, Found& found) const;

  const BitGrid& bits_;
  int blocks_y_;
  std::vector<std::uint64_t> any_, all_;  ///< (blocks along z, along y, words_per_row)
};

}  // namespace tetsoup
