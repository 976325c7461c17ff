#include <gtest/gtest.h>

#include <array>
#include <random>

#include "kernel/nearest_points.h"
#include "kernel/targets.h"

namespace tetsoup::kernel {
namespace {

void add(PointColumns& points, const Vec3& p) {
  points.x.push_back(p.x);
  points.y.push_back(p.y);
  points.z.push_back(p.z);
}

/// Around a sphere at (30, 30, 30), which the boxes lie outside of, inside of and across, and points in a plane.
PointColumns sphere_and_plane(float radius, int count) {
  std::mt19937 random(7);
  std::normal_distribution<float> normal;
  std::uniform_real_distribution<float> place(0, 60);
  PointColumns points;
  for (int i = 0; i < count; ++i) {
    const Vec3 d{normal(random), normal(random), normal(random)};
    const float scale = radius / std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
    add(points, {30 + scale * d.x, 30 + scale * d.y, 30 + scale * d.z});
    if (i % 3 == 0) add(points, {std::floor(place(random)), std::floor(place(random)), 10});  // many ties
  }
  return points;
}

using Squares = std::array<float, kBrick * kBrick * kBrick>;

Squares asked_one_by_one(const PointColumns& points, const std::array<int, 3>& at) {
  Squares squares;
  for (int i = 0; i < kBrick * kBrick * kBrick; ++i) {
    float& least = squares[static_cast<std::size_t>(i)] = std::numeric_limits<float>::infinity();
    for (std::size_t j = 0; j < points.size(); ++j) {
      const float dx = static_cast<float>(at[0] + i % 8) - points.x[j],
                  dy = static_cast<float>(at[1] + i / 8 % 8) - points.y[j],
                  dz = static_cast<float>(at[2] + i / 64) - points.z[j];
      least = std::min(least, dx * dx + dy * dy + dz * dz);
    }
  }
  return squares;
}

CentredBox box_of(const std::array<int, 3>& at, float edge) {
  const float half = (edge - 1) / 2;
  return {{static_cast<float>(at[0]) + half, static_cast<float>(at[1]) + half, static_cast<float>(at[2]) + half},
          {half, half, half}};
}

TEST(NearestPoints, NoBitDiffersThroughListsOfListsOnAnyTarget) {
  const PointColumns points = sphere_and_plane(17, 1500);
  for (const std::array<int, 3>& at :
       std::vector<std::array<int, 3>>{{0, 0, 0}, {24, 24, 24}, {8, 40, 16}, {56, 0, 32}}) {
    const Squares expected = asked_one_by_one(points, at);
    for_each_simd_target([&](const std::string& target) {
      PointColumns around, kept;
      Squares squares;
      keep_candidates(points, box_of(at, 16), around);
      keep_candidates(around, box_of(at, 8), kept);
      nearest_squares(kept, at[0], at[1], at[2], squares);
      EXPECT_EQ(squares, expected) << target << " at " << at[0];
      EXPECT_LT(kept.size(), around.size()) << target;
    });
  }
}

TEST(NearestPoints, ListsAreShort) {
  const PointColumns points = sphere_and_plane(17, 20000);
  PointColumns kept;
  keep_candidates(points, box_of({56, 56, 56}, 8), kept);
  EXPECT_GT(kept.size(), 0U);
  EXPECT_LT(kept.size(), points.size() / 50);
}

TEST(NearestPoints, FewAndEqualPoints) {
  for (int count = 1; count < 40; ++count) {
    PointColumns points, kept;
    for (int i = 0; i < count; ++i) add(points, {3, 4, 5});
    keep_candidates(points, box_of({0, 0, 0}, 8), kept);
    EXPECT_EQ(kept, points);
    Squares squares;
    nearest_squares(points, 3, 4, 5, squares);
    EXPECT_EQ(squares[0], 0);
    EXPECT_EQ(squares[511], 147);
  }
}

}  // namespace
}  // namespace tetsoup::kernel
