// The split of a cube in five tets: a regular one in the middle, four corners; mirrored in every other cell, so that
// the diagonals on shared faces match [Spillmann06 §4].
#pragma once

#include <array>
#include <cstdint>

#include "base/vec.h"
#include "lattice/lattice_frame.h"

namespace tetsoup {

inline constexpr std::size_t kTetsPerCell = 5;

/// Bits 0, 1, 2 of a cube corner are its offsets along x, y, z. Tet 0 is the middle; tets 1 to 4 hold the corners
/// (1,0,0), (0,1,0), (0,0,1) and (1,1,1). Positive in cells whose coordinates add up to an even number.
inline constexpr std::array<std::array<unsigned, 4>, kTetsPerCell> kEvenTets{{
    {0b000, 0b011, 0b110, 0b101},
    {0b001, 0b000, 0b101, 0b011},
    {0b010, 0b000, 0b011, 0b110},
    {0b100, 0b000, 0b110, 0b101},
    {0b111, 0b110, 0b011, 0b101},
}};

/// Cube corners of a tet; odd cells are mirrored along x, and two corners swapped to stay positive.
inline std::array<unsigned, 4> tet_corners(std::size_t tet, bool odd) {
  std::array<unsigned, 4> c = kEvenTets[tet];
  if (odd) c = {c[0] ^ 1U, c[2] ^ 1U, c[1] ^ 1U, c[3] ^ 1U};
  return c;
}

inline Vec3d corner_offset(unsigned corner) {
  return {static_cast<double>(corner & 1U), static_cast<double>(corner >> 1 & 1U),
          static_cast<double>(corner >> 2 & 1U)};
}

/// The tet that owns a point of the cell, by its coordinates in [0, 1); points on a face belong to the middle tet.
inline std::size_t owner_tet(Vec3d local, bool odd) {
  if (odd) local.x = 1 - local.x;
  const auto& [x, y, z] = local;
  if (x > y + z) return 1;
  if (y > x + z) return 2;
  if (z > x + y) return 3;
  if (x + y + z > 2) return 4;
  return 0;
}

}  // namespace tetsoup
