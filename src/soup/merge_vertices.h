// One name for every position.
#pragma once

#include <vector>

#include "tetsoup/types.h"

namespace tetsoup {

/// Distinct positions of the triangles' vertices in lexicographic order (-0 becomes +0); the triangles' indices are
/// renamed to match. Coordinates are finite. O(vertices + triangles).
std::vector<Vec3> merge_vertices(const std::vector<Vec3>& vertices, std::vector<Triangle>& triangles);

}  // namespace tetsoup
