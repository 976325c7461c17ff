// One substep of all parts, as if nothing touched them.
#pragma once

#include "simulate/world.h"

namespace tetsoup::simulate {

/// Substeps that a step of dt takes: what was asked for, or as many as the potentials are stable with.
int count_substeps(const World& world, double dt);

/// Brings all that depends on the substep's length up to date.
void prepare_substeps(World& world, double h);

/// Gravity, elasticity, damping: afterwards places are still where the substep began, and moves lead on from there.
void move_freely(World& world, double h);

/// Places are where the moves have led.
void arrive(World& world);

}  // namespace tetsoup::simulate
