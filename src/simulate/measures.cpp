#include "simulate/measures.h"

#include <array>
#include <cmath>

#include "base/hash.h"

namespace tetsoup::simulate {
namespace {

using Matrix = std::array<Vec3d, 3>;  ///< Rows.

Vec3d velocity_of(const kernel::Motion& m) {
  return {m.x, m.y, m.z};
}

TetCorners corners_in(const World& world, const Part& part, const Tet& tet) {
  TetCorners p;
  for (std::size_t i = 0; i < 4; ++i) p[i] = world.place(part.begin + tet[i]);
  return p;
}

Matrix deformation_gradient(const TetCorners& now, const TetCorners& rest) {
  const std::array<Vec3d, 4> g = barycentric_gradients(rest);
  Matrix f{};
  for (std::size_t i = 0; i < 4; ++i) {
    f[0] += g[i] * now[i].x;
    f[1] += g[i] * now[i].y;
    f[2] += g[i] * now[i].z;
  }
  return f;
}

Matrix rotation_in(const kernel::TetRotations& rotations, std::size_t lane) {
  const double x = static_cast<double>(rotations.q[0][lane]), y = static_cast<double>(rotations.q[1][lane]),
               z = static_cast<double>(rotations.q[2][lane]), w = static_cast<double>(rotations.q[3][lane]);
  return {{{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
           {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
           {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}}};
}

/// mu V |F - R|^2 + lambda V / 2 (det F - 1)^2, with R as the last substep left it.
double elastic_energy(const World& world, const Part& part) {
  const Rest& rest = world.rest_of(part);
  double sum = 0;
  for (std::size_t t = 0; t < rest.piece.tets.size(); ++t) {
    const Tet& tet = rest.piece.tets[t];
    const TetCorners at_rest = corners_at(rest.piece.places, tet);
    const Matrix f = deformation_gradient(corners_in(world, part, tet), at_rest);
    const Matrix r = rotation_in(part.rotations[rest.lanes[t] / kernel::kTetLanes], rest.lanes[t] % kernel::kTetLanes);
    const double change = dot(f[0], cross(f[1], f[2])) - 1;
    const double deviation = squared_length(f[0] - r[0]) + squared_length(f[1] - r[1]) + squared_length(f[2] - r[2]);
    sum += signed_volume(at_rest) * (rest.shear_modulus() * deviation + rest.lame() / 2 * change * change);
  }
  return sum;
}

}  // namespace

Energy measure_energy(const World& world) {
  Energy energy;
  for (const Part& part : world.parts) {
    const Rest& rest = world.rest_of(part);
    energy.elastic += world.options.solver == Solver::Implicit
                          ? elastic_energy(world, part)
                          : potential_energy(world.nets[part.rest], world.places_of(part));
    for (std::size_t v = 0; v < rest.masses.size(); ++v) {
      if (rest.held[v] != 0) continue;
      energy.kinetic += rest.masses[v] * squared_length(velocity_of(world.motions[part.begin + v])) / 2;
      energy.gravity -= rest.masses[v] * dot(world.options.gravity, world.place(part.begin + v));
    }
  }
  return energy;
}

Momentum measure_momentum(const World& world, std::size_t first_part, std::size_t part_count) {
  Momentum momentum;
  for (std::size_t i = first_part; i < first_part + part_count; ++i) {
    const Part& part = world.parts[i];
    const Rest& rest = world.rest_of(part);
    for (std::size_t v = 0; v < rest.masses.size(); ++v) {
      const Vec3d p = velocity_of(world.motions[part.begin + v]) * rest.masses[v];
      momentum.linear += p;
      momentum.angular += cross(world.place(part.begin + v), p);
    }
  }
  return momentum;
}

double measure_volume(const World& world, const Body& body) {
  double sum = 0;
  for (std::size_t i = body.first_part; i < body.first_part + body.part_count; ++i)
    for (const Tet& tet : world.rest_of(world.parts[i]).piece.tets)
      sum += signed_volume(corners_in(world, world.parts[i], tet));
  return sum;
}

std::uint64_t hash_state(const World& world) {
  WordHash hash;
  for (const Part& part : world.parts) {
    for (const kernel::Place& p : world.slice(world.places, part))
      for (const float v : {p.x, p.y, p.z}) hash.add(bits_of(v));
    for (const kernel::Offset& r : world.slice(world.remainders, part))
      for (const float v : {r.x, r.y, r.z}) hash.add(bits_of(v));
    for (const kernel::Motion& m : world.slice(world.motions, part))
      for (const float v : {m.x, m.y, m.z}) hash.add(bits_of(v));
  }
  return hash.value();
}

}  // namespace tetsoup::simulate
