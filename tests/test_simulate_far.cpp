// Bodies far from the origin, where a float's grain is larger than what gravity moves in a substep.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "lattice_shapes.h"
#include "tetsoup/simulate.h"

namespace tetsoup {
namespace {

constexpr double kFrame = 1.0 / 60;

/// What a beam of 1 x .1 x .1 m, held at one end and placed somewhere, has come to.
struct Ended {
  double sag = 0, elastic = 0, fastest = 0;  ///< m, J; m/s, of all steps.
  std::vector<Vec3> positions, velocities;
};

Ended end_of_beam(const Vec3d& at, double young, int substeps, int frames) {
  SimulationOptions options;
  options.contacts = Contacts::None;
  options.substeps = substeps;
  Simulation simulation(options);
  const TetMesh mesh = block_mesh({20, 2, 2}, 0.05);
  SimMaterial material;
  material.elastic.young = young;
  Pose pose;
  pose.translate = at;
  const std::size_t body = simulation.add_body(mesh, material, pose);
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v)
    if (mesh.vertices[v].x < 1e-6F) simulation.pin({body, v});
  Ended ended;
  for (int frame = 0; frame < frames; ++frame) {
    simulation.step(kFrame);
    ended.fastest = std::max(ended.fastest, length(to_double(simulation.velocities(body).back())));
  }
  ended.elastic = simulation.energy().elastic;
  ended.positions.assign(simulation.positions(body).begin(), simulation.positions(body).end());
  ended.velocities.assign(simulation.velocities(body).begin(), simulation.velocities(body).end());
  ended.sag = static_cast<double>(mesh.vertices.back().z) + at.z - static_cast<double>(ended.positions.back().z);
  return ended;
}

TEST(SimulateFar, AHeldBeamAKilometreAwayMovesAsAtTheOrigin) {
  for (const auto& [young, substeps] : {std::pair(1e8, 10), std::pair(1e7, 100)}) {
    const Ended near = end_of_beam({}, young, substeps, 30);
    EXPECT_GT(near.sag, 0.005) << young;
    for (const double d : {2.0, 5.0, 50.0, 1000.0}) {
      const Ended far = end_of_beam({d, d, d}, young, substeps, 30);
      const double grain = d * 0x1p-23;  // of the float that is given out
      EXPECT_NEAR(far.sag, near.sag, 1e-6 + 2 * grain) << young << " Pa, " << d << " m";
      EXPECT_NEAR(far.elastic, near.elastic, 1e-4 * near.elastic) << young << " Pa, " << d << " m";
      for (std::size_t v = 0; v < near.velocities.size(); ++v) {
        const Vec3d off = to_double(far.velocities[v]) - to_double(near.velocities[v]);
        ASSERT_LT(length(off), 1e-3 * near.fastest) << young << " Pa, " << d << " m";
      }
    }
  }
}

TEST(SimulateFar, ABodyThatBouncesOnAPlaneAKilometreAwayDoesAsAtTheOrigin) {
  std::vector<std::vector<Vec3>> velocities;
  for (const double d : {0.0, 1000.0}) {
    Simulation simulation;
    simulation.add_plane({0, 0, 1}, d);
    Pose pose;
    pose.translate = {d, -d, d + 0.05};
    pose.rotate = {0.1, 0.2, 0};
    pose.velocity = {0, 0, -1};
    SimMaterial material;
    material.elastic.young = 2e5;
    const std::size_t body = simulation.add_body(block_mesh({2, 2, 2}, 0.1), material, pose);
    for (int frame = 0; frame < 20; ++frame) simulation.step(kFrame);
    velocities.emplace_back(simulation.velocities(body).begin(), simulation.velocities(body).end());
    EXPECT_GT(velocities.back()[0].z, -1) << "it fell through";
  }
  for (std::size_t v = 0; v < velocities[0].size(); ++v)
    EXPECT_LT(length(to_double(velocities[1][v]) - to_double(velocities[0][v])), 2e-3);
}

}  // namespace
}  // namespace tetsoup
