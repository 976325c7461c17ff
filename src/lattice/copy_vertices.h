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

/// Corners at a vertex are one if faces join them there [Molino04]. A vertex at which kept tets merely touched before
/// is doubled only if separation parts some that were joined; the first tet around it keeps its number.
CopyVertices number_vertices(const Candidates& candidates, Copies& copies, const PieceGraph& graph);

}  // namespace tetsoup
