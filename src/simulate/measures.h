// Energies, momenta, volumes and the hash of a state.
#pragma once

#include "simulate/world.h"

namespace tetsoup::simulate {

Energy measure_energy(const World& world);
Momentum measure_momentum(const World& world, std::size_t first_part, std::size_t part_count);
double measure_volume(const World& world, const Body& body);
std::uint64_t hash_state(const World& world);

}  // namespace tetsoup::simulate
