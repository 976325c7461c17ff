// Where along a direction volume events may lie, for 64 voxels at once.
//
// Nothing here depends on the band: what is found once serves every band that is tried.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace tetsoup::kernel {

/// Bits of 64 voxels along x about one axis: each voxel against its two neighbours along the axis, the one ahead and
/// the one behind. Beyond the grid the distance is infinite.
struct AxisEvents {
  std::uint64_t ahead = 0;   ///< The one ahead is the farthest of the three, or as far as that.
  std::uint64_t behind = 0;  ///< The same of the one behind.
  std::uint64_t lowest = 0;  ///< Neither neighbour is closer to the soup.
  bool operator==(const AxisEvents&) const = default;
};

inline constexpr std::size_t kSheetKinds = 4;
/// The kinds of sheets that hold all rays but those along x: rows of voxels (y, z), (y + dy, z + dz), ...
inline constexpr std::array<std::array<int, 2>, kSheetKinds> kSheetSteps{{{-1, 1}, {0, 1}, {1, 1}, {1, 0}}};
/// Of the three axes in a sheet, that move by dx = -1, 0 and 1 along x a row.
using SheetEvents = std::array<AxisEvents, 3>;

/// All 13 axes.
struct WordEvents {
  std::array<SheetEvents, kSheetKinds> sheets;
  AxisEvents along_x;
};

/// The distances of 64 voxels along x and around them, row by row: row 3 (dz + 1) + dy + 1.
struct BlockNeighbours {
  std::array<const float*, 9> rows;  ///< 64 values each.
  std::array<float, 9> before;       ///< The value before each row's first.
  std::array<float, 9> after;        ///< The value after each row's last.
};

/// Same bits as reference::find_events() on every machine: comparisons only.
/// Cost: 13 x 192 comparisons.
WordEvents find_events(const BlockNeighbours& around);

/// Which of 64 values lie below each of the limits.
void find_below(const float* block, const float* limits, std::size_t count, std::uint64_t* bits);

}  // namespace tetsoup::kernel
