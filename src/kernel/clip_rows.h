// Rows of voxels cut down to what lies within a convex region.
#pragma once

#include <cstdint>
#include <span>

namespace tetsoup::kernel {

/// A bound on x that is linear in y and z: x = at + y Y + z Z.
struct RowBound {
  float at, y, z;
};

struct RowBounds {
  std::span<const RowBound> lower, upper;
  int width = 0;  ///< 0 <= x < width
};

/// Cuts the rows (0..count, z): begin[y] is the first voxel not below any lower bound, end[y] is one beyond the last
/// voxel not above any upper bound; 0 and 0 if there is none between them. Both hold `count` rounded up to 16.
void clip_rows(const RowBounds& bounds, int count, int z, std::int32_t* begin, std::int32_t* end);

}  // namespace tetsoup::kernel
