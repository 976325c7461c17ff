#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "lattice_shapes.h"
#include "shapes.h"
#include "tetsoup/simulate.h"

namespace tetsoup {
namespace {

constexpr double kFrame = 1.0 / 60, kGravity = 9.81;

struct Beam {
  double length = 1, height = 0.2;
  Material material;

  /// Deflection of the free end under its own weight, by bending and by shear [Timoshenko].
  double deflection() const {
    const double e = material.young, g = e / (2 * (1 + material.poisson)), area = height * height;
    const double inertia = std::pow(height, 4) / 12, weight = material.density * kGravity * area;
    return weight * std::pow(length, 4) / (8 * e * inertia) + weight * length * length / (2 * g * area * 5 / 6);
  }
};

/// How far the free end has come down after three seconds, over what theory says; `cells` across the height.
double simulated_over_theory(const Beam& beam, int cells, int substeps, double* volume = nullptr) {
  const double cell = beam.height / cells;
  const TetMesh mesh = block_mesh({static_cast<int>(std::lround(beam.length / cell)), cells, cells}, cell);
  SimulationOptions options;
  options.substeps = substeps;
  options.contacts = Contacts::None;
  Simulation simulation(options);
  SimMaterial material;
  material.elastic = beam.material;
  material.damping_time = 0.02;
  const std::size_t body = simulation.add_body(mesh, material);
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v)
    if (mesh.vertices[v].x < 1e-6F) simulation.pin({body, v});
  for (int frame = 0; frame < 180; ++frame) simulation.step(kFrame);
  double sum = 0;
  int count = 0;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    if (mesh.vertices[v].x < static_cast<float>(beam.length) - 1e-4F) continue;
    sum += static_cast<double>(mesh.vertices[v].z - simulation.positions(body)[v].z);
    ++count;
  }
  if (volume != nullptr) *volume = simulation.volume(body) / (beam.length * beam.height * beam.height);
  return sum / count / beam.deflection();
}

TEST(SimulateElastic, ACantileverBendsAsBeamTheorySaysTheFinerTheCloser) {
  Beam beam;
  beam.material.young = 5e6;  // bends little, as theory has it
  beam.material.poisson = 0.3;
  beam.length = 0.6;
  const double coarse = simulated_over_theory(beam, 1, 10), middle = simulated_over_theory(beam, 2, 10),
               fine = simulated_over_theory(beam, 6, 10);
  EXPECT_LT(coarse, middle);  // linear tets are too stiff, the less the smaller they are
  EXPECT_LT(middle, fine);
  EXPECT_NEAR(fine, 1, 0.12);
}

TEST(SimulateElastic, ByDefaultASmallOrStiffOrMuchDampedBeamIsNoSofterThanItsMaterial) {
  for (const double size : {0.05, 1.0}) {
    for (const double damping_time : {0.002, 0.2}) {
      Beam beam;
      beam.length = 0.6 * size;
      beam.height = 0.1 * size;
      beam.material.young = 1e8 * size;  // bends by the same share at any size
      SimMaterial material;
      material.elastic = beam.material;
      material.damping_time = damping_time;
      SimulationOptions options;
      options.contacts = Contacts::None;
      options.gravity = {0, 0, -200};
      Simulation simulation(options);
      const TetMesh mesh = block_mesh({12, 2, 2}, beam.height / 2);
      const std::size_t body = simulation.add_body(mesh, material);
      for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v)
        if (mesh.vertices[v].x < 1e-6F) simulation.pin({body, v});
      double sum = 0;
      for (int frame = 0; frame < 240; ++frame) {
        simulation.step(kFrame);
        sum += frame < 120 ? 0 : static_cast<double>(mesh.vertices.back().z - simulation.positions(body).back().z);
      }
      const double over_theory = sum / 120 / (beam.deflection() * 200 / kGravity);
      EXPECT_GT(over_theory, 0.5) << size << " m, damping " << damping_time;  // two linear tets across are too stiff
      EXPECT_LT(over_theory, 1.4) << size << " m, damping " << damping_time;
    }
  }
}

TEST(SimulateElastic, ByDefaultAColumnOnTheGroundSagsAsItsMaterialSays) {
  for (const double young : {1e5, 1e7}) {
    for (const double damping_time : {0.002, 0.2}) {
      constexpr double kHeight = 0.5, kHeavier = 3;
      SimulationOptions options;
      options.contacts = Contacts::Between;
      options.gravity = {0, 0, -kHeavier * kGravity * young / 3e5};  // the same share at any stiffness
      Simulation simulation(options);
      simulation.add_plane({0, 0, 1}, 0);
      SimMaterial material;
      material.elastic.young = young;
      material.elastic.poisson = 0.4;
      material.damping_time = damping_time;
      const std::size_t body = simulation.add_body(block_mesh({4, 4, 10}, kHeight / 10), material);
      double sum = 0;
      for (int frame = 0; frame < 120; ++frame) {
        simulation.step(kFrame);
        const auto [lowest, highest] =
            std::minmax_element(simulation.positions(body).begin(), simulation.positions(body).end(),
                                [](const Vec3& a, const Vec3& b) { return a.z < b.z; });
        sum += frame < 60 ? 0 : kHeight - static_cast<double>(highest->z - lowest->z);
      }
      const double theory = material.elastic.density * -options.gravity.z * kHeight * kHeight / (2 * young);
      EXPECT_GT(sum / 60 / theory, 0.8) << young << " Pa, damping " << damping_time;
      EXPECT_LT(sum / 60 / theory, 1.4) << young << " Pa, damping " << damping_time;
    }
  }
}

