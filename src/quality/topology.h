// How the tets hang together, and whether their boundary is a closed surface.
#pragma once

#include "tetsoup/quality.h"

namespace tetsoup {

/// Fills the counts of components and of the boundary.
void measure_topology(const TetMesh& mesh, Quality& quality);

}  // namespace tetsoup
