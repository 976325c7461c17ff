// What a soup says of itself that a mesh of it can be compared with.
#pragma once

#include <cstdint>
#include <vector>

#include "tetsoup/types.h"

namespace tetsoup {

struct SoupFacts {
  std::vector<std::uint32_t> part;  ///< Of every triangle: which triangles hang together through vertices.
  std::uint32_t parts = 0;
  bool closed = false;            ///< Every edge has two triangles, and all can be turned alike: it has an inside.
  std::vector<std::int8_t> turn;  ///< Of every triangle of a closed soup: -1 where it looks inwards as it is given.
  double volume = 0;              ///< Of a closed soup: the sum over its parts,
  double area = 0;                ///< and of its triangles.
  double tunnels = 0;             ///< Through a closed soup, over all parts.
  bool flat = false;              ///< Closed, and no edge bends by an angle between flat and sharp.
};

/// Positions are distinct, as clean_soup() leaves them; triangles with two equal corners are passed over. Windings
/// count where they agree all over the soup, as one outside; else each part is turned so that its volume is positive.
/// O(n), but for sorting what meets at one vertex.
SoupFacts find_soup_facts(const TriangleSoup& soup);

inline bool is_triangle(const Triangle& t) {
  return t[0] != t[1] && t[1] != t[2] && t[2] != t[0];
}

/// Parts less half the Euler characteristic of a closed surface: its handles.
double count_tunnels(const std::vector<Triangle>& triangles, std::size_t vertex_count);

}  // namespace tetsoup
