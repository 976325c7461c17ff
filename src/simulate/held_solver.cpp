#include "simulate/held_solver.h"

#include <algorithm>
#include <cmath>
#include <deque>

namespace tetsoup::simulate {
namespace {

constexpr std::size_t kMemory = 8;  ///< Steps that the curvature is learned from [Nocedal06 7.2].
constexpr int kMostSteps = 40;
constexpr int kMostHalvings = 20;

using Vectors = std::vector<Vec3d>;

double dot(const Vectors& a, const Vectors& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += tetsoup::dot(a[i], b[i]);
  return sum;
}
void add(Vectors& to, const Vectors& v, double scale) {
  for (std::size_t i = 0; i < to.size(); ++i) to[i] += v[i] * scale;
}
double largest(const Vectors& v) {
  double most = 0;
  for (const Vec3d& p : v) most = std::max(most, squared_length(p));
  return std::sqrt(most);
}

/// Of the vertices, the mean of their tets'.
std::vector<Matrix3> vertex_turns(const Rest& rest, std::span<const Turn> turns) {
  std::vector<Turn> sums(rest.masses.size(), Turn{{}, 0});
  for (std::size_t t = 0; t < turns.size(); ++t)
    for (const std::uint32_t v : rest.piece.tets[t]) {
      Turn& sum = sums[v];
      const double side = tetsoup::dot(sum.v, turns[t].v) + sum.w * turns[t].w < 0 ? -1 : 1;
      sum = {sum.v + turns[t].v * side, sum.w + turns[t].w * side};
    }
  std::vector<Matrix3> out;
  for (const Turn& sum : sums) out.push_back(to_matrix(unit(sum)));
  return out;
}

/// 2 / h^2 |x - predicted|^2 by mass, elasticity and viscosity: least where the step's middle is.
class StepEnergy {
 public:
  StepEnergy(const Rest& rest, HeldSystem& system, const Vectors& predicted, double h)
      : rest_(rest), system_(system), predicted_(predicted), inertia_(4 / (h * h)) {}

  double value(const Vectors& places, Vectors& gradient) const {
    std::fill(gradient.begin(), gradient.end(), Vec3d{});
    double sum = elastic_energy(rest_, system_.tets, places, &system_.viscosity, system_.turns, gradient);
    for (std::size_t v = 0; v < places.size(); ++v) {
      if (rest_.held[v] != 0) {
        gradient[v] = {};
        continue;
      }
      const Vec3d off = places[v] - predicted_[v];
      gradient[v] += off * (inertia_ * rest_.masses[v]);
      sum += inertia_ / 2 * rest_.masses[v] * squared_length(off);
    }
    return sum;
  }

 private:
  const Rest& rest_;
  HeldSystem& system_;
  const Vectors& predicted_;
  double inertia_;
};

/// Quasi-Newton steps whose first guess of the curvature is the factorised system [Nocedal06 algorithm 7.4].
class Minimizer {
 public:
  Minimizer(const HeldFactor& factor, std::span<const Matrix3> turns) : factor_(factor), turns_(turns) {}

  Vectors direction(const Vectors& gradient) const {
    Vectors q = gradient, out(gradient.size());
    std::vector<double> alpha(pairs_.size());
    for (std::size_t i = pairs_.size(); i-- > 0;) {
      alpha[i] = pairs_[i].scale * dot(pairs_[i].step, q);
      add(q, pairs_[i].change, -alpha[i]);
    }
    factor_.solve(turns_, q, out);
    for (std::size_t i = 0; i < pairs_.size(); ++i)
      add(out, pairs_[i].step, alpha[i] - pairs_[i].scale * dot(pairs_[i].change, out));
    for (Vec3d& v : out) v = v * -1;
    return out;
  }
  void learn(Vectors step, Vectors change) {
    const double curvature = dot(step, change);
    if (!(curvature > 0)) return;
    if (pairs_.size() == kMemory) pairs_.pop_front();
    pairs_.push_back({std::move(step), std::move(change), 1 / curvature});
  }
  void forget() { pairs_.clear(); }

