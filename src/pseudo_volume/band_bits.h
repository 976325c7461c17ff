// Which voxels lie within a distance of the soup.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "base/parallel.h"
#include "tetsoup/types.h"

namespace tetsoup {

/// Neighbouring words of a row.
struct WordRange {
  std::uint32_t begin = 0, end = 0;

  bool empty() const { return begin == end; }
  void include(std::uint32_t word) {
    begin = empty() ? word : std::min(begin, word);
    end = std::max(end, word + 1);
  }
  void include(const WordRange& other) {
    if (other.empty()) return;
    include(other.begin);
    include(other.end - 1);
  }
};

/// The voxels nearer to the soup than a band.
struct BandBits {
  BitGrid bits;
  std::vector<WordRange> ranges;  ///< (nz, ny): of every row the words from the first to the last with a bit.
};
BandBits find_band(const BlockGrid& distance, float band, StageWatch& watch);

}  // namespace tetsoup
