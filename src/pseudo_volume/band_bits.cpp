#include "pseudo_volume/band_bits.h"

#include "base/bits.h"
#include "kernel/event_masks.h"

namespace tetsoup {

std::vector<BitGrid> voxels_below(const BlockGrid& distance, std::span<const float> limits, StageWatch& watch) {
  std::vector<BitGrid> below(limits.size());
  for (BitGrid& bits : below) bits = make_bit_grid(distance.frame);
  parallel_for(static_cast<std::int64_t>(distance.slabs.size()), 1, watch, [&](std::int64_t begin, std::int64_t end) {
    std::vector<std::uint64_t> found(limits.size());
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      const auto& [places, values] = distance.slabs[i];
      const std::size_t first = distance.slabs.front().places.size() * i;
      for (std::size_t word = 0; word < places.size(); ++word) {
        if (places[word] == 0) continue;
        const float* block = values.data() + std::size_t{BlockGrid::kBlock} * places[word];
        kernel::find_below(block, limits.data(), limits.size(), found.data());
        for (std::size_t k = 0; k < below.size(); ++k) below[k].words[first + word] = found[k];
      }
    }
  });
  return below;
}

BandBits find_band(const BlockGrid& distance, float band, StageWatch& watch) {
  BandBits found{std::move(voxels_below(distance, {&band, 1}, watch).front()), {}};
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
