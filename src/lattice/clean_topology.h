// Clean-up of what density left: crumbs, bubbles, tets that merely touch, tets with all vertices on the boundary.
#pragma once

#include "base/parallel.h"
#include "lattice/candidates.h"
#include "tetsoup/lattice.h"

namespace tetsoup {

/// Drops small components, fills bubbles, makes the boundary a closed 2-manifold (Touching::Mend: always), and treats
/// tets with four boundary vertices as the options say. Doubled vertices and split tets are appended to the candidates.
///
/// Adds tets from the candidates only, so a mesh that must stay within something is given no others. Drops tets marked
/// kHeld only where nothing else helps, and no component that has one. A second call changes nothing.
///
/// Cost: O(tets log tets).
TopologyReport clean_topology(Candidates& candidates, const TopologyOptions& options, StageWatch& watch);

}  // namespace tetsoup
