// What the edges and the connectivity of a soup say about it.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/groups.h"
#include "base/parallel.h"
#include "tetsoup/soup.h"

namespace tetsoup {

/// A triangle but for its lowest vertex, which names its group.
struct RestOfTriangle {
  std::uint32_t middle, high;
  bool turned;  ///< It runs from its lowest vertex to the highest, to the middle one.
  auto operator<=>(const RestOfTriangle&) const = default;
};

/// All triangles, by their lowest vertex, each group in order.
using OrderedTriangles = Groups<RestOfTriangle>;

/// Fills in components, edge counts and class. Vertices are already merged; triangles still have their winding and
/// their duplicates.
void diagnose(const OrderedTriangles& triangles, SoupReport& report, StageWatch& watch);

}  // namespace tetsoup
