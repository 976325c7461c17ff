// Whether two triangles meet, and how far apart they are.
#pragma once

#include <array>

#include "tetsoup/types.h"

namespace tetsoup {

using TriangleCorners = std::array<Vec3, 3>;

/// They share a point: exact, for all floats up to 1e30. Triangles without area are the segments or points they are.
bool triangles_meet(const TriangleCorners& a, const TriangleCorners& b);

/// Of two triangles that do not meet, in double precision.
double squared_distance(const TriangleCorners& a, const TriangleCorners& b);

/// The ray from `p` along +x crosses the triangle: exact. Each point beyond an edge or a corner is given to one of the
/// triangles around it, so that on a closed surface the count is odd where `p` lies inside; a triangle through `p` is
/// not crossed.
bool crosses_ahead(const TriangleCorners& triangle, const Vec3& p);

}  // namespace tetsoup
