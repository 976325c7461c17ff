// What the edges and the connectivity of a soup say about it.
#pragma once

#include <cstddef>
#include <vector>

#include "tetsoup/soup.h"

namespace tetsoup {

/// Fills in components, edge counts and class. Vertices are already merged; triangles still have their winding and
/// their duplicates.
void diagnose(std::size_t vertex_count, const std::vector<Triangle>& triangles, SoupReport& report);

}  // namespace tetsoup
