#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "lattice_shapes.h"
#include "shapes.h"
#include "simulate/obstacles.h"
#include "simulate/rest_surface.h"
#include "tetsoup/error.h"
#include "tetsoup/simulate.h"

namespace tetsoup {
namespace {

constexpr double kFrame = 1.0 / 60;

SimMaterial rubber(double young = 1e6, double friction = 0.5) {
  SimMaterial material;
  material.elastic.young = young;
  material.damping_time = 0.01;
  material.friction = friction;
  return material;
}

Vec3d mean_of(std::span<const Vec3> points) {
  Vec3d sum;
  for (const Vec3& p : points) sum += to_double(p);
  return sum * (1 / static_cast<double>(points.size()));
}
float lowest(std::span<const Vec3> points) {
  return std::min_element(points.begin(), points.end(), [](const Vec3& a, const Vec3& b) { return a.z < b.z; })->z;
}

TEST(SimulateContacts, ADroppedBlockComesToRestOnTheGround) {
  Simulation simulation;
  simulation.add_plane({0, 0, 2}, 0);
  const std::size_t body = simulation.add_body(block_mesh({3, 3, 3}, 0.1), rubber(), {.translate = {0, 0, 0.5}});
  for (int frame = 0; frame < 300; ++frame) simulation.step(kFrame);
  EXPECT_LT(simulation.energy().kinetic, 1e-5);
  EXPECT_NEAR(lowest(simulation.positions(body)), 0, 1e-4F);
  EXPECT_NEAR(mean_of(simulation.positions(body)).z, 0.15, 0.005);
  EXPECT_GT(simulation.report().touching, 8U);
}

/// How far a block slides down a slope in two seconds.
double slide(double degrees, double friction) {
  SimulationOptions options;
  options.gravity = {9.81 * std::sin(degrees * std::numbers::pi / 180), 0,
                     -9.81 * std::cos(degrees * std::numbers::pi / 180)};
  Simulation simulation(options);
  simulation.add_plane({0, 0, 1}, 0, friction);
  const std::size_t body = simulation.add_body(block_mesh({4, 4, 1}, 0.1), rubber(1e6, friction));
  for (int frame = 0; frame < 30; ++frame) simulation.step(kFrame);
  const Vec3d from = mean_of(simulation.positions(body));
  for (int frame = 0; frame < 120; ++frame) simulation.step(kFrame);
  return mean_of(simulation.positions(body)).x - from.x;
}

TEST(SimulateContacts, ABlockSlidesOnASlopeAboveTheAngleOfFrictionOnly) {
  for (const double friction : {0.3, 0.7}) {
    const double angle = std::atan(friction) * 180 / std::numbers::pi;
    EXPECT_LT(slide(angle - 1.5, friction), 0.005) << friction;
    EXPECT_GT(slide(angle + 1.5, friction), 0.2) << friction;
  }
  EXPECT_NEAR(slide(20, 0), 9.81 * std::sin(20 * std::numbers::pi / 180) * (2.5 * 2.5 - 0.5 * 0.5) / 2, 0.05);
}

TEST(SimulateContacts, AStackOfThreeComesToRest) {
  Simulation simulation;
  simulation.add_plane({0, 0, 1}, 0);
  std::vector<Pose> poses;
  for (int i = 0; i < 3; ++i)
    poses.push_back({.translate = {0.01 * i, -0.012 * i, 0.102 * i}, .rotate = {0, 0, 0.1 * i}});
  const std::size_t first = simulation.add_bodies(block_mesh({4, 4, 2}, 0.05), rubber(), poses);
  for (int frame = 0; frame < 300; ++frame) simulation.step(kFrame);
  EXPECT_LT(simulation.energy().kinetic, 1e-3);  // of 60 kg
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(mean_of(simulation.positions(first + i)).z, 0.05 + 0.1 * static_cast<double>(i), 0.01);
}

TEST(SimulateContacts, OverlappingBodiesArePushedApartWithoutAPop) {
  SimulationOptions options;
  options.gravity = {};
  Simulation simulation(options);
  const TetMesh mesh = block_mesh({4, 4, 4}, 0.05);
  const std::size_t a = simulation.add_body(mesh, rubber()),
                    b = simulation.add_body(mesh, rubber(), {.translate = {0.18, 0.011, 0.013}});
  const Momentum before = simulation.momentum();
  double fastest = 0;
  for (int frame = 0; frame < 120; ++frame) {
    simulation.step(kFrame);
    for (const Vec3& v : simulation.velocities(a)) fastest = std::max(fastest, length(to_double(v)));
  }
  EXPECT_LT(fastest, 4);  // m/s: a push of 5 cm in one substep would be 30
  EXPECT_GT(mean_of(simulation.positions(b)).x - mean_of(simulation.positions(a)).x, 0.19);
  EXPECT_LT(length(simulation.momentum().linear - before.linear), 1e-4);
}

TEST(SimulateContacts, ABodyRestsOnASoupAsOnTheSolidItStandsFor) {
  Simulation simulation;
  simulation.add_obstacle(test::make_box({-1, -1, -0.5}, {1, 1, 0}), 48);
  const std::size_t body =
      simulation.add_body(block_mesh({3, 3, 3}, 0.1), rubber(), {.translate = {-0.15, -0.15, 0.1}});
  for (int frame = 0; frame < 200; ++frame) simulation.step(kFrame);
  EXPECT_NEAR(lowest(simulation.positions(body)), 0, 0.03F);  // a voxel is 0.042
  EXPECT_LT(simulation.energy().kinetic, 1e-3);
}

/// Two bars of one cell across, crossed a cell's fifth off the middle: one is held at its ends, the other is pulled
/// over it at its ends. Faces cross faces, and no vertex is near.
TEST(SimulateContacts, CrossedBarsDoNotPassThroughEachOther) {
  constexpr int kCells = 9;
  constexpr double kCell = 0.1, kLength = kCells * kCell, kPull = 200;  // N
  SimulationOptions options;
  options.gravity = {};
  Simulation simulation(options);
  const TetMesh mesh = block_mesh({kCells, 1, 1}, kCell);
  const std::size_t under = simulation.add_body(mesh, rubber(), {.translate = {-kLength / 2, -kCell / 2, 0}});
  const std::size_t over = simulation.add_body(
      mesh, rubber(),
      {.translate = {kCell / 2 + 0.02, -kLength / 2 + 0.02, kCell * 1.05}, .rotate = {0, 0, std::numbers::pi / 2}});
  const auto is_end = [&](const Vec3& p) { return p.x < 1e-6F || p.x > static_cast<float>(kLength) - 1e-4F; };
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
    if (!is_end(mesh.vertices[v])) continue;
    simulation.pin({under, v});
    const Vec3d at = to_double(simulation.positions(over)[v]);
    simulation.add_spring({over, v}, at - Vec3d{0, 0, 1}, kPull / 8);
  }
  const auto middle = [&](std::size_t body) {
    double sum = 0;
    int count = 0;
    for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
      if (std::abs(static_cast<double>(mesh.vertices[v].x) - kLength / 2) > 0.6 * kCell) continue;
      sum += static_cast<double>(simulation.positions(body)[v].z);
      ++count;
    }
    return sum / count;
  };
  for (int frame = 0; frame < 180; ++frame) {
    simulation.step(kFrame);
    ASSERT_GT(middle(over) - middle(under), 0.7 * kCell) << frame;
  }
}

