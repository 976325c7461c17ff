// On which side of a plane or a line a point lies, exactly.
#pragma once

#include "tetsoup/types.h"

namespace tetsoup {

/// Sign of dot(cross(b - a, c - a), d - a): 1, 0 or -1, exact for all floats up to 1e30 [Shewchuk97 §4].
/// Some 20 operations where rounding leaves no doubt, microseconds where the four are in a plane or nearly so.
int orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// A point of a plane.
struct PlanePoint {
  float x = 0, y = 0;
};

/// Sign of the cross product of b - a and c - a, as exact.
int orientation(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c);

}  // namespace tetsoup
