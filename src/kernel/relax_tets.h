// Elasticity of tets, solved one batch of tets after the other.
#pragma once

#include <cstdint>
#include <span>

#include "kernel/places.h"

namespace tetsoup::kernel {

inline constexpr int kTetLanes = 16;
using TetLanes = float[kTetLanes];

/// Tets that share no vertex, and what they are made of. A lane that is not used has zeros everywhere, a compliance of
/// 1, and four times a vertex of no mass.
struct alignas(64) TetBatch {
  std::uint32_t corners[4][kTetLanes];
  TetLanes gradients[9];       ///< Of the barycentric coordinates of corners 1, 2, 3 at rest: x, y, z each.
  TetLanes responses[12];      ///< Corner i moves by -(F - R) responses[i] under the deviatoric energy: x, y, z each.
  TetLanes volume_compliance;  ///< Of det F = 1 in this substep: 1 / (lambda V h^2).
  TetLanes damping;            ///< Share of Substep::damped that counts for this tet, 0..1.
};

/// The rotation R nearest to each tet's deformation gradient F, as a quaternion x, y, z, w; followed from substep to
/// substep.
struct alignas(64) TetRotations {
  TetLanes q[4];
};

struct Substep {
  const Place* places;       ///< Where the substep began, and
  const Offset* remainders;  ///< what these floats lack; none where that is too little to count, which is faster.
  Offset* moves;             ///< From there, in this substep.
  /// damping_time / (damping_time + h): tets relax to this share of the strain that was there at the start, and their
  /// constants are 1 + damping_time / h times as stiff [Kelvin and Voigt].
  float damped = 0;
};

/// Moves the corners of every tet, batch after batch, to the least of inertia and elastic energy, first for
/// mu V |F - R|^2 and then for lambda V / 2 (det F - 1)^2, linearised.
///
/// The first is quadratic for a given R and solved in full: with S = 2 mu V h^2 sum of w g g^T over the corners, F - R
/// becomes (F - R) (I + S)^-1. R is followed by one Newton step towards the polar decomposition (exact where stretches
/// are equal), with at most a quarter turn, so inverted and flat tets have a rotation to return to.
/// The order is the same in every substep: sweeps to and fro would rest in two places by turns.
/// The same bits on every instruction set.
void relax_tets(std::span<const TetBatch> batches, std::span<TetRotations> rotations, const Substep& substep);

}  // namespace tetsoup::kernel
