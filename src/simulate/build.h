// From meshes to parts of the world, and back to what the caller sees.
#pragma once

#include "simulate/world.h"

namespace tetsoup::simulate {

/// Adds bodies of one mesh at these poses, which share what they are made of; all or, if something is out of range,
/// none.
/// @throws InvalidInput
void add_bodies(World& world, const TetMesh& mesh, const SimMaterial& material, std::span<const Pose> poses);

enum class Hold { Held, Free };

/// Pins a vertex or lets it go.
void hold_vertex(World& world, std::uint32_t slot, Hold hold);

/// Copies places and velocities to where the caller sees them.
void publish(const World& world, Body& body);
void publish(World& world);

}  // namespace tetsoup::simulate
