// Colours that tell bodies apart, in pictures as in .glb.
#pragma once

#include <array>
#include <cstddef>

#include "io/pictures/raster.h"

namespace tetsoup::animation::tones {

/// In turn; soft enough to be shaded, and far enough from each other for eyes that do not tell red from green.
inline constexpr std::array<Rgb, 8> kBodies{rgb(0x6fa3d8), rgb(0xf09a5d), rgb(0x78b88a), rgb(0xefc64f),
                                            rgb(0xb290cf), rgb(0x5fb7bd), rgb(0xe2879b), rgb(0x95a3b6)};
inline constexpr Rgb kObstacle = rgb(0xb7a48d);
inline constexpr Rgb kGround = rgb(0xdde3ea), kGroundLine = rgb(0xbcc7d3);

inline const Rgb& of_body(std::size_t body) {
  return kBodies[body % kBodies.size()];
}

}  // namespace tetsoup::animation::tones
