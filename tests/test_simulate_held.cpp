// Held bodies, whose steps solve the whole of them: they sag and swing as their material says, and gain nothing.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "lattice_shapes.h"
#include "simulate/held_solver.h"
#include "tetsoup/simulate.h"

namespace tetsoup {
namespace {

constexpr double kFrame = 1.0 / 60, kDensity = 1000, kGravity = 9.81;

struct Held {
  std::array<int, 3> cells{20, 2, 2};
  double cell = 0.05, young = 1e8, damping_time = 0.002;
  int substeps = 10;
  double seconds = 2.5;
};

/// What the end of a beam along x, held at x = 0, has done.
struct Course {
  double sag = 0;       ///< m, mean of the second half.
  double sideways = 0;  ///< m, most.
  double turns = 0;     ///< From up to down or back, a second.
  double gained = 0;    ///< J, most of the total energy over that of the start.
  double scale = 0;     ///< J, the weight's work over the sag.
};

Course course_of(const Held& held) {
  SimulationOptions options;
  options.contacts = Contacts::None;
  options.substeps = held.substeps;
  Simulation simulation(options);
  SimMaterial material;
  material.elastic.young = held.young;
  material.elastic.density = kDensity;
  material.damping_time = held.damping_time;
  const TetMesh mesh = block_mesh(held.cells, held.cell);
  const std::size_t body = simulation.add_body(mesh, material);
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v)
    if (mesh.vertices[v].x < 1e-6F) simulation.pin({body, v});
  const double before = simulation.energy().total();
  const int frames = static_cast<int>(held.seconds / kFrame);
  Course course;
  double first = 0, last = 0, speed = 0, turns = -1;
  for (int frame = 0; frame < frames; ++frame) {
    simulation.step(kFrame);
    const Vec3d p = to_double(simulation.positions(body).back()), at_rest = to_double(mesh.vertices.back());
    course.sideways = std::max(course.sideways, std::abs(p.y - at_rest.y));
    course.sag += frame < frames / 2 ? 0 : (at_rest.z - p.z) / (frames - frames / 2);
    course.gained = std::max(course.gained, simulation.energy().total() - before);
    const double now = static_cast<double>(simulation.velocities(body).back().z);
    if (now * speed < 0) {
      last = (frame + now / (speed - now)) * kFrame;
      first = turns < 0 ? last : first;
      ++turns;
    }
    speed = now;
  }
  course.turns = turns > 0 ? turns / (last - first) : 0;
  course.scale = kDensity * kGravity * simulation.volume(body) * std::abs(course.sag);
  return course;
}

/// What linear elements on the same mesh say of the end's sag, from their stiffness matrix alone.
double sag_of_elements(const Held& held) {
  SimMaterial material;
  material.elastic.young = held.young;
  material.elastic.density = kDensity;
  simulate::Rest rest = simulate::make_rest(simulate::split_pieces(block_mesh(held.cells, held.cell), 1)[0], material);
  std::vector<Vec3d> weights, moves(rest.masses.size());
  for (std::size_t v = 0; v < rest.masses.size(); ++v) {
    rest.held[v] = rest.piece.places[v].x < 1e-6 ? 1 : 0;
    weights.push_back({0, 0, -kGravity * rest.masses[v]});
  }
  const std::vector<simulate::Matrix3> unturned(rest.masses.size(), simulate::to_matrix({}));
  constexpr double kForever = 1e6;  // s
  simulate::HeldFactor(rest, simulate::held_tets(rest), kForever, 1).solve(unturned, weights, moves);
  return -moves.back().z;
}

TEST(SimulateHeld, ABeamSagsAndSwingsAsItsElementsDoWithAnyDampingAndSubsteps) {
  Held fine;
  fine.damping_time = 0;
  fine.substeps = 40;
  const double sag = sag_of_elements(fine), turns = course_of(fine).turns;
  for (const double damping_time : {0.0, 0.002, 0.05}) {
    for (const int substeps : {1, 10, 20}) {
      Held held;
      held.damping_time = damping_time;
      held.substeps = substeps;
      const Course found = course_of(held);
      EXPECT_NEAR(found.sag, sag, 0.05 * sag) << damping_time << " s, " << substeps;
      if (damping_time > 0.002) continue;  // hardly swings
      EXPECT_NEAR(found.turns, turns, (substeps == 1 ? 0.15 : 0.05) * turns) << substeps;
    }
  }
}

TEST(SimulateHeld, NothingIsGainedAndNothingWhirlsFrom10KilopascalsTo10Gigapascals) {
  for (const double young : {1e4, 1e6, 1e8, 1e10}) {
    for (const double damping_time : {0.0, 0.002}) {
      Held held;
      held.cells = {12, 2, 2};
      held.young = young;
      held.damping_time = damping_time;
      held.seconds = 2;
      const Course found = course_of(held);
      EXPECT_LE(found.gained, 1e-4 * found.scale) << young << " Pa, " << damping_time;
      EXPECT_LT(found.sideways, (young < 1e6 ? 0.1 : 0.01) * found.sag) << young << " Pa, " << damping_time;
    }
  }
}

TEST(SimulateHeld, ASlenderRodOfAGigapascalStaysAsSlowAsItsFall) {
  Held held;
  held.cells = {100, 1, 1};
  held.young = 1e9;
  held.damping_time = 0;
  held.seconds = 3;
  const Course found = course_of(held);
  EXPECT_LE(found.gained, 1e-4 * found.scale);
  EXPECT_GT(found.sag, 0.3);
}

}  // namespace
}  // namespace tetsoup
