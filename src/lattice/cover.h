// What the mesh must cover, or must not, besides what density says.
#pragma once

#include <cstddef>
#include <span>

#include "base/parallel.h"
#include "lattice/candidates.h"

namespace tetsoup {

/// Keeps a tet around every point that no kept tet holds: of those that hold it the one with most inside. Points that
/// no candidate holds are left out. Returns the tets kept. Cost: O(tets + points), all threads.
std::size_t keep_enclosing_tets(Candidates& candidates, std::span<const Vec3> points, StageWatch& watch);

/// Keeps the tets that are inside altogether and no others; if there are none, those that are so most.
void keep_inside_tets(Candidates& candidates);

}  // namespace tetsoup
