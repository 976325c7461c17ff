// Many bodies, and many calls: what they cost grows with what they ask for.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <ctime>
#include <limits>
#include <random>
#include <vector>

#include "lattice_shapes.h"
#include "simulate/build.h"
#include "simulate/part_pairs.h"
#include "tetsoup/error.h"
#include "tetsoup/simulate.h"

namespace tetsoup {
namespace {

constexpr double kFrame = 1.0 / 60;

TetMesh one_tet(float size = 0.1F) {
  TetMesh mesh;
  mesh.vertices = {{0, 0, 0}, {size, 0, 0}, {0, size, 0}, {0, 0, size}};
  mesh.tets = {{0, 1, 2, 3}};
  return mesh;
}

/// Side by side on a square, just apart.
std::vector<Pose> places_for(std::size_t count) {
  std::vector<Pose> poses(count);
  for (std::size_t i = 0; i < count; ++i)
    poses[i].translate = {0.11 * static_cast<double>(i % 200), 0.11 * static_cast<double>(i / 200), 0.5};
  return poses;
}

/// Of the processor, all threads together: least of three, s.
template <class Action>
double time_of(const Action& action) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    const std::clock_t begin = std::clock();
    action();
    least = std::min(least, static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
  }
  return least;
}

TEST(SimulateMany, ABodyPinnedAndLetGoOverAndOverIsCopiedOnceAtMost) {
  simulate::World world;
  simulate::add_bodies(world, block_mesh({2, 2, 2}, 0.1), {}, std::vector<Pose>{{}, {.translate = {2, 0, 0}}});
  ASSERT_EQ(world.rests.size(), 1);
  const std::uint32_t first = world.bodies[0].slots[0], second = world.bodies[1].slots[0];
  for (int cycle = 0; cycle < 50; ++cycle)
    for (const std::uint32_t slot : {first, second})
      for (const auto hold : {simulate::Hold::Held, simulate::Hold::Free}) simulate::hold_vertex(world, slot, hold);
  EXPECT_EQ(world.rests.size(), 2);  // the first to be pinned had to have its own; the second has what is left
  EXPECT_EQ(world.nets.size(), 2);
  EXPECT_NE(world.parts[0].rest, world.parts[1].rest);
  simulate::hold_vertex(world, first, simulate::Hold::Held);
  EXPECT_EQ(world.rest_of(world.parts[0]).held_count, 1);
  EXPECT_EQ(world.rest_of(world.parts[1]).held_count, 0);
}

TEST(SimulateMany, PartsThatMayMeetAreThoseThatAllPairsGive) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-0.4, 0.4), speed(-20, 20), scale(0.2, 3);
  for (int round = 0; round < 20; ++round) {
    simulate::World world;
    for (int i = 0; i < 60; ++i)
      simulate::add_bodies(world, one_tet(), {},
                           std::vector<Pose>{{.translate = {place(random), place(random), place(random)},
                                              .scale = scale(random),
                                              .velocity = {speed(random), speed(random), speed(random)}}});
    const Progress nobody;
    StageWatch watch(nobody, "simulate");
    const simulate::PartPairs all = simulate::find_part_pairs(world, 1, watch);
    std::size_t found = 0;
    for (std::uint32_t p = 0; p < world.parts.size(); ++p) {
      std::vector<std::uint32_t> expected, got;
      for (const simulate::Partner& partner : all.partners[p]) got.push_back(partner.part);
      for (std::uint32_t q = 0; q < world.parts.size(); ++q) {
        // A second is so long that every two may come as close as they ever may.
        const auto edge = [&](std::uint32_t i) { return 0.1 * world.rest_of(world.parts[i]).piece.mean_edge; };
        if (p != q &&
            all.bounds[std::min(p, q)].meets(all.bounds[std::max(p, q)], static_cast<float>(edge(p) + edge(q))))
          expected.push_back(q);
      }
      EXPECT_EQ(got, expected) << "part " << p;
      found += got.size();
    }
    EXPECT_GT(found, 20);
  }
}

TEST(SimulateMany, AStepOfManySmallBodiesCostsInProportion) {
  const auto cost = [](std::size_t count) {
    SimulationOptions options;
    options.gravity = {};
    options.substeps = options.max_substeps = 2;
    Simulation simulation(options);
    simulation.add_bodies(one_tet(), {}, places_for(count));
    return time_of([&] { simulation.step(kFrame); });
  };
  EXPECT_LT(cost(16000), 30 * cost(2000));  // all pairs: 64 and more
}

TEST(SimulateMany, ASearchForContactsCanBeStopped) {
  const auto make = [] {
    Simulation simulation;
    simulation.add_plane({0, 0, 1}, 0.45);
    simulation.add_bodies(one_tet(), {}, places_for(3000));
    simulation.step(kFrame);
    return simulation;
  };
  Simulation whole = make();
  int calls = 0;
  whole.step(kFrame, [&](std::string_view, double) { return ++calls > 0; });
  EXPECT_GT(calls, 10 * whole.report().substeps);
  for (const int last : {2, 3, 9, 30}) {  // all before the first substep is done
    Simulation stopped = make();
    const std::uint64_t before = stopped.state_hash();
    int left = last;
    EXPECT_THROW(stopped.step(kFrame, [&](std::string_view, double) { return --left > 0; }), Cancelled);
    EXPECT_EQ(stopped.state_hash(), before);
    stopped.step(kFrame);
    EXPECT_EQ(stopped.state_hash(), whole.state_hash()) << last;
  }
}

TEST(SimulateMany, ACallForOneBodyCostsTheSameAmongMany) {
  const auto cost = [](std::size_t count) {
    Simulation simulation;
    simulation.add_bodies(one_tet(), {}, places_for(count));
    const std::vector<Vec3> still(4);
    return time_of([&] {
      for (std::size_t i = 0; i < 400; ++i) {
        const std::span<const Vec3> now = simulation.positions(7);
        const std::vector<Vec3> same(now.begin(), now.end());
        simulation.set_positions(7, same);
        simulation.set_velocities(7, still);
      }
    });
  };
  EXPECT_LT(cost(20000), 1e-3 + 10 * cost(20));
}

TEST(SimulateMany, BodiesAddedOneByOneCostInProportion) {
  const TetMesh mesh = one_tet();
  const auto cost = [&](std::size_t count) {
    return time_of([&] {
      Simulation simulation;
      for (const Pose& pose : places_for(count)) simulation.add_body(mesh, {}, pose);
    });
  };
  EXPECT_LT(cost(8000), 30 * cost(1000));  // as if each published all: 64
}

}  // namespace
}  // namespace tetsoup
