// One substep of all parts, as if nothing touched them.
#pragma once

#include "simulate/world.h"

namespace tetsoup::simulate {

/// What SimulationOptions count their substeps in, s. Not the caller's step: bodies would be as stiff as it is short.
inline constexpr double kSubstepsTime = 1.0 / 60;

/// As the options ask for, s.
double longest_substep(const World& world);

/// Substeps over which a part that is solved whole moves on evenly from one solve to the next.
struct Stretch {
  double length = 0;  ///< s
  bool begins = false;
};
/// Stretches of a step of dt: at most 1/60 s, and five of the substeps that the options ask for, or two where bodies
/// may meet.
int count_stretches(const World& world, double dt);

/// Which parts are solved whole: those that are held, hang on no spring or other vertex, and have at most 4,000 tets.
/// @return  Whether there are any.
bool choose_schemes(World& world);

/// Equal substeps that a step of dt takes: none longer than asked for, or than what stiffness or stability needs.
int count_substeps(const World& world, double dt);

/// Brings all that depends on the substep's length up to date.
void prepare_substeps(World& world, double h);

/// Gravity, elasticity, damping: afterwards places are still where the substep began, and moves lead on from there.
void move_freely(World& world, double h, const Stretch& stretch);

/// Velocities are those that the stretch ends with.
void end_stretch(World& world);

/// Places are where the moves have led.
void arrive(World& world);

}  // namespace tetsoup::simulate
