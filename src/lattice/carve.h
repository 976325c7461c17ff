// From the cover of a body to the mesh: tets go one by one where nothing is torn, closed or lost by it.
#pragma once

#include <cstddef>

#include "base/parallel.h"
#include "lattice/candidates.h"
#include "tetsoup/lattice.h"

namespace tetsoup {

/// The first step of carve(): tets that hold next to nothing go, as far as what they hold is near a dense tet. What is
/// left of the cover of a thick part shows what it touches, and what it does not.
void trim_slivers(Candidates& candidates, double dense, const BitGrid& body, StageWatch& watch);

/// Carves a cover, that is the kept tets, down to the tets of which at least `dense` is in the body.
///
/// A tet can be no fuller than a wall that passes through it: in thin zones none is dense. So density only says in
/// which order tets go, the emptiest first. One goes if it meets the boundary of the mesh in a disc, which changes
/// neither pieces nor tunnels nor voids, and if what it holds, and what those held that went before, stays near a tet
/// of the mesh. Where the body is thick that leaves what is dense; a wall keeps one layer without holes, a rod a
/// string of tets to its end. What only touches in the cover is joined first, so that a body that hangs together gives
/// one piece.
///
/// Tets that are marked kHeld stay: what encloses a point is joined to the body by whatever the cover has between.
///
/// @param dense  Above 1: no tet stays for its density.
/// @return  Tets left that are not dense; they are marked kHeld.
/// Cost: O(tets log tets).
std::size_t carve(Candidates& candidates, double dense, const BitGrid& body, TopologyReport& report, StageWatch& watch);

}  // namespace tetsoup
