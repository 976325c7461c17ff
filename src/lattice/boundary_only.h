// Tets, interior faces and interior edges that have only boundary vertices: what is held at the boundary locks them.
#pragma once

#include "lattice/tet_complex.h"
#include "tetsoup/lattice.h"

namespace tetsoup {

/// Drops tets with four boundary vertices from thick parts, where the boundary stays manifold and what hangs together
/// stays so. Parts that are so thin that they have no vertex inside consist of nothing else, and are left as they are.
void remove_boundary_only(TetComplex& complex, TopologyReport& report);

/// Splits, at their middle, interior edges between boundary vertices, then interior faces with three, then tets with
/// four that are left. New tets and vertices are appended; the new vertices lie inside the mesh.
void split_boundary_only(Candidates& candidates, TopologyReport& report);

}  // namespace tetsoup
