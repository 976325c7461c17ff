// How the boundary lies in space, and what hangs between its vertices.
#pragma once

#include <vector>

#include "base/tet_faces.h"
#include "tetsoup/quality.h"

namespace tetsoup {

/// Fills roughness, area and curvature of the boundary, and the counts of interior edges and faces between its
/// vertices.
void measure_surface(const TetMesh& mesh, const std::vector<TetFace>& faces, const std::vector<Triangle>& boundary,
                     Quality& quality);

}  // namespace tetsoup
