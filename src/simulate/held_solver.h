// Held parts move by implicit midpoint steps of the coupled system, in double.
#pragma once

#include <memory>
#include <vector>

#include "simulate/held_elastic.h"

namespace tetsoup::simulate {

/// Near enough to the inverse of a step's system: factorised where the part is at rest, and turned with it. Depends on
/// what is given here alone, so a restored state goes on to the bit.
class HeldFactor {
 public:
  /// Of vertices that can move: 4 M / h^2 + stiffer K.
  HeldFactor(const Rest& rest, std::span<const HeldTet> tets, double h, double stiffer);
  ~HeldFactor();
  HeldFactor(const HeldFactor&) = delete;
  HeldFactor& operator=(const HeldFactor&) = delete;
  /// Held vertices get zeros; `turns` are those of the vertices.
  void solve(std::span<const Matrix3> turns, std::span<const Vec3d> right, std::span<Vec3d> left) const;
  bool is_for(const Rest& rest, double h, double stiffer) const;

 private:
  struct Factors;
  std::vector<std::uint8_t> held_;
  std::vector<std::uint32_t> numbers_;  ///< Of those that can move.
  double h_ = 0, stiffer_ = 0;
  std::unique_ptr<Factors> factors_;
};

/// What a held part keeps from step to step; all of it follows from its rest and the state.
struct HeldSystem {
  std::vector<HeldTet> tets;
  std::vector<Turn> turns;  ///< Of the tets.
  Viscosity viscosity;
  std::unique_ptr<HeldFactor> factor;
};

/// Places and velocities of a part's vertices.
struct HeldState {
  std::vector<Vec3d> places, velocities;
};

/// One step of h. Energy does not grow: what the midpoint rule would add is taken from the velocities.
/// Cost: a few solves with the factors; these are made anew where h has changed, or what is held.
HeldState held_step(const Rest& rest, HeldSystem& system, const HeldState& start, const Vec3d& gravity, double h);

}  // namespace tetsoup::simulate
