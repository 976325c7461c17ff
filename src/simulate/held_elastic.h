// Elastic energy and viscosity of a held part, in double: what its implicit steps minimise.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "simulate/rest.h"

namespace tetsoup::simulate {

/// Rows.
struct Matrix3 {
  std::array<Vec3d, 3> rows{};

  Vec3d operator*(const Vec3d& v) const { return {dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)}; }
  /// Of the transpose.
  Vec3d column_times(const Vec3d& v) const { return rows[0] * v.x + rows[1] * v.y + rows[2] * v.z; }
};

/// x, y, z, w.
struct Turn {
  Vec3d v;
  double w = 1;
};
Matrix3 to_matrix(const Turn& turn);
/// Of no length: none at all.
Turn unit(const Turn& turn);

struct HeldTet {
  std::array<Vec3d, 4> gradients;
  double volume = 0;
};
std::vector<HeldTet> held_tets(const Rest& rest);

/// Viscosity about where a step began: stress grows by `rate` of what strain has changed since.
struct Viscosity {
  double rate = 0;
  std::vector<Matrix3> turned, gradients;  ///< R and F of the tets where the step began.
};

/// mu V |F - R|^2 + lambda V / 2 (det F - 1)^2 of all tets, and what they dissipate. Rotations are followed from what
/// they were to those nearest to F. Forces' negatives are added to `gradient`, unless it is empty.
double elastic_energy(const Rest& rest, std::span<const HeldTet> tets, std::span<const Vec3d> places,
                      const Viscosity* viscosity, std::span<Turn> turns, std::span<Vec3d> gradient);

/// Where a step begins.
void begin_viscosity(const Rest& rest, std::span<const HeldTet> tets, std::span<const Vec3d> places,
                     std::span<Turn> turns, Viscosity& viscosity);

}  // namespace tetsoup::simulate
