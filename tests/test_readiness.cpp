#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "lattice_shapes.h"
#include "shapes.h"
#include "tetsoup/error.h"
#include "tetsoup/readiness.h"

namespace tetsoup {
namespace {

TetMesh bar() {
  return lattice_mesh({0, 0, 0}, {4, 3, 3}, 0.1, [](const TetCorners&) { return true; });
}

const ReadinessCheck& check_of(const Readiness& readiness, std::string_view name) {
  for (const ReadinessCheck& c : readiness.checks)
    if (c.name == name) return c;
  throw std::runtime_error("no check " + std::string(name));
}

Readiness assess(const TetMesh& mesh, const Material& material = {}) {
  return assess_readiness(mesh, measure_quality(mesh), material);
}

/// Accelerations of linear elasticity with lumped masses for displacements u.
std::vector<Vec3d> accelerations(const TetMesh& mesh, const Material& m, const std::vector<Vec3d>& u) {
  const double mu = m.young / (2 * (1 + m.poisson)),
               lambda = m.young * m.poisson / ((1 + m.poisson) * (1 - 2 * m.poisson));
  std::vector<Vec3d> force(u.size());
  std::vector<double> mass(u.size(), 0.0);
  for (const Tet& tet : mesh.tets) {
    TetCorners p;
    for (std::size_t i = 0; i < 4; ++i) p[i] = to_double(mesh.vertices[tet[i]]);
    const double volume = signed_volume(p);
    std::array<Vec3d, 4> g;
    std::array<std::array<double, 3>, 3> grad{};  // of the displacement
    for (std::size_t i = 0; i < 4; ++i) {
      const auto& f = kTetFaces[i];
      const Vec3d a = p[static_cast<std::size_t>(f[0])];
      g[i] = cross(p[static_cast<std::size_t>(f[1])] - a, p[static_cast<std::size_t>(f[2])] - a) * (-1 / (6 * volume));
      const std::array<double, 3> d{u[tet[i]].x, u[tet[i]].y, u[tet[i]].z}, n{g[i].x, g[i].y, g[i].z};
      for (std::size_t r = 0; r < 3; ++r)
        for (std::size_t c = 0; c < 3; ++c) grad[r][c] += d[r] * n[c];
    }
    std::array<std::array<double, 3>, 3> stress{};
    const double trace = grad[0][0] + grad[1][1] + grad[2][2];
    for (std::size_t r = 0; r < 3; ++r)
      for (std::size_t c = 0; c < 3; ++c) stress[r][c] = mu * (grad[r][c] + grad[c][r]) + (r == c ? lambda * trace : 0);
    for (std::size_t i = 0; i < 4; ++i) {
      const auto along = [&](std::size_t r) {
        return stress[r][0] * g[i].x + stress[r][1] * g[i].y + stress[r][2] * g[i].z;
      };
      force[tet[i]] += Vec3d{along(0), along(1), along(2)} * -volume;
      mass[tet[i]] += m.density * volume / 4;
    }
  }
  for (std::size_t v = 0; v < u.size(); ++v) force[v] = force[v] * (1 / mass[v]);
  return force;
}

/// 2 / omega_max by power iteration: the time step at which central differences become unstable.
double critical_time_step(const TetMesh& mesh, const Material& material) {
  test::Random random(3);
  std::vector<Vec3d> u(mesh.vertices.size());
  for (Vec3d& v : u) v = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
  double square = 0;
  for (int i = 0; i < 2000; ++i) {
    std::vector<Vec3d> a = accelerations(mesh, material, u);
    double sum = 0;
    for (const Vec3d& v : a) sum += dot(v, v);
    square = std::sqrt(sum);
    for (std::size_t v = 0; v < u.size(); ++v) u[v] = a[v] * (1 / square);
  }
  return 2 / std::sqrt(square);
}

TEST(Readiness, TheTimeStepIsStableAndNotFarBelowTheLargestThatIs) {
  const TetMesh one =
      lattice_mesh({0, 0, 0}, {1, 1, 1}, 0.1, [](const TetCorners& p) { return p[0].x + p[0].y + p[0].z < 0.01; });
  for (const double poisson : {0.0, 0.3, 0.45}) {
    Material material;
    material.poisson = poisson;
    for (const TetMesh& mesh : {bar(), one}) {
      const double step = assess(mesh, material).stable_time_step, critical = critical_time_step(mesh, material);
      EXPECT_LE(step, critical * 1.0001);
      EXPECT_GT(step, 0.3 * critical);
    }
  }
}

TEST(Readiness, UnitsAreMetresKilogramsAndPascals) {
  const TetMesh mesh = bar();
  Material material;
  const Readiness metres = assess(mesh, material);
  EXPECT_NEAR(metres.mass, 1000 * 0.4 * 0.3 * 0.3, 1e-4);
  material.metres_per_unit = 0.001;
  const Readiness millimetres = assess(mesh, material);
  EXPECT_NEAR(millimetres.mass, metres.mass * 1e-9, 1e-13);
  EXPECT_NEAR(millimetres.stable_time_step, metres.stable_time_step * 1e-3, 1e-10);
  material.metres_per_unit = 1;
  material.young *= 4;
  EXPECT_NEAR(assess(mesh, material).stable_time_step, metres.stable_time_step / 2, 1e-9);
}

TEST(Readiness, ALatticeOfTwoCubesThatTouchAtAnEdgeFailsTheChecksThatSayIt) {
  const Readiness whole = assess(bar());
  EXPECT_TRUE(check_of(whole, "non_manifold").passed);
  EXPECT_TRUE(check_of(whole, "components").passed);
  EXPECT_TRUE(check_of(whole, "min_dihedral_deg").passed);
  const TetMesh touching = lattice_mesh({0, 0, 0}, {2, 2, 1}, 1, [](const TetCorners& p) {
    const Vec3d middle = (p[0] + p[1] + p[2] + p[3]) * 0.25;
    return (middle.x < 1) == (middle.y < 1);
  });
  const Readiness apart = assess(touching);
  EXPECT_FALSE(apart.passed);
  EXPECT_FALSE(check_of(apart, "non_manifold").passed);
  EXPECT_EQ(check_of(apart, "components").value, 2);
  EXPECT_FALSE(check_of(apart, "components").passed);
  EXPECT_FALSE(check_of(apart, "components").advice.empty());
}

TEST(Readiness, NothingAndFlatTetsAreMeasuredToo) {
  const Readiness nothing = assess({});
  EXPECT_FALSE(nothing.passed);
  EXPECT_EQ(nothing.stable_time_step, 0);
  TetMesh flat;
  flat.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  flat.tets = {{0, 1, 2, 3}};
  EXPECT_FALSE(check_of(assess(flat), "inverted_tets").passed);
  EXPECT_EQ(assess(flat).stable_time_step, 0);
}

TEST(Readiness, AMaterialOutOfRangeIsRefusedByName) {
  Material material;
  material.poisson = 0.5;
  EXPECT_THROW(assess({}, material), InvalidInput);
  material = {};
  material.density = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(assess({}, material), InvalidInput);
}

}  // namespace
}  // namespace tetsoup
