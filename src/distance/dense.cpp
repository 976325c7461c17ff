#include <algorithm>

#include "tetsoup/distance.h"

namespace tetsoup {

Grid<float> dense(const BlockGrid& blocks) {
  const auto [nx, ny, nz] = blocks.frame.size;
  Grid<float> grid{blocks.frame, {}};
  grid.values.reserve(blocks.frame.voxel_count());
  for (int z = 0; z < nz; ++z) {
    for (int y = 0; y < ny; ++y) {
      for (int x = 0; x < nx; x += BlockGrid::kBlock) {
        const float* block = blocks.block(static_cast<std::size_t>(x / BlockGrid::kBlock), y, z);
        grid.values.insert(grid.values.end(), block, block + std::min(BlockGrid::kBlock, nx - x));
      }
    }
  }
  return grid;
}

}  // namespace tetsoup
