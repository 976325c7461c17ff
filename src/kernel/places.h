// Where vertices are and how they move, as the kernels of the simulation see them: four floats each.
#pragma once

namespace tetsoup::kernel {

/// Places and motions are worked on in blocks of so many; arrays are padded to whole blocks with masses of zero.
inline constexpr int kPlaceBlock = 16;

struct alignas(16) Place {
  float x = 0, y = 0, z = 0;
  float inverse_mass = 0;  ///< 0 holds the vertex where it is.
};

struct alignas(16) Motion {
  float x = 0, y = 0, z = 0;  ///< Velocity.
  float mass = 0;
};

}  // namespace tetsoup::kernel
