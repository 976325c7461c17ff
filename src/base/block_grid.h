// Between values side by side and values in blocks.
#pragma once

#include <span>

#include "tetsoup/types.h"

namespace tetsoup {

/// A grid on which nothing is known yet.
BlockGrid make_block_grid(const GridFrame& frame);

/// One row of blocks.
struct BlockRow {
  const std::uint32_t* places = nullptr;
  const float* values = nullptr;
  const float* operator[](std::size_t b) const { return values + std::size_t{BlockGrid::kBlock} * places[b]; }
};
inline BlockRow block_row(const BlockGrid& grid, int y, int z) {
  const BlockGrid::Slab& slab = grid.slabs[static_cast<std::size_t>(z / BlockGrid::kSlab)];
  const std::size_t row =
      static_cast<std::size_t>(z % BlockGrid::kSlab) * static_cast<std::size_t>(grid.frame.size[1]) +
      static_cast<std::size_t>(y);
  return {slab.places.data() + row * grid.blocks_per_row, slab.values.data()};
}

/// Stores the layers of one slab.
/// @param values  (layers of the slab, ny, 64 blocks_per_row): rows padded to whole blocks with infinity.
void store_slab(BlockGrid& grid, std::size_t slab, std::span<const float> values);

/// The opposite of store_slab().
void load_slab(const BlockGrid& grid, std::size_t slab, std::span<float> values);

/// Layers of z in a slab: 8, or fewer in the last.
inline int slab_layers(const GridFrame& frame, std::size_t slab) {
  return std::min(BlockGrid::kSlab, frame.size[2] - static_cast<int>(slab) * BlockGrid::kSlab);
}

/// Values of a slab with rows padded to whole blocks.
inline std::size_t slab_values(const BlockGrid& grid, std::size_t slab) {
  return static_cast<std::size_t>(slab_layers(grid.frame, slab)) * static_cast<std::size_t>(grid.frame.size[1]) *
         grid.blocks_per_row * BlockGrid::kBlock;
}

}  // namespace tetsoup
