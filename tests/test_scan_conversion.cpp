// The scan-converted band against its obvious twin: every voxel asks every triangle. Bit for bit.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/bits.h"
#include "distance/fine_soups.h"
#include "distance/scan_conversion.h"
#include "distance/triangle_tree.h"
#include "kernel/targets.h"
#include "shapes.h"

#include "tetsoup/distance.h"
#include "tetsoup/samples.h"

namespace tetsoup {
namespace {

GridFrame grid_over(const CleanSoup& soup, int voxels) {
  DistanceOptions options;
  options.voxels = voxels;
  return make_grid(soup, options);
}

BlockGrid scanned(const CleanSoup& soup, int voxels, float band) {
  const Progress silent;
  StageWatch watch(silent, "distance");
  const GridFrame frame = grid_over(soup, voxels);
  return scan_convert(find_features(soup, frame, watch), frame, band, watch);
}

/// Every voxel, one by one.
BlockGrid asked(const std::vector<Triangle>& triangles, const std::vector<Vec3>& corners, const GridFrame& frame,
                float band) {
  const Progress silent;
  StageWatch watch(silent, "distance");
  BitGrid all = make_bit_grid(frame);
  for (std::size_t i = 0; i < all.words.size(); ++i) all.words[i] = row_mask(frame.size[0], i % all.words_per_row);
  return ask_voxels(CornerTree(triangles, corners, watch), all, band, watch);
}

void expect_same_as_brute_force(const TriangleSoup& soup, int voxels, float band) {
  const CleanSoup clean = clean_soup(soup);
  const GridFrame frame = grid_over(clean, voxels);
  const BlockGrid fast = scanned(clean, voxels, band);
  const std::vector<Vec3> vertices = voxel_vertices(clean, frame);
  EXPECT_EQ(asked(clean.soup.triangles, vertices, frame, band), fast);
  std::vector<kernel::TrianglePlan> plans;
  for (const Triangle& t : clean.soup.triangles)
    plans.push_back(kernel::plan_triangle(vertices[t[0]], vertices[t[1]], vertices[t[2]]));
  std::size_t known = 0;
  for (int z = 0; z < frame.size[2]; ++z) {
    for (int y = 0; y < frame.size[1]; ++y) {
      for (int x = 0; x < frame.size[0]; ++x) {
        float square = kernel::kBeyond;
        for (const kernel::TrianglePlan& plan : plans)
          square = std::min(square, kernel::squared_distance(plan, static_cast<float>(x), static_cast<float>(y),
                                                             static_cast<float>(z)));
        const float expected = square < band * band ? std::sqrt(square) * static_cast<float>(frame.voxel_size)
                                                    : std::numeric_limits<float>::infinity();
        ASSERT_EQ(fast.at(x, y, z), expected) << x << ' ' << y << ' ' << z;
        known += square < band * band;
      }
    }
  }
  EXPECT_GT(known, 0U);
}

/// Triangles that share vertices at random: edges of many triangles, corners of many edges, folds and slivers.
TriangleSoup make_knot(std::size_t vertices, std::size_t triangles, std::uint64_t seed) {
  test::Random random(seed);
  TriangleSoup soup;
  for (std::size_t i = 0; i < vertices; ++i)
    soup.vertices.push_back(to_float({random.uniform(), random.uniform(), random.uniform()}));
  const auto any = [&] { return static_cast<std::uint32_t>(random.uniform() * static_cast<double>(vertices) * 0.999); };
  for (std::size_t i = 0; i < triangles; ++i) soup.triangles.push_back({any(), any(), any()});
  return soup;
}

/// A height field on whole numbers: coplanar neighbours, ties, saddles, ridges; `bump` 1e-5 makes it all but flat.
TriangleSoup make_terrain(int size, double bump, std::uint64_t seed) {
  test::Random random(seed);
  TriangleSoup soup;
  for (int y = 0; y <= size; ++y)
    for (int x = 0; x <= size; ++x)
      soup.vertices.push_back(to_float({double(x), double(y), std::floor(random.uniform() * 3) * bump}));
  const auto at = [&](int x, int y) { return static_cast<std::uint32_t>(y * (size + 1) + x); };
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      soup.triangles.push_back({at(x, y), at(x + 1, y), at(x + 1, y + 1)});
      soup.triangles.push_back({at(x, y), at(x + 1, y + 1), at(x, y + 1)});
    }
  }
  return soup;
}

TEST(ScanConversion, gives_the_bits_of_the_brute_force_on_closed_surfaces) {
  expect_same_as_brute_force(test::make_ball(), 16, 3);
  expect_same_as_brute_force(test::make_box({0, 0, 0}, {1, 0.5, 0.3}), 40, 3.24F);
  expect_same_as_brute_force(make_sample("torus"), 20, 3);
  expect_same_as_brute_force(make_sample("heart"), 8, 5);
}

TEST(ScanConversion, gives_the_bits_of_the_brute_force_on_loose_triangles) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    expect_same_as_brute_force(test::make_confetti(150, 0.1, seed), 28, 3);
    expect_same_as_brute_force(test::make_confetti(12, 0.8, seed), 28, 7);
  }
}

