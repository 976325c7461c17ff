// Drawing triangles within a mesh to planes.
#pragma once

#include <span>

#include "base/parallel.h"
#include "smooth/connectivity.h"
#include "smooth/guard.h"
#include "tetsoup/smooth.h"

namespace tetsoup {

/// One Newton step for every vertex in the order of their numbers, and one the other way round.
void draw(const Connectivity& links, std::span<const FaceAim> aims, GuardedMesh& mesh, StageWatch& watch);

/// Mean length of the edges.
double mean_edge(const Connectivity& links, const GuardedMesh& mesh);

}  // namespace tetsoup
