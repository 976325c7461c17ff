// Drawing the boundary to the surface of the pseudo volume.
#pragma once

#include "base/parallel.h"
#include "smooth/connectivity.h"
#include "smooth/guard.h"
#include "tetsoup/smooth.h"

namespace tetsoup {

/// Fits the boundary in `passes` steps, then brings the volume near the target's, if it began near that of the voxels
/// or the fit took a little too much.
/// @return  The volume aimed at; 0 where it was left to the fit.
double fit_to_surface(const Connectivity& links, const SmoothTarget& target, int passes, GuardedMesh& mesh,
                      StageWatch& watch);

}  // namespace tetsoup
