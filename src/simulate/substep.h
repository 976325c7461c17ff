// One substep of all parts, as if nothing touched them.
#pragma once

#include "simulate/world.h"

namespace tetsoup::simulate {

/// What SimulationOptions count their substeps in, s. Not the caller's step: bodies would be as stiff as it is short.
inline constexpr double kSubstepsTime = 1.0 / 60;

/// As the options ask for, s.
double longest_substep(const World& world);

/// Equal substeps that a step of dt takes: none longer than asked for, or than what stiffness or stability needs.
int count_substeps(const World& world, double dt);

/// Brings all that depends on the substep's length up to date.
void prepare_substeps(World& world, double h);

/// Gravity, elasticity, damping: afterwards places are still where the substep began, and moves lead on from there.
void move_freely(World& world, double h);

/// Places are where the moves have led.
void arrive(World& world);

}  // namespace tetsoup::simulate
