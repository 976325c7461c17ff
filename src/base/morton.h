// Points in an order that keeps neighbours together: along a Morton curve.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "tetsoup/types.h"

namespace tetsoup {

struct MortonEntry {
  std::uint64_t code;
  std::uint32_t index;
  bool operator<(const MortonEntry& other) const {
    return code != other.code ? code < other.code : index < other.index;
  }
};

/// Place of a point on a Morton curve, at an eighth of a unit. Coordinates are clamped to 0..8191.
inline std::uint64_t morton_code(const Vec3& p) {
  const auto spread = [](float coordinate) {
    auto v = static_cast<std::uint64_t>(std::clamp(coordinate * 8, 0.0F, 65535.0F));
    v = (v | v << 32) & 0x001F00000000FFFFU;
    v = (v | v << 16) & 0x001F0000FF0000FFU;
    v = (v | v << 8) & 0x100F00F00F00F00FU;
    v = (v | v << 4) & 0x10C30C30C30C30C3U;
    return (v | v << 2) & 0x1249249249249249U;
  };
  return spread(p.x) | spread(p.y) << 1 | spread(p.z) << 2;
}

/// The points point(0), ..., point(count - 1) in Morton order.
template <class Point>
std::vector<MortonEntry> morton_order(std::size_t count, const Point& point, StageWatch& watch) {
  std::vector<MortonEntry> entries(count);
  parallel_for(static_cast<std::int64_t>(count), 8192, watch, [&](std::int64_t begin, std::int64_t end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i)
      entries[i] = {morton_code(point(i)), static_cast<std::uint32_t>(i)};
  });
  parallel_sort(entries.begin(), entries.end(), std::less<>());
  watch.step(0);
  return entries;
}

/// Where sorted entries [begin, end) fall apart: where the highest bit of their codes changes, so that both parts are
/// cells of an octree; halfway where they share a code.
inline std::uint32_t morton_split(std::span<const MortonEntry> sorted, std::uint32_t begin, std::uint32_t end) {
  const std::uint64_t differing = sorted[begin].code ^ sorted[end - 1].code;
  if (differing == 0) return begin + (end - begin) / 2;
  const std::uint64_t bit = std::bit_floor(differing);
  const auto first_set = std::partition_point(sorted.begin() + begin, sorted.begin() + end,
                                              [&](const MortonEntry& m) { return (m.code & bit) == 0; });
  return static_cast<std::uint32_t>(first_set - sorted.begin());
}

}  // namespace tetsoup