TEST(ScanConversion, gives_the_bits_of_the_brute_force_where_many_triangles_meet) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    expect_same_as_brute_force(make_knot(6, 60, seed), 24, 4);
    expect_same_as_brute_force(make_knot(60, 40, seed), 24, 4);
  }
}

TEST(ScanConversion, gives_the_bits_of_the_brute_force_on_coplanar_and_nearly_flat_neighbours) {
  for (const double bump : {0.0, 1e-5, 0.02, 0.5}) {
    expect_same_as_brute_force(make_terrain(12, bump, 3), 24, 3);
    expect_same_as_brute_force(make_terrain(7, bump, 4), 41, 6);
  }
}

TEST(ScanConversion, gives_the_bits_of_the_brute_force_on_slivers) {
  for (const float width : {1e-2F, 1e-4F, 1e-6F, 0.0F}) {
    TriangleSoup soup;
    soup.vertices = {{0, 0, 0}, {1, 0.3F, 0.2F}, {0.5F, 0.15F + width, 0.1F}, {0.4F, 0.5F, 0.9F}};
    soup.triangles = {{0, 1, 2}, {0, 2, 3}};
    expect_same_as_brute_force(soup, 32, 5);
  }
}

TEST(ScanConversion, has_the_same_bits_on_every_instruction_set_and_thread_count) {
  const CleanSoup soup = clean_soup(test::joined(make_sample("torus"), test::make_confetti(200, 0.2, 9)));
  const BlockGrid usual = scanned(soup, 70, 3.5F);
  for_each_simd_target([&](const std::string& target) { EXPECT_EQ(scanned(soup, 70, 3.5F), usual) << target; });
  for (const int threads : {1, 2, 7}) {
    set_thread_count(threads);
    EXPECT_EQ(scanned(soup, 70, 3.5F), usual) << threads;
  }
  set_thread_count(0);
}

TEST(ScanConversion, the_full_field_has_the_same_bits_on_every_instruction_set_and_thread_count) {
  const CleanSoup soup = clean_soup(test::joined(make_sample("torus"), test::make_confetti(20, 0.3, 9)));
  DistanceOptions options;
  options.voxels = 45;
  options.mode = DistanceMode::Full;
  const BlockGrid usual = unsigned_distance(soup, options).distance;
  for_each_simd_target(
      [&](const std::string& target) { EXPECT_EQ(unsigned_distance(soup, options).distance, usual) << target; });
  for (const int threads : {1, 2, 7}) {
    set_thread_count(threads);
    EXPECT_EQ(unsigned_distance(soup, options).distance, usual) << threads;
  }
  set_thread_count(0);
}

TEST(ScanConversion, far_more_triangles_than_voxels_give_the_same_bits_with_fewer_questions) {
  // A ball of 240,000 triangles with a stray one, on so few voxels.
  const TriangleSoup ball = test::make_globe(401, 300, [](Vec3d p) { return p; });
  const CleanSoup soup = clean_soup(test::joined(ball, test::make_confetti(1, 0.1, 3)));
  const GridFrame frame = grid_over(soup, 20);
  const Progress silent;
  StageWatch watch(silent, "distance");
  const std::vector<Vec3> corners = voxel_vertices(soup, frame);
  EXPECT_TRUE(voxels_worth_asking(soup.soup.triangles, corners, frame, 3.25, watch));
  const GridFrame fine = grid_over(soup, 200);
  EXPECT_FALSE(voxels_worth_asking(soup.soup.triangles, voxel_vertices(soup, fine), fine, 3.25, watch));
  DistanceOptions options;
  options.voxels = 20;
  DistanceField field = unsigned_distance(soup, options);
  EXPECT_EQ(field.distance, scanned(soup, 20, 3.25F));
  const TriangleTree tree(soup.soup.triangles, corners, watch);
  const float middle = 0.5F * static_cast<float>(frame.size[0] - 1);
  EXPECT_NEAR(field.d_max, std::sqrt(tree.nearest_squared(middle, middle, middle, 1e6F)) * frame.voxel_size, 0.1);
  widen_distance(field, soup, 6);
  EXPECT_EQ(field.distance, scanned(soup, 20, 6));
}

TEST(ScanConversion, the_tree_gives_the_bits_of_the_brute_force) {
  const CleanSoup soup = clean_soup(make_knot(40, 77, 5));
  const GridFrame frame = grid_over(soup, 20);
  const Progress silent;
  StageWatch watch(silent, "distance");
  const SoupFeatures features = find_features(soup, frame, watch);
  const TriangleTree tree(features.triangles, features.corners, watch);
  for (int i = 0; i < 500; ++i) {
    const auto x = static_cast<float>(i % 24), y = static_cast<float>(i / 24), z = static_cast<float>(i % 19);
    float best = kernel::kBeyond;
    for (const Triangle& t : features.triangles)
      best = std::min(
          best,
          kernel::squared_distance(
              kernel::plan_triangle(features.corners[t[0]], features.corners[t[1]], features.corners[t[2]]), x, y, z));
    ASSERT_EQ(tree.nearest_squared(x, y, z, std::numeric_limits<float>::max()), best);
  }
}

}  // namespace
}  // namespace tetsoup
