// Smoothing of what is out of the ordinary: bad tets, extreme sizes, wrong options, a caller who says stop.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "smooth_shapes.h"
#include "tetsoup/error.h"

namespace tetsoup {

TEST(Smooth, bad_tets_of_the_input_get_no_worse) {
  // Squeezed to a fifth: dihedral angles start below the floor.
  TetMesh mesh = ball(0.3);
  for (Vec3& v : mesh.vertices) v.z *= 0.1F;
  ASSERT_LT(measure_quality(mesh).min_dihedral, 15 * kDegree);
  const SmoothResult result = smooth_tets(mesh);
  expect_kept(mesh, result);
  EXPECT_FALSE(same_bits(result.mesh, mesh));
}

TEST(Smooth, is_the_same_at_any_thread_count) {
  const TetMesh mesh = torus(0.15);
  set_thread_count(1);
  const SmoothResult one = smooth_tets(mesh);
  set_thread_count(0);
  const SmoothResult all = smooth_tets(mesh);
  EXPECT_TRUE(same_bits(one.mesh, all.mesh));
  EXPECT_EQ(one.report.boundary_volume_ratio, all.report.boundary_volume_ratio);
}

TEST(Smooth, scaling_by_a_power_of_two_scales_the_bits) {
  const TetMesh mesh = ball(0.25);
  const TetMesh smooth = smooth_tets(mesh).mesh;
  for (const int power : {-100, -7, 3, 100}) {
    const float factor = std::ldexp(1.0F, power);
    EXPECT_TRUE(same_bits(smooth_tets(scaled(mesh, factor)).mesh, scaled(smooth, factor))) << power;
  }
}

TEST(Smooth, far_from_the_origin_tets_stay_sound) {
  // One float step is 1/16 of a unit here, a quarter of a cell, then 1/160.
  for (const float shift : {1e6F, 1e5F, 1e3F}) {
    TetMesh mesh = scaled(block_mesh({5, 4, 3}), 0.25F);
    for (Vec3& v : mesh.vertices) v.x += shift;
    expect_kept(mesh, smooth_tets(mesh));
  }
}

TEST(Smooth, huge_and_tiny_meshes_work) {
  const TetMesh mesh = torus(0.25);
  for (const float factor : {1e30F, 1e37F, 1e-30F, 1e-36F}) {
    const TetMesh start = scaled(mesh, factor);
    const SmoothResult result = smooth_tets(start);
    expect_kept(start, result);
    EXPECT_LT(roughness(result.mesh), 0.6 * roughness(start));
  }
}

TEST(Smooth, duplicate_tets_and_faces_with_three_tets_do_no_harm) {
  TetMesh twice = block_mesh({2, 2, 2});
  const std::vector<Tet> tets = twice.tets;
  twice.tets.insert(twice.tets.end(), tets.begin(), tets.end());
  expect_kept(twice, smooth_tets(twice));
  TetMesh fan = block_mesh({1, 1, 1});
  fan.tets.push_back(fan.tets[0]);
  expect_kept(fan, smooth_tets(fan));
}

TEST(Smooth, vertices_without_tets_stay) {
  TetMesh mesh = ball(0.4);
  mesh.vertices.insert(mesh.vertices.begin(), Vec3{std::numeric_limits<float>::quiet_NaN(), 7, 7});
  for (Tet& tet : mesh.tets) {
    for (std::uint32_t& v : tet) ++v;
  }
  const SmoothResult result = smooth_tets(mesh);
  expect_kept(mesh, result);
  EXPECT_EQ(std::memcmp(result.mesh.vertices.data(), mesh.vertices.data(), sizeof(Vec3)), 0);
}

TEST(Smooth, options_out_of_range_are_named) {
  const auto complaint = [](const SmoothOptions& options) -> std::string {
    try {
      smooth_tets(block_mesh({1, 1, 1}), options);
    } catch (const InvalidInput& error) {
      return error.what();
    }
    return "";
  };
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(complaint({.passes = -1}).find("passes = -1"), 0U);
  EXPECT_EQ(complaint({.passes = 1001}).find("passes"), 0U);
  for (const double bad : {0.0, -1.0, nan, infinity}) EXPECT_EQ(complaint({.strength = bad}).find("strength"), 0U);
  for (const double bad : {-0.1, 1.05, nan}) EXPECT_EQ(complaint({.min_dihedral = bad}).find("min_dihedral"), 0U);
  EXPECT_EQ(complaint({.passes = 1000, .strength = 1e300}), "");
}

TEST(Smooth, tets_that_are_not_positive_are_refused) {
  TetMesh mesh = block_mesh({1, 1, 1});
  const TetMesh good = mesh;
  std::swap(mesh.tets[2][0], mesh.tets[2][1]);
  EXPECT_THROW(smooth_tets(mesh), InvalidInput);
  mesh = good;
  mesh.tets[1] = {0, 1, 2, 99};
  EXPECT_THROW(smooth_tets(mesh), InvalidInput);
  mesh.tets[1] = {0, 1, 2, 2};
  EXPECT_THROW(smooth_tets(mesh), InvalidInput);
  mesh = good;
  mesh.vertices[0].x = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(smooth_tets(mesh), InvalidInput);
}

TEST(Smooth, a_progress_callback_sees_rising_fractions_and_can_stop) {
  const TetMesh mesh = ball(0.2);
  double last = 0;
  int calls = 0;
  smooth_tets(mesh, {}, [&](std::string_view stage, double fraction) {
    EXPECT_EQ(stage, "smooth");
    EXPECT_GE(fraction, last);
    EXPECT_LE(fraction, 1);
    last = fraction;
    ++calls;
    return true;
  });
  EXPECT_GT(calls, 10);
  for (int stop = 1; stop <= calls; stop += 5) {
    int seen = 0;
    EXPECT_THROW(smooth_tets(mesh, {}, [&](std::string_view, double) { return ++seen < stop; }), Cancelled);
    EXPECT_EQ(seen, stop);
  }
}

}  // namespace tetsoup
