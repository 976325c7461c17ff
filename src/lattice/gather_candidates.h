// From the lattice's cells to a mesh of the tets that may be kept.
#pragma once

#include "lattice/candidates.h"
#include "lattice/densities.h"

namespace tetsoup {

/// The tets of `filled` that hold an inside voxel or are kept, and all tets around their vertices.
Candidates gather_candidates(const FilledCells& filled, const LatticeFrame& frame, const LatticeTable& table);

}  // namespace tetsoup
