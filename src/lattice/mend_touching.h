// No tets that merely touch: the boundary of the mesh becomes a closed 2-manifold.
#pragma once

#include "base/parallel.h"
#include "lattice/tet_complex.h"
#include "tetsoup/lattice.h"

namespace tetsoup {

enum class Ways {
  All,          ///< Tets are added, dropped, or given vertices of their own, whichever is cheapest.
  Covering,     ///< Tets are added; vertices are doubled only where nothing else helps.
  JoiningOnly,  ///< Nothing is dropped.
  PartingOnly,  ///< Nothing is added.
};

/// Repairs every vertex around which the kept tets do not form a ball. A repair flips a few tets around such a vertex,
/// or doubles it. As long as one is found it must leave fewer such vertices than before, so this ends. Of those that
/// are left, the ones at held tets are mended by adding tets and doubling vertices alone as far as that goes, and the
/// rest by dropping tets and doubling vertices alone, which ends as well: when every tet stands alone at the latest,
/// and a lone tet is sound.
void mend_touching(TetComplex& complex, Ways ways, TopologyReport& report, StageWatch& watch);

}  // namespace tetsoup
