#include "simulate/potentials.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace tetsoup::simulate {
namespace {

/// Springs in all directions, six a tet, of k each: shear modulus and first Lame parameter are both 0.4 k / V.
constexpr double kSpringsForShear = 2.5;
/// Of the bound from Gershgorin's circles at rest; compression stiffens.
constexpr double kStepMargin = 0.5;

/// What a potential is about, and its gradient for each corner.
template <std::size_t N>
struct Measure {
  double value = 0;
  std::array<Vec3d, N> gradient;
};

Measure<2> measure(const std::array<Vec3d, 2>& p) {
  const Vec3d edge = p[1] - p[0];
  const double size = length(edge);
  if (!(size > 0)) return {};
  const Vec3d along = edge * (1 / size);
  return {size, {along * -1, along}};
}
Measure<3> measure(const std::array<Vec3d, 3>& p) {
  const Vec3d normal = cross(p[1] - p[0], p[2] - p[0]);
  const double size = length(normal);
  if (!(size > 0)) return {};
  const Vec3d n = normal * (0.5 / size);
  return {size / 2, {cross(n, p[2] - p[1]), cross(n, p[0] - p[2]), cross(n, p[1] - p[0])}};
}
Measure<4> measure(const std::array<Vec3d, 4>& p) {
  const Vec3d a = p[1] - p[0], b = p[2] - p[0], c = p[3] - p[0];
  const Vec3d g1 = cross(b, c) * (1.0 / 6), g2 = cross(c, a) * (1.0 / 6), g3 = cross(a, b) * (1.0 / 6);
  return {dot(a, g1), {(g1 + g2 + g3) * -1, g1, g2, g3}};
}

Vec3d velocity_of(const kernel::Motion& m) {
  return {m.x, m.y, m.z};
}

template <std::size_t N, class At>
Measure<N> measure_at(const Potential<N>& potential, const At& at) {
  std::array<Vec3d, N> p;
  for (std::size_t i = 0; i < N; ++i) p[i] = at(potential.corners[i]);
  return measure(p);
}

/// F_i = -(k C + k_d sum over j of dC/dp_j v_j) dC/dp_i [THMG04 eq. 7].
template <std::size_t N>
void add_forces_of(const std::vector<Potential<N>>& potentials, double damping_time, std::span<const Vec3d> places,
                   std::span<const kernel::Motion> motions, std::vector<Vec3d>& forces) {
  for (const Potential<N>& potential : potentials) {
    const Measure<N> m = measure_at(potential, [&](std::uint32_t v) { return places[v]; });
    double rate = 0;
    for (std::size_t i = 0; i < N; ++i) rate += dot(m.gradient[i], velocity_of(motions[potential.corners[i]]));
    const double pull =
        -potential.stiffness * (m.value - potential.rest + damping_time * rate) / (potential.rest * potential.rest);
    for (std::size_t i = 0; i < N; ++i) forces[potential.corners[i]] += m.gradient[i] * pull;
  }
}

template <std::size_t N>
double energy_of(const std::vector<Potential<N>>& potentials, std::span<const Vec3d> places) {
  double sum = 0;
  for (const Potential<N>& potential : potentials) {
    const double change = measure_at(potential, [&](std::uint32_t v) { return places[v]; }).value / potential.rest - 1;
    sum += potential.stiffness * change * change / 2;
  }
  return sum;
}

/// Adds to each corner's row of M^-1 K at rest: stiffness |dC/dp_i| sum over j of |dC/dp_j| / m_i.
template <std::size_t N>
void add_rows(const std::vector<Potential<N>>& potentials, const Rest& rest, std::vector<double>& rows) {
  for (const Potential<N>& potential : potentials) {
    const Measure<N> m = measure_at(potential, [&](std::uint32_t v) { return rest.piece.places[v]; });
    double sum = 0;
    for (const Vec3d& g : m.gradient) sum += length(g);
    for (std::size_t i = 0; i < N; ++i) {
      const std::uint32_t v = potential.corners[i];
      rows[v] += potential.stiffness / (potential.rest * potential.rest) * length(m.gradient[i]) * sum / rest.masses[v];
    }
  }
}

/// Every edge or triangle once, in a fixed order, its stiffness from the volume of the tets that have it.
template <std::size_t N>
void add_potentials(const std::map<std::array<std::uint32_t, N>, double>& volumes, const Rest& rest, double per_volume,
                    std::optional<double> given, std::vector<Potential<N>>& out) {
  for (const auto& [corners, volume] : volumes) {
    Potential<N> potential{corners, 0, given.value_or(per_volume * volume)};
    potential.rest = measure_at(potential, [&](std::uint32_t v) { return rest.piece.places[v]; }).value;
    if (potential.stiffness > 0 && potential.rest > 0) out.push_back(potential);
  }
}

}  // namespace

