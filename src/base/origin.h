// What coordinates are counted from: zero, or a round place in the midst of points that lie far from it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tetsoup/types.h"

namespace tetsoup {

/// The origin for these points, by those of them that `corners` names: zero where floats are fine enough.
///
/// Else a multiple of a power of two that is about as large as the points' extent. What files hold as floats is then
/// kept without rounding, and what they hold with more digits is rounded as if it lay near zero.
/// Cost: O(points + corners).
Vec3d origin_of(std::span<const Vec3d> points, std::span<const std::uint32_t> corners);

/// The nearest floats to point - origin; what is beyond their range is infinite.
std::vector<Vec3> counted_from(const Vec3d& origin, std::span<const Vec3d> points);

/// Points counted from one origin as if counted from another; the same bits where the two are one.
std::vector<Vec3> recounted(std::span<const Vec3> points, const Vec3d& from, const Vec3d& to);

/// placed() of all.
std::vector<Vec3d> placed_points(std::span<const Vec3> points, const Vec3d& origin);

template <std::size_t kCorners>
std::span<const std::uint32_t> flat(std::span<const std::array<std::uint32_t, kCorners>> items) {
  return {items.empty() ? nullptr : items.front().data(), kCorners * items.size()};
}

}  // namespace tetsoup
