// Vertices for copies of tets: common where the copies are joined through faces, doubled elsewhere.
#pragma once

#include <vector>

#include "lattice/copies.h"

namespace tetsoup {

/// A copy and the vertices it gets.
struct CopiedTet {
  std::uint32_t tet, copy;
  Tet vertices;
};

struct CopyVertices {
  std::vector<CopiedTet> tets;         ///< By tet, then by copy.
  std::vector<std::uint32_t> sources;  ///< Of the vertices beyond the mesh's: those that they double.
};

/// Corners at a vertex are one if faces join them there [Molino04]. Copies that merely touch at a vertex keep it in
/// common unless they are apart: to mend that is up to others. The first tet around a vertex keeps its number.
CopyVertices number_vertices(const Candidates& candidates, Copies& copies, const PieceGraph& graph);

}  // namespace tetsoup
