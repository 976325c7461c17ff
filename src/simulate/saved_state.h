// What changes while a simulation runs, as bytes.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "simulate/world.h"

namespace tetsoup::simulate {

std::vector<std::byte> save_state(const World& world);
/// @throws InvalidInput  if the bytes are damaged, or of a world that was built otherwise; it is left as it was.
void restore_state(World& world, std::span<const std::byte> bytes);

}  // namespace tetsoup::simulate