 private:
  struct Pair {
    Vectors step, change;
    double scale = 0;
  };
  const HeldFactor& factor_;
  std::span<const Matrix3> turns_;
  std::deque<Pair> pairs_;
};

/// Where a descent is.
struct Descent {
  Vectors x, gradient;
  double value = 0;
};

/// Along a direction, which becomes the step that is taken: halved until the energy is lower by enough [Armijo].
/// @return  False where that is less than rounding lets see.
bool go_down(const StepEnergy& energy, Vectors& direction, double slope, Descent& at) {
  constexpr double kSufficient = 1e-4;
  Descent next{{}, Vectors(at.x.size()), 0};
  double t = 1;
  for (int halving = 0; halving < kMostHalvings; ++halving, t /= 2) {
    next.x = at.x;
    add(next.x, direction, t);
    next.value = energy.value(next.x, next.gradient);
    if (!(next.value <= at.value + kSufficient * t * slope)) continue;
    for (Vec3d& v : direction) v = v * t;
    at = std::move(next);
    return true;
  }
  return false;
}

/// From x on to the least; every step goes down.
void minimize(const StepEnergy& energy, Minimizer& minimizer, double edge, Vectors& x) {
  constexpr double kEnough = 1e-5, kNothing = 1e-10;  // of what has been moved, of an edge
  Descent at{x, Vectors(x.size()), 0};
  at.value = energy.value(at.x, at.gradient);
  Vectors moved(x.size());
  for (int step = 0; step < kMostSteps; ++step) {
    Vectors d = minimizer.direction(at.gradient);
    if (!(dot(d, at.gradient) < 0)) {
      minimizer.forget();
      d = minimizer.direction(at.gradient);
    }
    const double slope = dot(d, at.gradient);
    Vectors change = at.gradient;
    if (!(slope < 0) || !go_down(energy, d, slope, at)) break;
    add(moved, d, 1);
    const bool done = largest(d) <= kEnough * largest(moved) + kNothing * edge;
    for (std::size_t v = 0; v < change.size(); ++v) change[v] = at.gradient[v] - change[v];
    minimizer.learn(std::move(d), std::move(change));
    if (done) break;
  }
  x = std::move(at.x);
}

/// Of motion, elasticity and weight.
double energy_of(const Rest& rest, HeldSystem& system, const HeldState& s, const Vec3d& gravity, double& kinetic) {
  double sum = elastic_energy(rest, system.tets, s.places, nullptr, system.turns, {});
  kinetic = 0;
  for (std::size_t v = 0; v < s.places.size(); ++v) {
    if (rest.held[v] != 0) continue;
    kinetic += rest.masses[v] * squared_length(s.velocities[v]) / 2;
    sum -= rest.masses[v] * tetsoup::dot(gravity, s.places[v] - rest.piece.places[v]);
  }
  return sum + kinetic;
}

bool is_sound(const HeldState& state) {
  return std::isfinite(dot(state.places, state.places) + dot(state.velocities, state.velocities));
}

}  // namespace

HeldState held_step(const Rest& rest, HeldSystem& system, const HeldState& start, const Vec3d& gravity, double h) {
  const double rate = 2 * rest.material.damping_time / h;
  if (system.tets.empty()) system.tets = held_tets(rest);
  if (system.factor == nullptr || !system.factor->is_for(rest, h, 1 + rate))
    system.factor = std::make_unique<HeldFactor>(rest, system.tets, h, 1 + rate);
  double kinetic = 0;
  const double before = energy_of(rest, system, start, gravity, kinetic);
  system.viscosity.rate = rate;
  begin_viscosity(rest, system.tets, start.places, system.turns, system.viscosity);
  Vectors predicted = start.places;
  for (std::size_t v = 0; v < predicted.size(); ++v)
    if (rest.held[v] == 0) predicted[v] += start.velocities[v] * (h / 2) + gravity * (h * h / 4);
  Vectors middle = start.places;
  const std::vector<Matrix3> turns = vertex_turns(rest, system.turns);
  Minimizer minimizer(*system.factor, turns);
  minimize(StepEnergy(rest, system, predicted, h), minimizer, rest.piece.mean_edge, middle);
  HeldState end = start;
  for (std::size_t v = 0; v < middle.size(); ++v) {
    if (rest.held[v] != 0) continue;
    const Vec3d moved = middle[v] - start.places[v];
    end.places[v] += moved * 2;
    end.velocities[v] = moved * (4 / h) - start.velocities[v];
  }
  if (!is_sound(end)) return {start.places, Vectors(start.places.size())};
  const double gained = energy_of(rest, system, end, gravity, kinetic) - before;
  if (gained > 0) {
    const double kept = kinetic > gained ? std::sqrt(1 - gained / kinetic) : 0;
    for (Vec3d& v : end.velocities) v = v * kept;
  }
  return end;
}

}  // namespace tetsoup::simulate
