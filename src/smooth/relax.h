// Moves of single vertices to the least of what is wrong around them.
#pragma once

#include <vector>

#include "base/parallel.h"
#include "smooth/aims.h"
#include "smooth/connectivity.h"
#include "smooth/guard.h"

namespace tetsoup {

enum class Sweep { Forwards, Backwards };

/// One Newton step for every vertex, one after the other in the order of their numbers.
///
/// @param edge  Mean edge of the mesh at the start: the unit of length, so that the terms weigh the same at any scale.
void relax(const Connectivity& links, const std::vector<TriangleAim>& aims, double edge, Sweep sweep, GuardedMesh& mesh,
           StageWatch& watch);

}  // namespace tetsoup
