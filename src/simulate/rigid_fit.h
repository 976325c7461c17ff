// The rigid motion that has given momenta.
#pragma once

#include "kernel/rigid_motion.h"

namespace tetsoup::simulate {

struct RigidFit {
  Vec3d centre;  ///< Of mass, from the centre of the sums.
  kernel::RigidDisplacement displacement;
};

/// The rigid displacement about the centre of mass that has the linear and angular momentum that is missing. Parts
/// without extent in some direction, which tets of positive volume do not have at rest, do not turn.
RigidFit fit_rigid_motion(const kernel::MotionSums& sums);

}  // namespace tetsoup::simulate
