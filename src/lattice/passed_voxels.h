// Voxels that are inside or that the soup passes through.
#pragma once

#include "base/parallel.h"
#include "lattice/densities.h"
#include "tetsoup/soup.h"
#include "tetsoup/types.h"

namespace tetsoup {

/// Thin parts that the pseudo volume misses, such as leaves and wires, hang together in these. Cost: O(soup's area in
/// voxels).
BitGrid passed_voxels(const BitGrid& inside, const CleanSoup& soup, StageWatch& watch);

/// Lists cells that only the soup passes through as well: `filled` gets the cells of `passed`, which must hold its own,
/// and the densities there as FilledCells::passed.
void add_passed(const FilledCells& passed, std::size_t tets_per_cell, FilledCells& filled);

}  // namespace tetsoup
