// The motion of a part in one substep: predicting it, and telling rigid motion from deformation.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "kernel/places.h"
#include "tetsoup/types.h"

namespace tetsoup::kernel {

/// Sums over the vertices with a mass m, about a centre: r = place - centre, d = what the move that came out lacks to
/// the one that was predicted.
struct MotionSums {
  enum { Mass, X, Y, Z, Xx, Yy, Zz, Xy, Xz, Yz, Dx, Dy, Dz, Rdx, Rdy, Rdz, kCount };
  std::array<double, kCount> values{};  ///< m, m r, m r r^T, m d, m r x d.
};

/// Displacement of a rigid body: t + turn x (p - centre).
struct RigidDisplacement {
  Vec3 t, turn;
};

/// The vertices of a part: all arrays in whole blocks, and equally long.
struct Movers {
  std::span<Place> places;
  std::span<Offset> remainders;  ///< What the floats of `places` lack.
  std::span<Offset> moves;       ///< In the substep that began there.
  std::span<Motion> motions;
};

/// Places are where the moves have led; what a float cannot hold of that stays in the remainders.
void arrive(const Movers& movers);

/// arrive(); then velocities += kick where a vertex can move; moves = h velocity.
void predict(const Movers& movers, const Vec3& kick, float h);

/// Brings vertices back that elasticity has moved farther than `most` from where they were predicted, or to where no
/// number is; the others stay to the bit.
/// @return  How many.
std::size_t hold_back(std::span<Offset> moves, std::span<const Motion> motions, float most, float h);

/// The same bits on every instruction set: sixteen partial sums in float, added in their order in double.
MotionSums sum_motion(const Movers& movers, const Vec3& centre, float h);

/// Adds the correction to the moves; velocities change by as much as moves differ from what was predicted. What is
/// right already is not rounded again, so that roundings do not add up over thousands of substeps.
void correct_motion(const Movers& movers, const Vec3& centre, const RigidDisplacement& correction, float h);

}  // namespace tetsoup::kernel
