#include "lattice/inside_blocks.h"

namespace tetsoup {
namespace {

constexpr int kEdge = 8;  ///< Rows of a block along y and z.

int blocks_over(int rows) {
  return (rows + kEdge - 1) / kEdge;
}

/// Bits of word `w` of a row that belong to voxels [begin, end), of which at least one does.
std::uint64_t mask_of(int begin, int end, int w) {
  std::uint64_t mask = ~std::uint64_t{0};
  if (w == begin >> 6) mask &= ~std::uint64_t{0} << (begin & 63);
  if (w == (end - 1) >> 6) mask &= ~std::uint64_t{0} >> (63 - ((end - 1) & 63));
  return mask;
}

}  // namespace

InsideBlocks::InsideBlocks(const BitGrid& bits, StageWatch& watch)
    : bits_(bits), blocks_y_(blocks_over(bits.frame.size[1])) {
  const auto& size = bits.frame.size;
  const std::size_t words = bits.words_per_row;
  any_.assign(static_cast<std::size_t>(blocks_over(size[2]) * blocks_y_) * words, 0);
  all_.assign(any_.size(), ~std::uint64_t{0});
  parallel_for(blocks_over(size[2]), 1, watch, [&](std::int64_t bz, std::int64_t) {
    for (int z = static_cast<int>(bz) * kEdge; z < std::min(size[2], (static_cast<int>(bz) + 1) * kEdge); ++z) {
      for (int y = 0; y < size[1]; ++y) {
        const std::uint64_t* row = bits.words.data() + bits.row(y, z);
        const std::size_t block = static_cast<std::size_t>(static_cast<int>(bz) * blocks_y_ + y / kEdge) * words;
        for (std::size_t w = 0; w < words; ++w) {
          any_[block + w] |= row[w];
          all_[block + w] &= row[w];
        }
      }
    }
  });
}

Content InsideBlocks::content(const VoxelRange& range) const {
  VoxelRange within;
  Found found;
  for (std::size_t i = 0; i < 3; ++i) {
    within.begin[i] = std::max(range.begin[i], 0);
    within.end[i] = std::min(range.end[i], bits_.frame.size[i]);
    if (within.begin[i] >= within.end[i]) return Content::Outside;
    found.outside |= within.begin[i] != range.begin[i] || within.end[i] != range.end[i];
  }
  for (int bz = within.begin[2] / kEdge; bz <= (within.end[2] - 1) / kEdge; ++bz) {
    for (int by = within.begin[1] / kEdge; by <= (within.end[1] - 1) / kEdge; ++by) {
      look_at_block(within, by, bz, found);
      if (found.inside && found.outside) return Content::Mixed;
    }
  }
  return found.inside ? Content::Inside : Content::Outside;
}

void InsideBlocks::look_at_block(const VoxelRange& within, int by, int bz, Found& found) const {
  const std::size_t block = static_cast<std::size_t>(bz * blocks_y_ + by) * bits_.words_per_row;
  const int y0 = std::max(within.begin[1], by * kEdge), y1 = std::min(within.end[1], (by + 1) * kEdge);
  const int z0 = std::max(within.begin[2], bz * kEdge), z1 = std::min(within.end[2], (bz + 1) * kEdge);
  for (int w = within.begin[0] >> 6; w <= (within.end[0] - 1) >> 6; ++w) {
    const auto word = static_cast<std::size_t>(w);
    const std::uint64_t mask = mask_of(within.begin[0], within.end[0], w);
    if ((any_[block + word] & mask) == 0) {
      found.outside = true;
    } else if ((~all_[block + word] & mask) == 0) {
      found.inside = true;
    } else {
      for (int z = z0; z < z1; ++z)
        for (int y = y0; y < y1; ++y) found.add(bits_.words[bits_.row(y, z) + word], mask);
    }
  }
}

}  // namespace tetsoup
