#include "simulate/held_elastic.h"

#include <algorithm>
#include <cmath>

namespace tetsoup::simulate {
namespace {

Matrix3 transposed(const Matrix3& m) {
  const auto& [a, b, c] = m.rows;
  return {{{{a.x, b.x, c.x}, {a.y, b.y, c.y}, {a.z, b.z, c.z}}}};
}
Matrix3 minus(const Matrix3& a, const Matrix3& b) {
  return {{a.rows[0] - b.rows[0], a.rows[1] - b.rows[1], a.rows[2] - b.rows[2]}};
}
double squared_size(const Matrix3& m) {
  return squared_length(m.rows[0]) + squared_length(m.rows[1]) + squared_length(m.rows[2]);
}
Matrix3 product(const Matrix3& a, const Matrix3& b) {
  return {{b.column_times(a.rows[0]), b.column_times(a.rows[1]), b.column_times(a.rows[2])}};
}

Matrix3 deformation_gradient(const HeldTet& held, const Tet& tet, std::span<const Vec3d> places) {
  Matrix3 f;
  for (std::size_t i = 1; i < 4; ++i) {
    const Vec3d edge = places[tet[i]] - places[tet[0]];
    f.rows[0] += held.gradients[i] * edge.x;
    f.rows[1] += held.gradients[i] * edge.y;
    f.rows[2] += held.gradients[i] * edge.z;
  }
  return f;
}

/// To the rotation nearest to F, by the steps of kernel::relax_tets() until nothing changes.
Matrix3 follow(Turn& turn, const Matrix3& f) {
  constexpr int kMostSteps = 20;
  constexpr double kEnough = 1e-24;  // half an angle, squared
  Matrix3 r = to_matrix(turn);
  for (int step = 0; step < kMostSteps; ++step) {
    const Matrix3 rt = transposed(r), ft = transposed(f);
    const Vec3d torque = cross(rt.rows[0], ft.rows[0]) + cross(rt.rows[1], ft.rows[1]) + cross(rt.rows[2], ft.rows[2]);
    const double trace = dot(rt.rows[0], ft.rows[0]) + dot(rt.rows[1], ft.rows[1]) + dot(rt.rows[2], ft.rows[2]);
    const double scale = 0.5 / (std::max(2.0 / 3 * std::abs(trace), 0.5 * length(torque)) + 1e-20);
    const Vec3d s = torque * scale;
    turn = unit({turn.v + s * turn.w + cross(s, turn.v), turn.w - dot(s, turn.v)});
    r = to_matrix(turn);
    if (squared_length(s) < kEnough) break;
  }
  return r;
}

/// Adds scale a b.
void add(Matrix3& to, const Matrix3& m, double scale) {
  for (std::size_t i = 0; i < 3; ++i) to.rows[i] += m.rows[i] * scale;
}

/// Adds the stress of viscosity, and returns what is dissipated: with A = R0^T (F - F0), twice the elastic energy of
/// sym A, by rate / 2.
double add_viscosity(const Rest& rest, const Matrix3& f, const Matrix3& turned, const Matrix3& start, double rate,
                     Matrix3& stress) {
  const Matrix3 a = product(transposed(turned), minus(f, start)), at = transposed(a);
  const double trace = a.rows[0].x + a.rows[1].y + a.rows[2].z, mu = rest.shear_modulus(), lame = rest.lame();
  Matrix3 symmetric;
  for (std::size_t i = 0; i < 3; ++i) symmetric.rows[i] = (a.rows[i] + at.rows[i]) * 0.5;
  const double energy = rate * (mu * squared_size(symmetric) + lame / 2 * trace * trace);
  for (Vec3d& row : symmetric.rows) row = row * (2 * mu);
  symmetric.rows[0].x += lame * trace;
  symmetric.rows[1].y += lame * trace;
  symmetric.rows[2].z += lame * trace;
  add(stress, product(turned, symmetric), rate);
  return energy;
}

}  // namespace

Matrix3 to_matrix(const Turn& turn) {
  const auto [x, y, z] = turn.v;
  const double w = turn.w;
  return {{{{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
            {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
            {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}}}};
}

Turn unit(const Turn& turn) {
  const double square = squared_length(turn.v) + turn.w * turn.w;
  if (!(square > 0)) return {};
  const double scale = 1 / std::sqrt(square);
  return {turn.v * scale, turn.w * scale};
}

std::vector<HeldTet> held_tets(const Rest& rest) {
  std::vector<HeldTet> tets;
  for (const Tet& tet : rest.piece.tets) {
    const TetCorners p = corners_at(rest.piece.places, tet);
    tets.push_back({barycentric_gradients(p), signed_volume(p)});
  }
  return tets;
}

double elastic_energy(const Rest& rest, std::span<const HeldTet> tets, std::span<const Vec3d> places,
                      const Viscosity* viscosity, std::span<Turn> turns, std::span<Vec3d> gradient) {
  const double mu = rest.shear_modulus(), lame = rest.lame();
  double sum = 0;
  for (std::size_t t = 0; t < tets.size(); ++t) {
    const HeldTet& held = tets[t];
    const Tet& tet = rest.piece.tets[t];
    const Matrix3 f = deformation_gradient(held, tet, places);
    const Matrix3 e = minus(f, follow(turns[t], f));
    const Matrix3 cofactor{{cross(f.rows[1], f.rows[2]), cross(f.rows[2], f.rows[0]), cross(f.rows[0], f.rows[1])}};
    const double change = dot(f.rows[0], cofactor.rows[0]) - 1;
    double energy = mu * squared_size(e) + lame / 2 * change * change;
    Matrix3 stress;
    add(stress, e, 2 * mu);
    add(stress, cofactor, lame * change);
    if (viscosity != nullptr)
      energy += add_viscosity(rest, f, viscosity->turned[t], viscosity->gradients[t], viscosity->rate, stress);
    sum += held.volume * energy;
    if (gradient.empty()) continue;
    for (std::size_t i = 0; i < 4; ++i) gradient[tet[i]] += stress * (held.gradients[i] * held.volume);
  }
  return sum;
}

void begin_viscosity(const Rest& rest, std::span<const HeldTet> tets, std::span<const Vec3d> places,
                     std::span<Turn> turns, Viscosity& viscosity) {
  viscosity.turned.resize(tets.size());
  viscosity.gradients.resize(tets.size());
  for (std::size_t t = 0; t < tets.size(); ++t) {
    viscosity.gradients[t] = deformation_gradient(tets[t], rest.piece.tets[t], places);
    viscosity.turned[t] = follow(turns[t], viscosity.gradients[t]);
  }
}

}  // namespace tetsoup::simulate
