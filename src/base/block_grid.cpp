#include "base/block_grid.h"

#include <algorithm>
#include <limits>

#include "base/bits.h"

namespace tetsoup {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr std::size_t kBlock = BlockGrid::kBlock;

bool is_known(const float* block) {
  float least = kInfinity;
  for (std::size_t i = 0; i < kBlock; ++i) least = block[i] < least ? block[i] : least;
  return least < kInfinity;
}

}  // namespace

BlockGrid make_block_grid(const GridFrame& frame) {
  BlockGrid grid;
  grid.frame = frame;
  grid.blocks_per_row = words_for(frame.size[0]);
  grid.slabs.resize(static_cast<std::size_t>((frame.size[2] + BlockGrid::kSlab - 1) / BlockGrid::kSlab));
  for (std::size_t i = 0; i < grid.slabs.size(); ++i) {
    grid.slabs[i].places.resize(slab_values(grid, i) / kBlock);
    grid.slabs[i].values.assign(kBlock, kInfinity);
  }
  return grid;
}

void store_slab(BlockGrid& grid, std::size_t slab, std::span<const float> values) {
  auto& [places, stored] = grid.slabs[slab];
  std::uint32_t count = 0;
  for (std::size_t i = 0; i < places.size(); ++i) places[i] = is_known(values.data() + i * kBlock) ? ++count : 0;
  stored.resize(kBlock * (count + 1));
  stored.shrink_to_fit();
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (places[i] == 0) continue;
    const auto block = values.subspan(i * kBlock, kBlock);
    std::copy(block.begin(), block.end(), stored.begin() + static_cast<std::ptrdiff_t>(kBlock * places[i]));
  }
}

void load_slab(const BlockGrid& grid, std::size_t slab, std::span<float> values) {
  const auto& [places, stored] = grid.slabs[slab];
  for (std::size_t i = 0; i < places.size(); ++i)
    std::copy_n(stored.begin() + static_cast<std::ptrdiff_t>(kBlock * places[i]), kBlock,
                values.begin() + static_cast<std::ptrdiff_t>(kBlock * i));
}

}  // namespace tetsoup
