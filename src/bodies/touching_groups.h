// Which parts of a soup touch, and which lie inside which.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "tetsoup/types.h"

namespace tetsoup {

inline constexpr std::uint32_t kNoPart = 0xFFFFFFFFU;

/// The group of every part, 0 onwards by their first parts. Parts are of one group where a triangle of one meets a
/// triangle of the other (exactly: they share a point) or comes closer to it than `near`, and where others join them. A
/// part inside another does not touch it for that.
///
/// @param soup  Clean: positions are distinct, coordinates at most 1e30.
/// Cost: O(n log n) and the pairs of triangles whose boxes meet, up to the first of two parts that touch; one thread
/// but for sorting.
std::vector<std::uint32_t> touching_groups(const TriangleSoup& soup, std::span<const std::uint32_t> part_of_triangle,
                                           std::size_t part_count, double near, StageWatch& watch);

/// For every part, the innermost closed part of another group around it; kNoPart where there is none.
///
/// A point of the part decides, by how often a ray from it crosses the other: exactly.
/// @param groups     As touching_groups() tells them.
/// @param is_closed  Of every part, not 0: it has no open edges and may contain others.
/// Cost: O(n log n), one ray a part; on all threads.
std::vector<std::uint32_t> part_inside(const TriangleSoup& soup, std::span<const std::uint32_t> part_of_triangle,
                                       std::span<const std::uint32_t> groups, std::span<const std::uint8_t> is_closed,
                                       StageWatch& watch);

}  // namespace tetsoup
