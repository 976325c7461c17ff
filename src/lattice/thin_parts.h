// Tets for the parts of the soup that are too thin for density to keep any.
#pragma once

#include <cstddef>

#include "base/parallel.h"
#include "lattice/candidates.h"

namespace tetsoup {

/// Keeps tets along thin parts: chair legs, handles, leaves, wires.
///
/// A stretch of the soup has lost its cover where it hangs together in the voxels that are inside or that the soup
/// passes through (`passed`), touches no kept tet and nothing that fills one, and is longer than 1.5 lattice edges or
/// so: those of its tets are kept that it fills best. Then kept tets that density left in pieces are joined where the
/// volume hangs together, or the thin part, by the tets that add the least empty space. What is covered gets no
/// thicker.
///
/// @return  Tets kept. `candidates.passed` must be filled.
/// Cost: O(tets log tets + rows of voxels in mixed tets); nothing but O(tets) where all is covered and in one piece.
std::size_t keep_thin_parts(Candidates& candidates, const BitGrid& inside, const BitGrid& passed, StageWatch& watch);

}  // namespace tetsoup
