// Which triangles hang together, and which of what hangs together is a closed surface.
#pragma once

#include <cstdint>
#include <span>

#include "base/parallel.h"
#include "tetsoup/soup.h"

namespace tetsoup {

/// How the copies of a triangle run around it.
enum class WindingOf : std::uint8_t {
  Ascending,  ///< From its lowest vertex to the middle one, to the highest.
  Turned,
  Both,  ///< Some one way, some the other: that says nothing.
};

/// @param soup  Vertices merged, indices of each triangle ascending, no triangle twice.
SoupParts find_parts(const TriangleSoup& soup, std::span<const WindingOf> windings, StageWatch& watch);

}  // namespace tetsoup
