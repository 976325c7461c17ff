// Arithmetic on rows of bits, 64 voxels a word.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

#include "tetsoup/types.h"

namespace tetsoup {

inline std::size_t words_for(int voxels) {
  return (static_cast<std::size_t>(voxels) + 63) / 64;
}

/// Bits of word `w` of a row that belong to voxels.
inline std::uint64_t row_mask(int voxels, std::size_t w) {
  const std::size_t begin = 64 * w, size = static_cast<std::size_t>(voxels);
  return size - begin >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << (size - begin)) - 1;
}

inline BitGrid make_bit_grid(const GridFrame& frame) {
  BitGrid grid;
  grid.frame = frame;
  grid.words_per_row = words_for(frame.size[0]);
  grid.words.resize(grid.words_per_row * static_cast<std::size_t>(frame.size[1]) *
                    static_cast<std::size_t>(frame.size[2]));
  return grid;
}

/// First voxel of [x, end) whose bit is `value`.
inline int find_bit(const std::uint64_t* row, int x, int end, bool value) {
  while (x < end) {
    const std::uint64_t word = (value ? row[x >> 6] : ~row[x >> 6]) >> (x & 63);
    if (word != 0) return std::min(end, x + std::countr_zero(word));
    x = (x | 63) + 1;
  }
  return end;
}

/// Word `w` of the row moved one voxel towards higher x (bit i holds what bit i - 1 held); zero comes in.
inline std::uint64_t shifted_up(const std::uint64_t* row, std::size_t w) {
  return row[w] << 1 | (w > 0 ? row[w - 1] >> 63 : 0);
}
/// Word `w` of the row moved one voxel towards lower x.
inline std::uint64_t shifted_down(const std::uint64_t* row, std::size_t w, std::size_t words) {
  return row[w] >> 1 | (w + 1 < words ? row[w + 1] << 63 : 0);
}

/// Number of set bits. Not std::popcount, which without the processor's own instruction is a call into a table.
inline std::size_t bit_count(std::uint64_t v) {
  v -= v >> 1 & 0x5555555555555555U;
  v = (v & 0x3333333333333333U) + (v >> 2 & 0x3333333333333333U);
  v = (v + (v >> 4)) & 0x0F0F0F0F0F0F0F0FU;
  return static_cast<std::size_t>(v * 0x0101010101010101U >> 56);
}

/// The rows of a grid by (y, z), also beyond it.
class BitRows {
 public:
  explicit BitRows(const BitGrid& bits) : bits_(bits) {}

  /// Null beyond the grid.
  const std::uint64_t* at(int y, int z) const {
    const bool within = y >= 0 && z >= 0 && y < bits_.frame.size[1] && z < bits_.frame.size[2];
    return within ? bits_.words.data() + bits_.row(y, z) : nullptr;
  }
  /// Bits of word `w` of a row that have a set bit among their 27 neighbours.
  std::uint64_t grown(int y, int z, std::size_t w) const {
    std::uint64_t middle = 0, below = 0, above = 0;  // of the nine rows, what touches the word
    for (int dz = -1; dz <= 1; ++dz) {
      for (int dy = -1; dy <= 1; ++dy) {
        const std::uint64_t* row = at(y + dy, z + dz);
        if (row == nullptr) continue;
        middle |= row[w];
        if (w > 0) below |= row[w - 1];
        if (w + 1 < bits_.words_per_row) above |= row[w + 1];
      }
    }
    return middle | middle << 1 | middle >> 1 | below >> 63 | above << 63;
  }
  /// Bits of word `w` of a row that have a set and a clear bit among their 27 neighbours; beyond the grid all are
  /// clear.
  std::uint64_t mixed(int y, int z, std::size_t w) const {
    std::uint64_t any = 0, any_below = 0, any_above = 0;  // of the nine rows, as in grown()
    std::uint64_t all = ~std::uint64_t{0}, all_below = all, all_above = all;
    for (int dz = -1; dz <= 1; ++dz) {
      for (int dy = -1; dy <= 1; ++dy) {
        const std::uint64_t* row = at(y + dy, z + dz);
        const bool first = row == nullptr || w == 0, last = row == nullptr || w + 1 == bits_.words_per_row;
        const std::uint64_t here = row == nullptr ? 0 : row[w], before = first ? 0 : row[w - 1],
                            after = last ? 0 : row[w + 1];
        any |= here, any_below |= before, any_above |= after;
        all &= here, all_below &= before, all_above &= after;
      }
    }
    const std::uint64_t set = any | any << 1 | any >> 1 | any_below >> 63 | any_above << 63;
    return set & ~(all & (all << 1 | all_below >> 63) & (all >> 1 | all_above << 63));
  }

 private:
  const BitGrid& bits_;
};

/// Bit i of the result is the exclusive or of bits 0..i.
inline std::uint64_t prefix_parity(std::uint64_t v) {
  for (int shift = 1; shift < 64; shift *= 2) v ^= v << shift;
  return v;
}

inline std::uint64_t reversed(std::uint64_t v) {
  v = (v >> 1 & 0x5555555555555555U) | (v & 0x5555555555555555U) << 1;
  v = (v >> 2 & 0x3333333333333333U) | (v & 0x3333333333333333U) << 2;
  v = (v >> 4 & 0x0F0F0F0F0F0F0F0FU) | (v & 0x0F0F0F0F0F0F0F0FU) << 4;
  v = (v >> 8 & 0x00FF00FF00FF00FFU) | (v & 0x00FF00FF00FF00FFU) << 8;
  v = (v >> 16 & 0x0000FFFF0000FFFFU) | (v & 0x0000FFFF0000FFFFU) << 16;
  return v >> 32 | v << 32;
}

/// Bits with a set bit within `radius` voxels along every axis (a cube around it).
inline BitGrid dilated(const BitGrid& bits, int radius) {
  const int nx = bits.frame.size[0], ny = bits.frame.size[1], nz = bits.frame.size[2];
  const std::size_t words = bits.words_per_row;
  BitGrid out = bits;
  for (std::size_t row = 0; row < out.words.size(); row += words) {
    for (int step = 0; step < radius; ++step) {
      std::uint64_t* line = out.words.data() + row;
      std::uint64_t below = 0;  // the line as it was: the word before this one
      for (std::size_t w = 0; w < words; ++w) {
        const std::uint64_t here = line[w];
        line[w] = here | here << 1 | below >> 63 | shifted_down(line, w, words);
        below = here;
      }
      line[words - 1] &= row_mask(nx, words - 1);
    }
  }
  // Along y, then z: or the rows within reach. `stride` is the distance of two neighbours, in words.
  const auto spread = [&](int count, std::size_t stride) {
    const BitGrid from = out;
    for (std::size_t i = 0; i < out.words.size(); ++i) {
      const int at = static_cast<int>(i / stride % static_cast<std::size_t>(count));
      std::uint64_t any = 0;
      for (int j = std::max(0, at - radius); j <= std::min(count - 1, at + radius); ++j)
        any |= from.words[i - static_cast<std::size_t>(at) * stride + static_cast<std::size_t>(j) * stride];
      out.words[i] = any;
    }
  };
  spread(ny, words);
  spread(nz, words * static_cast<std::size_t>(ny));
  return out;
}

}  // namespace tetsoup