TEST(SimulateElastic, ABentBodyOfPoissonRatio49KeepsItsVolumeWithinOnePercent) {
  Beam beam;
  beam.material.young = 2e5;
  beam.material.poisson = 0.49;
  double volume = 0;
  EXPECT_GT(simulated_over_theory(beam, 2, 10, &volume), 0.2);
  EXPECT_NEAR(volume, 1, 0.01);
}

/// A block in space, its vertices put where `place` says, after two seconds: how far its vertices are from a body at
/// rest, as differences of distances to three of its vertices, at most.
double distortion_after(const std::function<Vec3d(const Vec3d&)>& place, Solver solver = Solver::Implicit) {
  SimulationOptions options;
  options.solver = solver;
  options.gravity = {};
  options.contacts = Contacts::None;
  Simulation simulation(options);
  const TetMesh mesh = block_mesh({4, 3, 3}, 0.1);
  SimMaterial material;
  material.damping_time = 0.02;
  const std::size_t body = simulation.add_body(mesh, material);
  std::vector<Vec3> moved;
  for (const Vec3& v : mesh.vertices) moved.push_back(to_float(place(to_double(v))));
  simulation.set_positions(body, moved);
  for (int frame = 0; frame < 240; ++frame) simulation.step(kFrame);
  double most = 0;
  const auto p = simulation.positions(body);
  for (std::size_t v = 0; v < p.size(); ++v)
    for (const std::size_t w : {std::size_t{0}, std::size_t{17}, p.size() - 1})
      most = std::max(most, std::abs(length(to_double(p[v]) - to_double(p[w])) -
                                     length(to_double(mesh.vertices[v]) - to_double(mesh.vertices[w]))));
  EXPECT_GT(simulation.volume(body), 0);
  return most;
}

TEST(SimulateElastic, ABodySqueezedToAPlaneALineOrAPointReturns) {
  EXPECT_LT(distortion_after([](const Vec3d& p) { return Vec3d{p.x, p.y, 0}; }), 0.01);
  EXPECT_LT(distortion_after([](const Vec3d& p) { return Vec3d{p.x, 0, 0}; }), 0.01);
  EXPECT_LT(distortion_after([](const Vec3d&) { return Vec3d{}; }), 0.01);
}

TEST(SimulateElastic, ABodyTurnedInsideOutOrScatteredReturns) {
  EXPECT_LT(distortion_after([](const Vec3d& p) { return Vec3d{p.x, p.y, -p.z}; }), 0.01);
  EXPECT_LT(distortion_after([](const Vec3d& p) { return p * -1; }), 0.01);
  test::Random random(3);
  EXPECT_LT(distortion_after([&](const Vec3d& p) {
              return p + Vec3d{random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1)};
            }),
            0.01);
}

TEST(SimulateElastic, NearlyFlatTetsDoNotThrowABodyOutOfTheNumbers) {
  for (const float height : {1e-3F, 1e-4F, 1e-5F}) {
    TetMesh mesh = block_mesh({3, 2, 2}, 0.1);
    // The top comes down onto the layer below it.
    for (Vec3& p : mesh.vertices)
      if (p.z > 0.19F) p.z = 0.1F + height;
    Simulation simulation;
    simulation.add_plane({0, 0, 1}, 0);
    const std::size_t body = simulation.add_body(mesh, {}, {.translate = {0, 0, 0.2}, .rotate = {0.3, 0.2, 0}});
    for (int frame = 0; frame < 120; ++frame) {
      simulation.step(kFrame);
      for (const Vec3& p : simulation.positions(body)) ASSERT_LT(length(to_double(p)), 100) << height << ' ' << frame;
    }
  }
}

TEST(SimulateElastic, PotentialsBringAStretchedBodyBack) {
  EXPECT_LT(distortion_after(
                [](const Vec3d& p) {
                  return Vec3d{p.x * 1.3, p.y * 0.9, p.z};
                },
                Solver::Potentials),
            0.01);
}

TEST(SimulateElastic, FrameSizedStepsOfAStiffBodyAreStable) {
  SimulationOptions options;
  options.substeps = 1;
  options.contacts = Contacts::None;
  Simulation simulation(options);
  SimMaterial steel;
  steel.elastic = {7800, 2e11, 0.3, 1};
  const TetMesh mesh = block_mesh({6, 2, 2}, 0.05);
  const std::size_t body = simulation.add_body(mesh, steel);
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v)
    if (mesh.vertices[v].x < 1e-6F) simulation.pin({body, v});
  for (int frame = 0; frame < 300; ++frame) {
    simulation.step(kFrame);
    ASSERT_LT(simulation.energy().kinetic, 100);
    for (const Vec3& p : simulation.positions(body)) ASSERT_LT(length(to_double(p)), 1);
  }
}

}  // namespace
}  // namespace tetsoup
