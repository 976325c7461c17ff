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

inline constexpr int kRowGroup = 8;

/// Rows of a layer that clip_rows() writes: `count` rounded up to whole groups.
inline int padded_rows(int count) {
  return (count + kRowGroup - 1) / kRowGroup * kRowGroup;
}

/// Cuts the rows (0..rows, 0..layers): begin is the first voxel not below any lower bound, end is one beyond the
/// last voxel not above any upper bound; 0 and 0 if there is none between them.
/// @param begin, end  (layers, padded_rows(rows))
void clip_rows(const RowBounds& bounds, int rows, int layers, std::int32_t* begin, std::int32_t* end);

}  // namespace tetsoup::kernel
