// How far a convex region reaches up and down.
#pragma once

#include <array>
#include <span>

#include "tetsoup/types.h"

namespace tetsoup::kernel {

/// normal . w <= limit, with a unit normal and a limit that is not negative.
struct HalfSpace {
  Vec3 normal;
  float limit;
};

/// Directions +y, -y, +z, -z.
struct UpDown {
  std::array<float, 4> x, y, z;
};

/// How far {w: |w| <= radius, within all half-spaces} reaches along the directions, at most: each is written as a sum
/// of normals with positive weights, and a rest. Three rounds of greedy choice.
std::array<float, 4> cone_reach(const UpDown& directions, std::span<const HalfSpace> half_spaces, float radius);

}  // namespace tetsoup::kernel
