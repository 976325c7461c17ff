// Where vertices are and how they move, as the kernels of the simulation see them: four floats each.
#pragma once

namespace tetsoup::kernel {

/// Places and motions are worked on in blocks of so many; arrays are padded to whole blocks with masses of zero.
inline constexpr int kPlaceBlock = 16;

struct alignas(16) Place {
  float x = 0, y = 0, z = 0;
  float inverse_mass = 0;  ///< 0 holds the vertex where it is.
};

/// Where a vertex is, in parts of their own so that no sum of them loses what is small: the nearest float, what that
/// lacks, and what a substep has added since. A kilometre from the origin a float's grain is 60 um, and gravity moves a
/// body at rest by less than a micrometre in a substep.
struct alignas(16) Offset {
  float x = 0, y = 0, z = 0;
  float inverse_mass = 0;  ///< As the place has it.
};

struct alignas(16) Motion {
  float x = 0, y = 0, z = 0;  ///< Velocity.
  float mass = 0;
};

}  // namespace tetsoup::kernel
