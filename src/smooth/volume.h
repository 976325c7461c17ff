// Keeping the volume: locally after each fairing step, and in total at the end.
#pragma once

#include <vector>

#include "base/parallel.h"
#include "smooth/connectivity.h"
#include "smooth/fairing.h"
#include "smooth/guard.h"

namespace tetsoup {

/// Gradient of the volume by each boundary vertex, in the order of Connectivity::boundary: a third of the area vectors
/// around it, outwards.
std::vector<Vec3d> volume_gradients(const Connectivity& links, const GuardedMesh& mesh);

/// Pushes the boundary's targets along the normals by the volume each vertex has swept since the start, after that has
/// spread over its neighbourhood [Spillmann06 §4]: what a whole region lost comes back, what one stair step lost does
/// not. Counted from the start and not from the last pass, so that many passes converge instead of drifting.
///
/// @param targets  In the order of Connectivity::boundary.
void restore_swept_volume(const Connectivity& links, const GuardedMesh& mesh, const BoundaryFlow& flow,
                          std::vector<Vec3d>& targets);

/// Brings the volume of every part back to what it was, by equal moves along the normals. A part that its limits keep
/// from it goes back towards its start until they do not; the start itself always does.
void restore_total_volume(const Connectivity& links, GuardedMesh& mesh, StageWatch& watch);

/// Brings the volume of the whole mesh near `wanted` by equal moves along the normals, as far as the limits allow.
void approach_volume(const Connectivity& links, double wanted, GuardedMesh& mesh, StageWatch& watch);

}  // namespace tetsoup