TEST(SimulateContacts, AnObstacleTooLargeForMemoryIsRefusedWithWhatWouldFit) {
  Simulation simulation;
  const TriangleSoup cube = test::make_box({0, 0, 0}, {1, 1, 1});
  try {
    simulation.add_obstacle(cube, 4000);
    ADD_FAILURE() << "4000^3 voxels were accepted";
  } catch (const InvalidInput& error) {
    EXPECT_NE(std::string(error.what()).find("voxels = 4000, must be at most 527"), std::string::npos) << error.what();
  }
  EXPECT_THROW(simulation.add_obstacle(cube, 0), InvalidInput);
  simulation.add_obstacle(test::make_box({0, 0, 0}, {1, 0.01, 0.01}), 1000);  // 1004 x 14 x 14
}

TEST(SimulateContacts, AFoldedBodyDoesNotPassThroughItself) {
  // A long bar, its ends bent towards each other and shot at each other.
  const auto gap_after = [](Contacts contacts) {
    SimulationOptions options;
    options.gravity = {};
    options.contacts = contacts;
    options.substeps = 20;
    Simulation simulation(options);
    const TetMesh mesh = block_mesh({24, 2, 2}, 0.05);
    SimMaterial soft = rubber(2e4, 0);
    const std::size_t body = simulation.add_body(mesh, soft);
    std::vector<Vec3> bent, velocities;
    for (const Vec3& v : mesh.vertices) {
      const double turn = (static_cast<double>(v.x) / 1.2 - 0.5) * 1.6 * std::numbers::pi,
                   r = 0.25 - static_cast<double>(v.z);
      bent.push_back(to_float({r * std::sin(turn), static_cast<double>(v.y), r * std::cos(turn)}));
      velocities.push_back({bent.back().z < -0.1F ? (bent.back().x < 0 ? 3.0F : -3.0F) : 0.0F, 0, 0});
    }
    simulation.set_positions(body, bent);
    simulation.set_velocities(body, velocities);
    double least = 1;
    for (int frame = 0; frame < 20; ++frame) {
      simulation.step(kFrame);
      // The ends are left and right of each other until they cross.
      least =
          std::min(least, static_cast<double>(simulation.positions(body).back().x - simulation.positions(body)[0].x));
    }
    return least;
  };
  EXPECT_GT(gap_after(Contacts::All), gap_after(Contacts::Between) + 0.05);
}

