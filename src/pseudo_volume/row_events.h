// Where along a direction the volume events lie, for a word of 64 voxels.
#pragma once

#include <bit>
#include <cstdint>
#include <limits>

#include "tetsoup/types.h"

namespace tetsoup {

/// Distances along a ray direction around one row of voxels: its own, and the rows that rays leave for and come from.
struct RowNeighbours {
  const float* here = nullptr;
  const float* next = nullptr;  ///< Null beyond the grid.
  const float* previous = nullptr;
  int dx = 0;  ///< Rays move by so many voxels along x from row to row.
  int nx = 0;
};

struct EventMasks {
  std::uint64_t not_closer =
      0;  ///< The successor is not closer to the soup: the closest approach, if the first of its run.
  std::uint64_t beyond = 0;  ///< The successor is closer than the predecessor: the crossing lies beyond the voxel.
};

/// Masks for the voxels of `in_band`, bits of word `w`. Beyond the grid the distance is infinite.
inline EventMasks find_events(const RowNeighbours& row, std::size_t w, std::uint64_t in_band) {
  const auto at = [&](const float* values, int x) {
    return values && x >= 0 && x < row.nx ? values[x] : std::numeric_limits<float>::infinity();
  };
  EventMasks masks;
  const int base = static_cast<int>(64 * w);
  for (std::uint64_t rest = in_band; rest != 0; rest &= rest - 1) {
    const int bit = std::countr_zero(rest), x = base + bit;
    const float next = at(row.next, x + row.dx), previous = at(row.previous, x - row.dx);
    masks.not_closer |= static_cast<std::uint64_t>(next >= row.here[x]) << bit;
    masks.beyond |= static_cast<std::uint64_t>(next < previous) << bit;
  }
  return masks;
}

}  // namespace tetsoup
