// What the mesh must cover, or must not, besides what density says.
#pragma once

#include <cstddef>
#include <span>

#include "base/parallel.h"
#include "lattice/candidates.h"

namespace tetsoup {

/// Keeps every tet that holds something of the body.
void keep_cover(Candidates& candidates);

/// Keeps a tet around every point that no kept tet holds: of those that hold it the one with most inside. One tet
/// around every point is marked kHeld. Points that no candidate holds are left out. Returns the tets kept. Cost: O(tets
/// + points), all threads.
std::size_t keep_enclosing_tets(Candidates& candidates, std::span<const Vec3> points, StageWatch& watch);

/// The same with tets of their own: copies at the end with vertices of their own, which touch nothing. For points that
/// the clean-up left out because a tet there can only hang by an edge or a vertex.
std::size_t enclose_apart(Candidates& candidates, std::span<const Vec3> points, StageWatch& watch);

/// Keeps the tets that are inside altogether, and removes the others from the candidates, so that nobody adds them; if
/// there are none, those that are so most.
void keep_inside_tets(Candidates& candidates);

}  // namespace tetsoup
