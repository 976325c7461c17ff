// Cells are doubled where separate parts of the volume pass through them.
#pragma once

#include <cstddef>

#include "base/parallel.h"
#include "lattice/candidates.h"
#include "lattice/voxel_parts.h"

namespace tetsoup {

struct Separated {
  std::size_t tets = 0;      ///< Copies made.
  std::size_t vertices = 0;  ///< Vertices doubled.
};

/// Gives each part of the volume its own copy of a kept tet if several parts pass through it that do not touch.
///
/// Parts are pieces of inside voxels within the tet (TetPieces). Copies of neighbouring tets are joined across their
/// face if their pieces touch through it, and get common vertices; elsewhere vertices are doubled [Molino04]. Pieces
/// that hang together within the tets around count as one, so that a notch or the grid's noise doubles nothing; where
/// nothing is apart, nothing changes, not a bit. A copy that is not dense enough by its own part goes if that part has
/// dense tets around it; of parts too thin to have any, the copies stay, and of tets marked kHeld.
///
/// Copies stand at the end, as doubled vertices do; a copy's density is its part's share.
/// Cost: O(tets + rows of voxels in mixed tets); the first half on all threads.
Separated separate(Candidates& candidates, const BitGrid& inside, const VoxelParts& parts, double rho_min,
                   StageWatch& watch);

}  // namespace tetsoup
