// Moves of single vertices to the least of what is wrong around them.
#pragma once

#include <vector>

#include "base/parallel.h"
#include "smooth/aims.h"
#include "smooth/connectivity.h"
#include "smooth/guard.h"
#include "smooth/soup_points.h"

namespace tetsoup {

enum class Sweep { Forwards, Backwards };

/// Where the boundary should come to lie.
struct BoundaryAims {
  std::vector<TriangleAim> triangles;
  Groups<Pull> pulls;                 ///< By triangle; empty where no soup is given.
  std::vector<std::uint8_t> creased;  ///< By vertex: it lies between planes and may bend; empty where there are none.
};

/// One Newton step for every vertex, one after the other in the order of their numbers.
///
/// @param edge  Mean edge of the mesh at the start: the unit of length, so that the terms weigh the same at any scale.
void relax(const Connectivity& links, const BoundaryAims& aims, double edge, Sweep sweep, GuardedMesh& mesh,
           StageWatch& watch);

}  // namespace tetsoup
