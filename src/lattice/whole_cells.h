// Cells that planes along their own faces cut.
#pragma once

#include "lattice/densities.h"

namespace tetsoup {

/// In a lattice along flat sides of the soup: where what is inside a cell, or outside in it, is a box along the cell's
/// faces, all tets of the cell stand or fall by its density. Cut tet by tet, a side between two
/// faces of cells would leave tets with two faces on it, which cannot lie flat.
/// O(voxels of cells that are partly inside).
void level_flat_cells(const BitGrid& inside, const LatticeFrame& frame, const LatticeTable& table, double rho_min,
                      FilledCells& filled, StageWatch& watch);

}  // namespace tetsoup
