// Pairs of tets that lie in each other.
#pragma once

#include <cstddef>

#include "quality/mesh_skin.h"
#include "tetsoup/types.h"

namespace tetsoup {

struct OverlappingTets {
  std::size_t in_piece = 0;  ///< Pairs of one piece,
  std::size_t apart = 0;     ///< and of two pieces.
};

/// Pairs that no plane parts, by the faces of both and the products of their edges, to within a thousandth of the mean
/// edge. O(tets) where they are of like size.
OverlappingTets find_overlapping_tets(const TetMesh& mesh, const MeshSkin& skin);

}  // namespace tetsoup
