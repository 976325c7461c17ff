// One name for every position.
#pragma once

#include <cstdint>
#include <vector>

#include "tetsoup/types.h"

namespace tetsoup {

struct MergedVertices {
  static constexpr std::uint32_t kUnused = 0xFFFFFFFFU;
  std::vector<Vec3> positions;       ///< Distinct, in lexicographic order; -0 becomes +0.
  std::vector<std::uint32_t> names;  ///< Of every vertex, its position's index; kUnused where no triangle has it.
};

/// Its indices are in range and its coordinates finite.
bool is_usable(const TriangleSoup& soup, const Triangle& triangle);

/// Merges the triangles' vertices and renames the triangles' indices to match. Coordinates are finite.
/// O(vertices + triangles).
MergedVertices merge_vertices(const std::vector<Vec3>& vertices, std::vector<Triangle>& triangles);

}  // namespace tetsoup