TEST(SimulateContacts, RandomScenesGiveNumbersOnly) {
  test::Random random(11);
  for (int scene = 0; scene < 12; ++scene) {
    SimulationOptions options;
    options.solver = scene % 4 == 0 ? Solver::Potentials : Solver::Implicit;
    options.substeps = 1 + static_cast<int>(random.below(6));
    options.contact_interval = 1 + static_cast<int>(random.below(6));
    options.gravity = {random.uniform(-20, 20), random.uniform(-20, 20), random.uniform(-50, 50)};
    Simulation simulation(options);
    simulation.add_plane({random.uniform(-1, 1), random.uniform(-1, 1), 1}, -0.5, random.uniform(0, 3));
    for (int i = 0; i < 4; ++i) {
      SimMaterial material;
      material.elastic.young = std::pow(10, random.uniform(2, options.solver == Solver::Potentials ? 4 : 11));
      material.elastic.poisson = random.uniform(0, 0.499);
      material.elastic.density = std::pow(10, random.uniform(1, 4));
      material.damping_time = random.uniform(0, 0.002);
      const Pose pose{.translate = {random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3)},
                      .rotate = {random.uniform(-9, 9), random.uniform(-9, 9), 0},
                      .scale = std::pow(10, random.uniform(-1, 0.5)),
                      .velocity = {random.uniform(-100, 100), 0, random.uniform(-100, 100)},
                      .spin = {random.uniform(-50, 50), random.uniform(-50, 50), 0}};
      const std::size_t body = simulation.add_body(block_mesh({3, 2, 2}, 0.1), material, pose);
      if (random.below(2) == 0) simulation.pin({body, static_cast<std::uint32_t>(random.below(30))});
    }
    for (int frame = 0; frame < 30; ++frame) {
      simulation.step(random.uniform(0.001, 0.03));
      for (std::size_t body = 0; body < 4; ++body)
        for (const Vec3& p : simulation.positions(body)) ASSERT_TRUE(std::isfinite(p.x + p.y + p.z)) << scene;
    }
  }
}

TEST(RestSurface, TheNearestPointOfABlocksSurfaceIsFound) {
  const simulate::Piece piece = simulate::split_pieces(block_mesh({4, 4, 4}, 0.25), 1)[0];
  simulate::RestSurface surface = simulate::make_rest_surface(piece);
  EXPECT_EQ(surface.triangles.size(), 6U * 32U);
  EXPECT_EQ(surface.sharp_edges.size(), 12U * 4U);  // neither diagonals nor what is between flat cells
  for (std::uint32_t t = 0; t < piece.tets.size(); ++t) {
    simulate::find_near_triangles(surface, piece, t);
    const TetCorners p = simulate::corners_at(piece.places, piece.tets[t]);
    const Vec3d at = p[0] * 0.4 + p[1] * 0.3 + p[2] * 0.2 + p[3] * 0.1;
    const auto depth = [](const Vec3d& q) { return std::min({q.x, q.y, q.z, 1 - q.x, 1 - q.y, 1 - q.z}); };
    const auto [triangle, weights] = simulate::nearest_surface_point(surface, piece, t, at, {});
    Vec3d nearest;
    for (std::size_t i = 0; i < 3; ++i) nearest += piece.places[surface.triangles[triangle][i]] * weights[i];
    EXPECT_NEAR(length(nearest - at), depth(at), 1e-9);
    EXPECT_NEAR(depth(nearest), 0, 1e-9);
  }
}

TEST(RestSurface, InTheMiddleOfALargeBlockTheSurfaceIsFoundAsWell) {
  const simulate::Piece piece = simulate::split_pieces(block_mesh({13, 13, 13}, 0.1), 1)[0];
  simulate::RestSurface surface = simulate::make_rest_surface(piece);
  const Vec3d middle{0.65, 0.65, 0.65};
  for (std::uint32_t t = 0; t < piece.tets.size(); ++t) {
    const TetCorners p = simulate::corners_at(piece.places, piece.tets[t]);
    if (least_weight(p, middle) < 0) continue;
    simulate::find_near_triangles(surface, piece, t);
    const auto [triangle, weights] = simulate::nearest_surface_point(surface, piece, t, middle, {});
    Vec3d nearest;
    for (std::size_t i = 0; i < 3; ++i) nearest += piece.places[surface.triangles[triangle][i]] * weights[i];
    EXPECT_NEAR(length(nearest - middle), 0.65, 1e-6);
  }
}

}  // namespace
}  // namespace tetsoup
