// Points in an order that keeps neighbours together: along a Morton curve.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "tetsoup/types.h"

namespace tetsoup {

inline constexpr float kMortonRange = 1023;  ///< Coordinates go from 0 to this.

struct MortonEntry {
  std::uint32_t code;
  std::uint32_t index;
};

/// Place of a point on a Morton curve, 10 bits a coordinate. Coordinates are clamped to 0..1023.
inline std::uint32_t morton_code(const Vec3& p) {
  const auto spread = [](float coordinate) {
    auto v = static_cast<std::uint32_t>(std::clamp(coordinate, 0.0F, kMortonRange));
    v = (v | v << 16) & 0x030000FFU;
    v = (v | v << 8) & 0x0300F00FU;
    v = (v | v << 4) & 0x030C30C3U;
    return (v | v << 2) & 0x09249249U;
  };
  return spread(p.x) | spread(p.y) << 1 | spread(p.z) << 2;
}

/// Sorts by code; equal codes keep their order. O(entries), on all threads.
void sort_by_code(std::vector<MortonEntry>& entries, StageWatch& watch);

/// The points point(0), ..., point(count - 1) in Morton order.
template <class Point>
std::vector<MortonEntry> morton_order(std::size_t count, const Point& point, StageWatch& watch) {
  std::vector<MortonEntry> entries(count);
  parallel_for(static_cast<std::int64_t>(count), 8192, watch, [&](std::int64_t begin, std::int64_t end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i)
      entries[i] = {morton_code(point(i)), static_cast<std::uint32_t>(i)};
  });
  sort_by_code(entries, watch);
  return entries;
}

/// Where sorted entries [begin, end) fall apart: where the highest bit of their codes changes, so that both parts are
/// cells of an octree; halfway where they share a code.
inline std::uint32_t morton_split(std::span<const MortonEntry> sorted, std::uint32_t begin, std::uint32_t end) {
  const std::uint32_t differing = sorted[begin].code ^ sorted[end - 1].code;
  if (differing == 0) return begin + (end - begin) / 2;
  const std::uint32_t bit = std::bit_floor(differing);
  const auto first_set = std::partition_point(sorted.begin() + begin, sorted.begin() + end,
                                              [&](const MortonEntry& m) { return (m.code & bit) == 0; });
  return static_cast<std::uint32_t>(first_set - sorted.begin());
}

}  // namespace tetsoup
