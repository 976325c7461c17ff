// One substep of all parts, as if nothing touched them.
#pragma once

#include "simulate/world.h"

namespace tetsoup::simulate {

/// Substeps that a step of dt takes: what was asked for, or as many as the potentials are stable with.
int count_substeps(const World& world, double dt);

/// Brings all that depends on the substep's length up to date.
void prepare_substeps(World& world, double h);

/// Gravity, elasticity, damping. Afterwards `start` holds where the substep began.
void move_freely(World& world, double h);

}  // namespace tetsoup::simulate
