// Potentials that keep lengths, areas and volumes, and the forces they exert [THMG04].
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "kernel/places.h"
#include "simulate/rest.h"

namespace tetsoup::simulate {

/// k/2 (value / rest - 1)^2 over the corners of one edge, triangle or tet.
template <std::size_t N>
struct Potential {
  std::array<std::uint32_t, N> corners;
  double rest;       ///< Length, area or volume.
  double stiffness;  ///< J.
};

struct SpringNet {
  std::vector<Potential<2>> edges;
  std::vector<Potential<3>> triangles;
  std::vector<Potential<4>> tets;
  double stable_time_step = 0;  ///< s; with a margin.
};

SpringNet make_spring_net(const Rest& rest, const PotentialOptions& options);

/// Velocities change by the forces over `kick` seconds; not by more than `most`.
/// @return  Vertices that were held back to it.
std::size_t add_forces(const SpringNet& net, const Rest& rest, std::span<const Vec3d> places,
                       std::span<kernel::Motion> motions, double kick, double most);

/// Energy of the net, J.
double potential_energy(const SpringNet& net, std::span<const Vec3d> places);

}  // namespace tetsoup::simulate
