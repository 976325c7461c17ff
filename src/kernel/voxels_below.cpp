#include "kernel/voxels_below.h"

#include "base/bits.h"
#include "kernel/event_masks.h"

namespace tetsoup::kernel {

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
        find_below(block, limits.data(), limits.size(), found.data());
        for (std::size_t k = 0; k < below.size(); ++k) below[k].words[first + word] = found[k];
      }
    }
  });
  return below;
}

}  // namespace tetsoup::kernel
