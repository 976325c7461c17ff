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

/// Groups of rows in a layer.
inline int row_groups(int rows) {
  return (rows + kRowGroup - 1) / kRowGroup;
}

/// Cuts the rows (0..rows, 0..layers): begin is the first voxel not below any lower bound, end is one beyond the last
/// voxel not above any upper bound.
/// @param begin, end  (layers, row_groups(rows), kRowGroup); 0 and 0 where nothing is left.
/// @param some        (layers, row_groups(rows)): a bit for each row of the group of which something is left. Rows
///                    beyond the last count too.
void clip_rows(const RowBounds& bounds, int rows, int layers, std::int32_t* begin, std::int32_t* end,
               std::uint8_t* some);

}  // namespace tetsoup::kernel
