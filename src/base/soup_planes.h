// The planes in which triangles of a soup lie, connected or not.
#pragma once

#include <cstdint>
#include <vector>

#include "base/parallel.h"
#include "base/vec.h"
#include "tetsoup/types.h"

namespace tetsoup {

struct SoupPlane {
  Vec3d normal;  ///< Of length 1, to either side.
  double offset = 0;
  double area = 0;
};

struct SoupPlanes {
  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;
  std::vector<SoupPlane> planes;        ///< The largest first.
  std::vector<std::uint32_t> plane_of;  ///< By triangle of the soup; kNone for those of no plane.
  double area = 0;                      ///< Of the whole soup.
};

/// Planes whose triangles spread over a width both ways: `least_width`, or more where the soup's area is more than
/// 1,024 times its square. Triangles within a tenth of that from one plane, and within about two degrees, are taken for
/// one; what is bent by more is none. The same whatever the triangles' winding. O(triangles) where they are fine;
/// large ones are sorted and compared with the planes.
SoupPlanes find_planes(const TriangleSoup& soup, double least_width, StageWatch& watch);

}  // namespace tetsoup
