#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <limits>
#include <vector>

#include "kernel/reference.h"
#include "kernel/relax_tets.h"
#include "kernel/rigid_motion.h"
#include "kernel/targets.h"
#include "lattice_shapes.h"
#include "shapes.h"
#include "simulate/rest.h"
#include "simulate/rigid_fit.h"

namespace tetsoup {
namespace {

using kernel::Motion;
using kernel::Offset;
using kernel::Place;

simulate::Rest block_rest(const std::array<int, 3>& cells) {
  SimMaterial material;
  material.damping_time = 0;
  simulate::Rest rest = simulate::make_rest(simulate::split_pieces(block_mesh(cells, 0.1), 1)[0], material);
  simulate::prepare(rest, 0.002);
  return rest;
}

/// The places at rest, each moved at random by up to `by` metres.
std::vector<Place> shaken(const simulate::Rest& rest, double by, std::uint64_t seed) {
  test::Random random(seed);
  std::vector<Place> places(rest.padded_count);
  for (std::size_t v = 0; v < rest.masses.size(); ++v) {
    const Vec3d shift{random.uniform(-by, by), random.uniform(-by, by), random.uniform(-by, by)};
    const Vec3 p = to_float(rest.piece.places[v] + shift);
    places[v] = {p.x, p.y, p.z, static_cast<float>(rest.inverse_mass(v))};
  }
  return places;
}

/// Moves from one place to another.
std::vector<Offset> moves_between(const std::vector<Place>& from, const std::vector<Place>& to) {
  std::vector<Offset> moves;
  for (std::size_t v = 0; v < from.size(); ++v)
    moves.push_back({to[v].x - from[v].x, to[v].y - from[v].y, to[v].z - from[v].z, from[v].inverse_mass});
  return moves;
}

std::vector<kernel::TetRotations> unturned(const simulate::Rest& rest) {
  std::vector<kernel::TetRotations> rotations(rest.batches.size());
  for (auto& r : rotations)
    for (float& w : r.q[3]) w = 1;
  return rotations;
}

template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

TEST(RelaxTets, NoTwoTetsOfABatchShareAVertexAndEveryTetIsInOne) {
  const simulate::Rest rest = block_rest({5, 4, 3});
  std::vector<int> seen(rest.batches.size() * kernel::kTetLanes, 0);
  for (const std::uint32_t lane : rest.lanes) ++seen[lane];
  for (std::size_t b = 0; b < rest.batches.size(); ++b) {
    std::vector<std::uint32_t> corners;
    for (std::size_t lane = 0; lane < kernel::kTetLanes; ++lane) {
      ASSERT_LE(seen[b * kernel::kTetLanes + lane], 1);
      if (seen[b * kernel::kTetLanes + lane] == 0) continue;
      for (const auto& corner : rest.batches[b].corners) corners.push_back(corner[lane]);
    }
    std::sort(corners.begin(), corners.end());
    EXPECT_EQ(std::adjacent_find(corners.begin(), corners.end()), corners.end());
  }
}

TEST(RelaxTets, AStretchedTetMovesAsTheObviousTwinSays) {
  const simulate::Rest rest = block_rest({1, 1, 1});
  std::vector<Place> places = shaken(rest, 0, 1);
  for (Place& p : places) p.x *= 1.1F;  // a stretch alone: the rotation stays what it is
  const Tet tet = rest.piece.tets[0];
  const std::size_t lane = rest.lanes[0] % kernel::kTetLanes, batch = rest.lanes[0] / kernel::kTetLanes;
  std::array<Vec3d, 4> corners;
  std::array<double, 4> inverse_masses{};
  for (std::size_t i = 0; i < 4; ++i) {
    corners[i] = {places[tet[i]].x, places[tet[i]].y, places[tet[i]].z};
    inverse_masses[i] = static_cast<double>(places[tet[i]].inverse_mass);
  }
  const auto expected = reference::relax_unturned_tet(rest.batches[batch], lane, corners, inverse_masses);
  std::vector<kernel::TetRotations> rotations = unturned(rest);
  // Half of the way there is in the places, a part of it in what they lack, and the rest has been moved.
  const std::vector<Place> rest_places = shaken(rest, 0, 1);
  std::vector<Place> half = places;
  std::vector<Offset> remainders(places.size()), moves = moves_between(rest_places, places);
  for (std::size_t v = 0; v < places.size(); ++v) {
    half[v].x = (rest_places[v].x + places[v].x) / 2;
    remainders[v].x = moves[v].x / 8;
    moves[v].x *= 3.0F / 8;
  }
  kernel::relax_tets(std::span(rest.batches).subspan(batch, 1), rotations,
                     {half.data(), remainders.data(), moves.data(), 0});
  for (std::size_t i = 0; i < 4; ++i) {
    const Place& p = half[tet[i]];
    const Offset &r = remainders[tet[i]], &m = moves[tet[i]];
    const Vec3d at = Vec3d{p.x, p.y, p.z} + Vec3d{r.x, r.y, r.z} + Vec3d{m.x, m.y, m.z};
    EXPECT_LT(length(at - expected[i]), 1e-7);
    EXPECT_GT(length(at - corners[i]), 1e-5);
  }
}

TEST(RelaxTets, ABodyAtRestStaysWhereItIs) {
  const simulate::Rest rest = block_rest({3, 3, 3});
  const std::vector<Place> places = shaken(rest, 0, 1);
  const std::vector<Offset> none(places.size());
  std::vector<Offset> moves = moves_between(places, places);
  std::vector<kernel::TetRotations> rotations = unturned(rest);
  for (int i = 0; i < 100; ++i)
    kernel::relax_tets(rest.batches, rotations, {places.data(), none.data(), moves.data(), 0});
  for (const Offset& m : moves) EXPECT_NEAR(m.x, 0, 1e-6F);
}

TEST(RelaxTets, TheBitsAreTheSameOnEveryInstructionSet) {
  const simulate::Rest rest = block_rest({4, 3, 3});
  std::vector<Offset> expected_moves;
  std::vector<kernel::TetRotations> expected_rotations;
  for_each_simd_target([&](const std::string& target) {
    const std::vector<Place> start = shaken(rest, 0.1, 8);
    std::vector<Offset> moves = moves_between(start, shaken(rest, 0.2, 7));  // many tets are inverted
    const std::vector<Offset> remainders = moves_between(start, shaken(rest, 0.01, 9));
    std::vector<kernel::TetRotations> rotations = unturned(rest);
    for (const float damped : {0.0F, 0.4F})
      for (const Offset* lacking : {static_cast<const Offset*>(nullptr), remainders.data()})
        for (int i = 0; i < 3; ++i)
          kernel::relax_tets(rest.batches, rotations, {start.data(), lacking, moves.data(), damped});
    if (expected_moves.empty()) {
      expected_moves = moves;
      expected_rotations = rotations;
    }
    EXPECT_TRUE(same_bits(moves, expected_moves)) << target;
    EXPECT_TRUE(same_bits(rotations, expected_rotations)) << target;
  });
}

TEST(RigidMotion, CorrectedDisplacementsHaveTheMomentaThatWerePredictedWithTheSameBitsEverywhere) {
  const simulate::Rest rest = block_rest({3, 2, 2});
  const float h = 0.002F;
  std::vector<Offset> expected;
  for_each_simd_target([&](const std::string& target) {
    std::vector<Place> start = shaken(rest, 0, 1);
    std::vector<Offset> none(start.size()), moves = moves_between(start, shaken(rest, 0.001, 3));
    std::vector<Motion> motions(start.size());
    test::Random random(5);
    Vec3d linear, angular;
    for (std::size_t v = 0; v < rest.masses.size(); ++v) {
      const Vec3 velocity = to_float({random.uniform(-1, 1), random.uniform(0, 2), random.uniform(-1, 1)});
      motions[v] = {velocity.x, velocity.y, velocity.z, static_cast<float>(rest.masses[v])};
      linear += to_double(velocity) * rest.masses[v];
      angular += cross({start[v].x, start[v].y, start[v].z}, to_double(velocity)) * rest.masses[v];
    }
    const Vec3 about{0.1F, 0, 0.2F};
    const kernel::Movers movers{start, none, moves, motions};
    const auto fit = simulate::fit_rigid_motion(kernel::sum_motion(movers, about, h));
    kernel::correct_motion(movers, to_float(to_double(about) + fit.centre), fit.displacement, h);
    for (std::size_t v = 0; v < rest.masses.size(); ++v) {
      const Vec3d velocity{motions[v].x, motions[v].y, motions[v].z};
      linear -= velocity * rest.masses[v];
      angular -= cross({start[v].x, start[v].y, start[v].z}, velocity) * rest.masses[v];
    }
    EXPECT_LT(length(linear), 1e-4) << target;  // of 12 kg m/s
    EXPECT_LT(length(angular), 1e-4) << target;
    if (expected.empty()) expected = moves;
    EXPECT_TRUE(same_bits(moves, expected)) << target;
  });
}

TEST(RelaxTets, WhatIsMovedTooFarOrToNoNumberIsHeldBack) {
  constexpr float kH = 0.5F, kMost = 2;
  std::vector<kernel::Motion> motions(32, {1, 0, 0, 1});
  for_each_simd_target([&](const std::string& target) {
    std::vector<Offset> moves(32, {0.6F, 0, 0, 1});  // 0.1 from where it was predicted
    moves[3].y = 6;
    moves[20].z = std::numeric_limits<float>::quiet_NaN();
    moves[31].x = std::numeric_limits<float>::infinity();
    EXPECT_EQ(kernel::hold_back(moves, motions, kMost, kH), 3U) << target;
    EXPECT_EQ(moves[0].x, 0.6F);
    EXPECT_NEAR(moves[3].y, kMost, 0.01F);
    EXPECT_EQ(moves[20].x, 0.5F);
    EXPECT_EQ(moves[20].z, 0);
    EXPECT_EQ(moves[31].x, 0.5F);
  });
}

TEST(RigidMotion, WhatAFloatCannotHoldIsKeptWithTheSameBitsEverywhere) {
  std::vector<Place> expected;
  for_each_simd_target([&](const std::string& target) {
    std::vector<Place> places(32, {1000, -0.5F, 0, 1});
    std::vector<Offset> remainders(32), moves(32);
    std::vector<Motion> motions(32, {3e-4F, -2, 5, 1});
    const kernel::Movers movers{places, remainders, moves, motions};
    for (int i = 0; i < 1000; ++i) kernel::predict(movers, {}, 1e-3F);
    kernel::arrive(movers);
    EXPECT_NEAR(static_cast<double>(places[7].x) - 1000 + static_cast<double>(remainders[7].x), 3e-4, 1e-9) << target;
    EXPECT_NEAR(static_cast<double>(places[7].y) + static_cast<double>(remainders[7].y), -2.5, 1e-6) << target;
    EXPECT_EQ(moves[7].x, 0) << target;
    if (expected.empty()) expected = places;
    EXPECT_TRUE(same_bits(places, expected)) << target;
  });
}

}  // namespace
}  // namespace tetsoup
