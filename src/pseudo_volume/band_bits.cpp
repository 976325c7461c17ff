#include "pseudo_volume/band_bits.h"

#include "kernel/voxels_below.h"

namespace tetsoup {

BandBits find_band(const BlockGrid& distance, float band, StageWatch& watch) {
  BandBits found{std::move(kernel::voxels_below(distance, {&band, 1}, watch).front()), {}};
  const std::size_t words = found.bits.words_per_row;
  found.ranges.resize(found.bits.words.size() / words);
  constexpr std::int64_t kRowsAtOnce = 1024;
  parallel_for(static_cast<std::int64_t>(found.ranges.size()), kRowsAtOnce, watch,
               [&](std::int64_t begin, std::int64_t end) {
                 for (auto row = static_cast<std::size_t>(begin); row < static_cast<std::size_t>(end); ++row)
                   for (std::uint32_t w = 0; w < words; ++w)
                     if (found.bits.words[row * words + w] != 0) found.ranges[row].include(w);
               });
  return found;
}

}  // namespace tetsoup
