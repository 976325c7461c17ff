// Which voxels of a grid hang together.
#pragma once

#include <cstdint>
#include <vector>

#include "base/parallel.h"
#include "tetsoup/types.h"

namespace tetsoup {

/// Set voxels [begin, end) of a row.
struct VoxelRun {
  int begin, end, y, z;
  std::uint32_t part;  ///< Equal where they hang together.
};

/// The set voxels of a grid by connected parts; voxels touch through faces, edges and corners.
class VoxelParts {
 public:
  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;

  /// O(rows + runs of set voxels).
  VoxelParts(const BitGrid& bits, StageWatch& watch);

  /// A number of the part that has this voxel, or kNone where it is not set or beyond the grid.
  std::uint32_t at(int x, int y, int z) const;
  std::size_t count() const { return count_; }
  template <class Visit>
  void visit(const Visit& visit) const {
    for (const VoxelRun& run : runs_) visit(run);
  }

 private:
  std::size_t row(int y, int z) const;

  GridFrame frame_;
  std::vector<std::size_t> row_begin_;
  std::vector<VoxelRun> runs_;
  std::size_t count_ = 0;
};

}  // namespace tetsoup
