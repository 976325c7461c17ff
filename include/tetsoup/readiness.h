// tetsoup: will an engine simulate this mesh well, and what to change where not?
#pragma once

#include <string_view>
#include <vector>

#include "tetsoup/quality.h"
#include "tetsoup/types.h"

namespace tetsoup {

/// What the mesh is taken to be made of; a soft rubber by default.
struct Material {
  double density = 1000;       ///< kg/m^3, > 0.
  double young = 1e5;          ///< Young's modulus, Pa, > 0.
  double poisson = 0.4;        ///< Poisson ratio, [0, 0.5).
  double metres_per_unit = 1;  ///< Length of the mesh's unit, > 0: 0.001 for millimetres.
};

/// @throws InvalidInput  if a number is out of range.
void check_material(const Material& material);

/// One thing that simulations suffer from, measured.
struct ReadinessCheck {
  std::string_view name;   ///< For machines: "min_dihedral_deg".
  std::string_view title;  ///< For people: "smallest dihedral angle, degrees".
  double value = 0;        ///< What the mesh has,
  double limit = 0;        ///< and what it should have:
  bool at_least = false;   ///< at least that, or at most.
  bool passed = false;
  std::string_view advice;  ///< What to change if it does not pass.
};

struct Readiness {
  std::vector<ReadinessCheck> checks;
  bool passed = false;          ///< All of them.
  double mass = 0;              ///< kg.
  double stable_time_step = 0;  ///< s; 0 without a positive tet.
};

/// Checks a measured mesh for what engines need, and computes its mass and the explicit time step it allows.
///
/// The time step is a lower bound on 2 / omega_max of linear elasticity with lumped masses, so central differences are
/// stable with it whatever the shape [Irons72: no mode of the mesh is faster than the fastest of its elements]. For a
/// tet with gradients g of its barycentric coordinates, omega^2 <= 4 E / (density (1 - 2 nu)) times the largest
/// eigenvalue of the sum of g g^T. Damping, contact and other integrators change it; implicit ones do not need it.
///
/// @throws InvalidInput  if the material is out of range.
Readiness assess_readiness(const TetMesh& mesh, const Quality& quality, const Material& material = {});

/// The same of a mesh that was compared with its soup: what is lost, filled, thickened, torn, joined, pierced, dented
/// or lies in itself does not pass either. Several pieces do where the soup has as many.
Readiness assess_readiness(const TetMesh& mesh, const Quality& quality, const Fidelity& fidelity,
                           const Material& material = {});

}  // namespace tetsoup