SpringNet make_spring_net(const Rest& rest, const PotentialOptions& options) {
  std::map<std::array<std::uint32_t, 2>, double> edges;
  std::map<std::array<std::uint32_t, 3>, double> triangles;
  SpringNet net;
  const double bulk_left = std::max(0.0, rest.lame() - rest.shear_modulus());
  for (const Tet& tet : rest.piece.tets) {
    const double volume = signed_volume(corners_at(rest.piece.places, tet));
    for (const auto& e : kTetEdges) {
      const std::uint32_t a = tet[static_cast<std::size_t>(e[0])], b = tet[static_cast<std::size_t>(e[1])];
      edges[{std::min(a, b), std::max(a, b)}] += volume;
    }
    for (const auto& f : kTetFaces) {
      std::array<std::uint32_t, 3> corners{tet[static_cast<std::size_t>(f[0])], tet[static_cast<std::size_t>(f[1])],
                                           tet[static_cast<std::size_t>(f[2])]};
      std::sort(corners.begin(), corners.end());
      triangles[corners] += volume;
    }
    const double stiffness = options.volume.value_or(bulk_left * volume);
    if (stiffness > 0) net.tets.push_back({tet, volume, stiffness});
  }
  add_potentials(edges, rest, kSpringsForShear * rest.shear_modulus(), options.distance, net.edges);
  add_potentials(triangles, rest, 0, options.area, net.triangles);
  std::vector<double> rows(rest.masses.size(), 0.0);
  add_rows(net.edges, rest, rows);
  add_rows(net.triangles, rest, rows);
  add_rows(net.tets, rest, rows);
  const double largest = *std::max_element(rows.begin(), rows.end());
  // Damping along the gradients by c = damping_time k: h (omega^2 h + 2 c omega^2) must stay below 4.
  const double undamped = 2 / std::sqrt(largest), d = rest.material.damping_time;
  net.stable_time_step = kStepMargin * (std::sqrt(d * d + undamped * undamped) - d);
  return net;
}

std::size_t add_forces(const SpringNet& net, const Rest& rest, std::span<const Vec3d> places,
                       std::span<kernel::Motion> motions, double kick, double most) {
  std::vector<Vec3d> forces(rest.masses.size());
  add_forces_of(net.edges, rest.material.damping_time, places, motions, forces);
  add_forces_of(net.triangles, rest.material.damping_time, places, motions, forces);
  add_forces_of(net.tets, rest.material.damping_time, places, motions, forces);
  std::size_t clamped = 0;
  for (std::size_t v = 0; v < forces.size(); ++v) {
    Vec3d change = forces[v] * (kick * rest.inverse_mass(v));
    const double speed = length(change);
    if (speed > most) {
      change = change * (most / speed);
      ++clamped;
    }
    const Vec3 velocity = to_float(velocity_of(motions[v]) + change);
    motions[v] = {velocity.x, velocity.y, velocity.z, motions[v].mass};
  }
  return clamped;
}

double potential_energy(const SpringNet& net, std::span<const Vec3d> places) {
  return energy_of(net.edges, places) + energy_of(net.triangles, places) + energy_of(net.tets, places);
}

}  // namespace tetsoup::simulate
