// The voxels of the soup's own box. What the padding holds must change no result.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "base/bits.h"

namespace tetsoup {

/// Bits of a row of words that belong to voxels of the soup's box, without the padding.
class Unpadded {
 public:
  explicit Unpadded(const GridFrame& frame) : frame_(frame), words_(words_for(frame.size[0])) {
    for (int x = frame.pad; x < frame.size[0] - frame.pad; ++x)
      words_[static_cast<std::size_t>(x / 64)] |= std::uint64_t{1} << (x % 64);
  }
  bool has_row(int y, int z) const {
    const int pad = frame_.pad;
    return y >= pad && z >= pad && y < frame_.size[1] - pad && z < frame_.size[2] - pad;
  }
  std::uint64_t operator[](std::size_t w) const { return words_[w]; }
  std::uint64_t at(std::size_t w, int y, int z) const { return has_row(y, z) ? words_[w] : 0; }
  std::uint64_t voxel_count() const {
    std::uint64_t count = 1;
    for (const int size : frame_.size) count *= static_cast<std::uint64_t>(std::max(0, size - 2 * frame_.pad));
    return count;
  }

 private:
  GridFrame frame_;
  std::vector<std::uint64_t> words_;
};

}  // namespace tetsoup
