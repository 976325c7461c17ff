#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "base/hash.h"
#include "kernel/targets.h"
#include "lattice_shapes.h"
#include "shapes.h"
#include "tetsoup/error.h"
#include "tetsoup/progress.h"
#include "tetsoup/simulate.h"

namespace tetsoup {
namespace {

constexpr double kFrame = 1.0 / 60;

TetMesh block() {
  return block_mesh({3, 2, 2}, 0.1);
}

/// Nothing pulls, nothing touches.
SimulationOptions in_space(Solver solver = Solver::Implicit) {
  SimulationOptions options;
  options.solver = solver;
  options.gravity = {};
  options.contacts = Contacts::None;
  return options;
}

SimMaterial undamped() {
  SimMaterial material;
  material.damping_time = 0;
  return material;
}

Vec3d mean_of(std::span<const Vec3> points) {
  Vec3d sum;
  for (const Vec3& p : points) sum += to_double(p);
  return sum * (1 / static_cast<double>(points.size()));
}

TEST(Simulate, FreeFallIsExact) {
  for (const Solver solver : {Solver::Implicit, Solver::Potentials}) {
    SimulationOptions options;
    options.solver = solver;
    Simulation simulation(options);
    const std::size_t body = simulation.add_body(block(), {}, {.velocity = {1, 2, 3}});
    const Vec3d from = mean_of(simulation.positions(body));
    for (int frame = 0; frame < 60; ++frame) simulation.step(kFrame);
    const Vec3d expected = from + Vec3d{1, 2, 3 - 9.81 / 2};
    EXPECT_LT(length(mean_of(simulation.positions(body)) - expected), 5e-5);  // 600 roundings of 5 m
    EXPECT_NEAR(simulation.time(), 1, 1e-12);
  }
}

TEST(Simulate, SpansStayWhereTheyAreForAsLongAsTheSimulation) {
  Simulation simulation;
  const std::size_t body = simulation.add_body(block());
  const std::span<const Vec3> positions = simulation.positions(body), velocities = simulation.velocities(body);
  const std::vector<std::byte> state = simulation.save_state();
  simulation.step(kFrame);
  simulation.restore_state(state);
  for (int i = 1; i < 100; ++i) simulation.add_body(block(), {}, {.translate = {1.0 * i, 0, 0}});
  simulation.step(kFrame);
  const Simulation moved = std::move(simulation);
  EXPECT_EQ(positions.data(), moved.positions(body).data());
  EXPECT_EQ(velocities.data(), moved.velocities(body).data());
}

TEST(Simulate, MomentaStayWithinRoundingOverTenThousandSteps) {
  for (const Solver solver : {Solver::Implicit, Solver::Potentials}) {
    SimulationOptions options = in_space(solver);
    options.substeps = 1;
    Simulation simulation(options);
    // As long a step as the potentials take at once; the body stays near, where rounding is fine.
    constexpr double kStep = 1e-4;
    simulation.add_body(block(), undamped(), {.velocity = {0.2, -0.1, 0.1}, .spin = {2, 1, -3}});
    const Momentum before = simulation.momentum();
    for (int i = 0; i < 10000; ++i) simulation.step(kStep);
    const Momentum after = simulation.momentum();
    EXPECT_LT(length(after.linear - before.linear), 1e-5 * length(before.linear));
    EXPECT_LT(length(after.angular - before.angular), 1e-4 * length(before.angular));
  }
}

TEST(Simulate, MomentaStayWithinRoundingOverTenThousandFrames) {
  Simulation simulation(in_space());
  simulation.add_body(block(), undamped(), {.velocity = {0.02, -0.01, 0.01}, .spin = {2, 1, -3}});
  const Momentum before = simulation.momentum();
  for (int frame = 0; frame < 10000; ++frame) simulation.step(kFrame);
  const Momentum after = simulation.momentum();
  EXPECT_LT(length(after.linear - before.linear), 1e-4 * length(before.linear));
  EXPECT_LT(length(after.angular - before.angular), 1e-3 * length(before.angular));
}

TEST(Simulate, EnergyDoesNotGrow) {
  for (const Solver solver : {Solver::Implicit, Solver::Potentials}) {
    Simulation simulation(in_space(solver));
    const std::size_t body = simulation.add_body(block(), undamped(), {.spin = {3, 5, 2}});
    std::vector<Vec3> stretched(simulation.positions(body).begin(), simulation.positions(body).end());
    for (Vec3& p : stretched) p.x *= 1.3F;
    simulation.set_positions(body, stretched);
    simulation.step(kFrame);  // rotations are known from here on
    double most = simulation.energy().total();
    const double first = most;
    for (int frame = 0; frame < 300; ++frame) {
      simulation.step(kFrame);
      // The explicit solver's energy swings about its mean by the square of the substep.
      EXPECT_LE(simulation.energy().total(), solver == Solver::Implicit ? most * (1 + 1e-4) : first * 1.1);
      most = std::min(most, simulation.energy().total());
    }
  }
}

TEST(Simulate, ThreadsAndInstructionSetsLeaveNoTrace) {
  const auto run = [] {
    SimulationOptions options;
    options.substeps = 6;
    Simulation simulation(options);
    simulation.add_plane({0, 0, 1}, 0);
    std::vector<Pose> poses;
    for (int i = 0; i < 12; ++i)
      poses.push_back(
          {.translate = {0.15 * (i % 2), 0.1 * (i % 3), 0.05 + 0.22 * i}, .rotate = {0.3 * i, 0.1, 0.2 * i}});
    simulation.add_bodies(block_mesh({4, 3, 3}, 0.05), {}, poses);
    for (int frame = 0; frame < 40; ++frame) simulation.step(kFrame);
    EXPECT_GT(simulation.report().contacts, 0U);
    return simulation.state_hash();
  };
  const std::uint64_t expected = run();
  set_thread_count(1);
  EXPECT_EQ(run(), expected);
  set_thread_count(0);
  for_each_simd_target([&](const std::string& target) { EXPECT_EQ(run(), expected) << target; });
}

TEST(Simulate, APieceThatAllThreadsShareIsTheSameWithOne) {
  const auto run = [] {
    SimulationOptions options = in_space();
    options.substeps = 2;
    Simulation simulation(options);
    simulation.add_body(block_mesh({17, 16, 16}, 0.05), {}, {.spin = {1, 2, 3}});  // 21,760 tets
    simulation.step(kFrame);
    return simulation.state_hash();
  };
  const std::uint64_t expected = run();
  set_thread_count(1);
  EXPECT_EQ(run(), expected);
  set_thread_count(0);
}

TEST(Simulate, BodiesOfOneMakeMoveAsBodiesAddedOneByOne) {
  const std::vector<Pose> poses{{.spin = {1, 0, 0}}, {.translate = {5, 0, 0}, .spin = {0, 2, 0}}};
  Simulation together(in_space()), apart(in_space());
  EXPECT_EQ(together.add_bodies(block(), {}, poses), 0U);
  for (const Pose& pose : poses) apart.add_body(block(), {}, pose);
  together.pin({1, 0});
  apart.pin({1, 0});
  for (int frame = 0; frame < 10; ++frame) {
    together.step(kFrame);
    apart.step(kFrame);
  }
  EXPECT_EQ(together.state_hash(), apart.state_hash());
}

TEST(Simulate, APinnedVertexStaysUntilItIsLetGo) {
  Simulation simulation;
  const std::size_t body = simulation.add_body(block());
  const Vec3 held = simulation.positions(body)[0];
  simulation.pin({body, 0});
  for (int frame = 0; frame < 30; ++frame) simulation.step(kFrame);
  EXPECT_EQ(simulation.positions(body)[0], held);
  EXPECT_GT(mean_of(simulation.positions(body)).z, -1);
  simulation.unpin({body, 0});
  for (int frame = 0; frame < 60; ++frame) simulation.step(kFrame);
  EXPECT_LT(simulation.positions(body)[0].z, held.z - 1);
}

TEST(Simulate, ASpringHoldsABodyUpAndAnAttachmentASecondOne) {
  Simulation simulation;
  const std::size_t a = simulation.add_body(block()), b = simulation.add_body(block(), {}, {.translate = {2, 0, 0}});
  const double weight = 2 * 12 * 9.81;
  const std::size_t spring = simulation.add_spring({a, 0}, {0, 0, 5}, 1000);
  simulation.attach({a, 20}, {b, 5});
  // They swing for long, so the spring carries their weight in the mean.
  double sum = 0;
  constexpr int kFrames = 1200;
  for (int frame = 0; frame < kFrames; ++frame) {
    simulation.step(kFrame);
    sum += 5 - static_cast<double>(simulation.positions(a)[0].z);
    ASSERT_LT(length(to_double(simulation.positions(a)[20]) - to_double(simulation.positions(b)[5])), 0.01);
  }
  EXPECT_NEAR(sum / kFrames * 1000, weight, 0.05 * weight);
  simulation.remove_spring(spring);
  EXPECT_THROW(simulation.move_spring(spring, {}), InvalidInput);
}

TEST(Simulate, WhatCannotBeSimulatedIsLeftOutAndCounted) {
  TetMesh mesh = block();
  const std::size_t tets = mesh.tets.size();
  mesh.tets.push_back({0, 1, 2, 99999});
  mesh.tets.push_back({0, 0, 1, 2});
  mesh.tets.push_back({mesh.tets[0][1], mesh.tets[0][0], mesh.tets[0][2], mesh.tets[0][3]});
  mesh.vertices.push_back({std::numeric_limits<float>::quiet_NaN(), 0, 0});
  Simulation simulation;
  const std::size_t body = simulation.add_body(mesh), nothing = simulation.add_body({});
  EXPECT_EQ(simulation.report().tet_count, tets);
  EXPECT_EQ(simulation.report().left_out, 3U);
  EXPECT_EQ(simulation.report().loose_vertices, 1U);
  simulation.step(kFrame);
  EXPECT_TRUE(std::isfinite(simulation.positions(body).back().x));
  EXPECT_TRUE(simulation.positions(nothing).empty());
}

TEST(Simulate, WhatIsOutOfRangeIsRefusedByNameAndChangesNothing) {
  SimulationOptions options;
  options.substeps = 0;
  EXPECT_THROW(Simulation{options}, InvalidInput);
  Simulation simulation;
  SimMaterial material;
  material.elastic.poisson = 0.5;
  EXPECT_THROW(simulation.add_body(block(), material), InvalidInput);
  EXPECT_THROW(simulation.add_body(block(), {}, {.translate = {1e6, 0, 0}}), InvalidInput);
  EXPECT_THROW(simulation.add_body(block(), {}, {.scale = 0}), InvalidInput);
  EXPECT_THROW(simulation.add_body(block(), {}, {.scale = 1e-6}), InvalidInput);
  EXPECT_THROW(simulation.add_plane({0, 0, 0}, 0), InvalidInput);
  EXPECT_THROW(simulation.step(0), InvalidInput);
  EXPECT_THROW(simulation.step(std::numeric_limits<double>::quiet_NaN()), InvalidInput);
  EXPECT_THROW(simulation.pin({0, 0}), InvalidInput);
  EXPECT_EQ(simulation.body_count(), 0U);
}

/// Two soft blocks, one of them held and pulled, the other falling on it.
Simulation busy_simulation() {
  Simulation simulation;
  simulation.add_plane({0, 0, 1}, 0);
  SimMaterial soft;
  soft.elastic.young = 2e4;
  simulation.add_bodies(block(), soft, std::vector<Pose>{{.translate = {0, 0, 0.01}}, {.translate = {0.05, 0, 0.23}}});
  simulation.pin({0, 0});
  simulation.add_spring({0, 5}, {1, 0, 1}, 10);
  return simulation;
}

TEST(Simulate, AStoppedStepEndsWithAWholeSubstepAndGoesOn) {
  Simulation simulation(in_space());
  simulation.add_body(block(), {}, {.velocity = {1, 0, 0}});
  double told = 0;
  simulation.step(0.1, [&](std::string_view, double fraction) {
    told = fraction;
    return true;
  });
  EXPECT_EQ(told, 1);
  const int substeps = simulation.report().substeps;
  const double before = mean_of(simulation.positions(0)).x;
  EXPECT_THROW(simulation.step(0.1, [](std::string_view, double fraction) { return fraction < 0.35; }), Cancelled);
  const int done = simulation.report().substeps;
  EXPECT_EQ(done, std::ceil(0.35 * substeps));
  EXPECT_NEAR(simulation.time(), 0.1 + 0.1 * done / substeps, 1e-12);
  EXPECT_NEAR(mean_of(simulation.positions(0)).x - before, 0.1 * done / substeps, 1e-6);
  simulation.step(0.2 - simulation.time());
  EXPECT_NEAR(mean_of(simulation.positions(0)).x - before, 0.1, 1e-6);
}

TEST(Simulate, GoesOnFromASavedStateToTheBit) {
  Simulation first = busy_simulation(), second = busy_simulation();
  for (int i = 0; i < 20; ++i) first.step(kFrame);
  first.move_spring(0, {0, 1, 1});
  ASSERT_GT(first.report().contacts, 0U);
  second.restore_state(first.save_state());
  EXPECT_EQ(second.state_hash(), first.state_hash());
  EXPECT_EQ(second.time(), first.time());
  for (int i = 0; i < 20; ++i) {
    first.step(kFrame);
    second.step(kFrame);
  }
  EXPECT_EQ(second.state_hash(), first.state_hash());
}

TEST(Simulate, DamagedOrForeignStatesChangeNothing) {
  Simulation simulation = busy_simulation();
  simulation.step(kFrame);
  const std::uint64_t hash = simulation.state_hash();
  const std::vector<std::byte> state = simulation.save_state();
  for (const std::size_t at : {std::size_t{0}, state.size() / 2, state.size() - 1}) {
    std::vector<std::byte> damaged = state;
    damaged[at] ^= std::byte{4};
    EXPECT_THROW(simulation.restore_state(damaged), InvalidInput);
    EXPECT_THROW(simulation.restore_state(std::span(state).first(at)), InvalidInput);
  }
  Simulation other;
  other.add_body(block());
  EXPECT_THROW(simulation.restore_state(other.save_state()), InvalidInput);
  EXPECT_EQ(simulation.state_hash(), hash);
}

/// The bytes with a word of four replaced, and a checksum that says all is well.
std::vector<std::byte> forged(std::vector<std::byte> state, std::size_t at, std::uint32_t word) {
  std::memcpy(state.data() + at, &word, sizeof(word));
  WordHash hash;
  const std::size_t end = state.size() - 8;
  for (std::size_t i = 0; i < end; i += 8) {
    std::uint64_t eight = 0;
    std::memcpy(&eight, state.data() + i, std::min<std::size_t>(8, end - i));
    hash.add(eight);
  }
  const std::uint64_t sum = hash.value();
  std::memcpy(state.data() + end, &sum, sizeof(sum));
  return state;
}

TEST(Simulate, AForgedStateIsRefusedOrGivesNumbersOnly) {
  Simulation simulation = busy_simulation();
  for (int i = 0; i < 20; ++i) simulation.step(kFrame);
  ASSERT_GT(simulation.report().contacts, 0U);
  const std::vector<std::byte> state = simulation.save_state();
  const std::uint64_t hash = simulation.state_hash();
  std::uint32_t first = 0;
  std::memcpy(&first, state.data(), sizeof(first));
  ASSERT_EQ(forged(state, 0, first), state);
  std::size_t refused = 0, tried = 0;
  // No number, an index beyond everything, a small one, minus infinity, the largest number there is.
  for (const std::uint32_t word : {0x7fc00000U, 0xffffffffU, 7U, 0xff800000U, 0x7f7fffffU}) {
    for (std::size_t at = 0; at + 12 <= state.size(); at += 4) {
      ++tried;
      try {
        simulation.restore_state(forged(state, at, word));
      } catch (const InvalidInput&) {
        ++refused;
        ASSERT_EQ(simulation.state_hash(), hash) << at;
        continue;
      }
      simulation.step(kFrame);
      for (const std::size_t body : {0U, 1U})
        for (const Vec3& p : simulation.positions(body)) ASSERT_TRUE(std::isfinite(p.x + p.y + p.z)) << at;
      simulation.restore_state(state);
    }
  }
  EXPECT_GT(refused, tried / 2);
  std::vector<std::byte> longer = state;
  longer.insert(longer.end() - 8, 8, std::byte{});
  EXPECT_THROW(simulation.restore_state(forged(longer, longer.size() - 16, 0)), InvalidInput);
}

}  // namespace
}  // namespace tetsoup
