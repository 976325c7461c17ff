// Which of several tets in one place a point hangs on: that of its own connected piece of the soup.
#pragma once

#include <vector>

#include "embed/tet_finder.h"

namespace tetsoup {

/// Whether a point may hang on another piece's tets: where tets overlap, as copies do, or where the tets of a
/// triangle's corners do not hang together. O(tets + triangles), all threads; and a walk a long edge.
bool needs_own_copies(const TetMesh& mesh, const TriangleSoup& soup, const TetFinder& finder,
                      const std::vector<std::uint32_t>& tets, StageWatch& watch);

/// Moves points that hang on another piece's copy to their own. `tets` has the tet of every vertex of the soup.
///
/// Two points with a triangle in common hang together if a walk leads from one tet to the other through faces, close
/// by. Points in one tet only start; those that hang together form clusters, and of each connected piece of the soup
/// the largest cluster is right. A smaller one that lives in the tets of a larger one of another piece is a guest
/// there. Guests, and points that several tets hold, are then reached from the right ones, triangle by triangle, and
/// take the best tet that the walk finds. Where a piece has no right ones, its points stay.
/// @return  Points whose tet has changed.
/// Cost: O(triangles + long edges x tets along them).
std::size_t move_to_own_copies(const TetMesh& mesh, const TriangleSoup& soup, const TetFinder& finder,
                               std::vector<std::uint32_t>& tets, StageWatch& watch);

}  // namespace tetsoup
