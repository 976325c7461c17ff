// All stages in a row: what is recomputed, what is never wrong whatever goes in, and the figures of the paper.
#include <gtest/gtest.h>

#include <chrono>
#include <limits>
#include <numbers>

#include "kernel/targets.h"
#include "shapes.h"
#include "base/mesh_voxels.h"
#include "tetsoup/samples.h"
#include "tetsoup/tetsoup.h"

namespace tetsoup {
namespace {

std::array<std::size_t, kStageCount> counts(const Pipeline& p) {
  return {p.run_count(Stage::Soup), p.run_count(Stage::Distance), p.run_count(Stage::PseudoVolume),
          p.run_count(Stage::Lattice), p.run_count(Stage::Smooth)};
}
using Counts = std::array<std::size_t, kStageCount>;

MeshOptions at_voxels(int voxels) {
  MeshOptions options;
  options.distance.voxels = voxels;
  return options;
}

void expect_valid(const SmoothResult& result, double floor_degrees = 25) {
  const Quality q = measure_quality(result.mesh);
  EXPECT_GT(q.tet_count, 0U);
  EXPECT_EQ(q.inverted_tets + q.invalid_tets + q.unused_vertices, 0U);
  EXPECT_TRUE(q.boundary_closed);
  EXPECT_GE(q.min_dihedral * 180 / std::numbers::pi, floor_degrees - 1e-6);
  if (result.report.volume_wanted > 0) {
    EXPECT_NEAR(result.report.volume_after / result.report.volume_wanted, 1, 1e-3);
  }
}

TEST(Pipeline, a_mesh_that_is_to_stay_within_the_volume_takes_in_no_outside_voxel) {
  for (const char* name : {"sphere", "robot"}) {
    Pipeline pipeline(make_sample(name));
    MeshOptions options = at_voxels(64);
    options.lattice.tets = 1500;
    const auto outside = [&] {
      const Progress nobody;
      StageWatch watch(nobody, "test");
      const TetMesh& mesh = pipeline.run(options).mesh;
      const MeshVoxels voxels = count_mesh_voxels(mesh, pipeline.pseudo_volume().inside, watch);
      return voxels.in_mesh - voxels.in_both;
    };
    EXPECT_GT(outside(), 0U) << "or the test shows nothing";
    options.lattice.cover = Cover::Inside;
    options.smooth.passes = 0;
    EXPECT_EQ(outside(), 0U) << name << ", lattice";
    options.smooth.passes = 6;
    EXPECT_EQ(outside(), 0U) << name;
    expect_valid(pipeline.smooth());
  }
}

TEST(Pipeline, a_changed_option_recomputes_only_what_depends_on_it) {
  Pipeline pipeline(make_sample("sphere"));
  MeshOptions options = at_voxels(48);
  pipeline.run(options);
  EXPECT_EQ(counts(pipeline), (Counts{1, 1, 1, 1, 1}));
  pipeline.run(options);
  EXPECT_EQ(counts(pipeline), (Counts{1, 1, 1, 1, 1}));
  options.smooth.passes = 2;
  pipeline.run(options);
  EXPECT_EQ(counts(pipeline), (Counts{1, 1, 1, 1, 2}));
  options.lattice.rho_min = 0.3;
  pipeline.run(options);
  EXPECT_EQ(counts(pipeline), (Counts{1, 1, 1, 2, 3}));
  options.lattice.translate_cells.x = 0.5;
  pipeline.run(options);
  EXPECT_EQ(counts(pipeline), (Counts{1, 1, 1, 3, 4}));
  options.pseudo_volume.k = 0.97;
  pipeline.run(options);
  EXPECT_EQ(counts(pipeline), (Counts{1, 1, 2, 4, 5}));
  options.pseudo_volume.k = 0.5;  // a band far wider than what is known: widened, not computed again
  pipeline.run(options);
  EXPECT_EQ(counts(pipeline), (Counts{1, 1, 3, 5, 6}));
  options.distance.voxels = 40;
  pipeline.run(options);
  EXPECT_EQ(counts(pipeline), (Counts{1, 2, 4, 6, 7}));
}

TEST(Pipeline, gives_the_same_bits_as_a_fresh_run) {
  const TriangleSoup soup = make_sample("heart");
  Pipeline pipeline(soup);
  MeshOptions options = at_voxels(40);
  options.pseudo_volume.k = 0.6;
  pipeline.run(options);
  options.pseudo_volume.k.reset();
  const TetMesh again = pipeline.run(options).mesh, fresh = mesh_soup(soup, options);
  EXPECT_EQ(again.vertices, fresh.vertices);
  EXPECT_EQ(again.tets, fresh.tets);
}

TEST(Pipeline, a_cancelled_run_can_be_taken_up_again) {
  const TriangleSoup soup = make_sample("torus");
  const MeshOptions options = at_voxels(64);
  const TetMesh whole = mesh_soup(soup, options);
  for (const std::string_view stop_in : {"distance", "pseudo_volume", "lattice", "smooth"}) {
    Pipeline pipeline(soup);
    const auto stop = [&](std::string_view stage, double fraction) { return stage != stop_in || fraction == 0; };
    EXPECT_THROW(pipeline.run(options, stop), Cancelled) << stop_in;
    EXPECT_EQ(pipeline.run(options).mesh.vertices, whole.vertices) << stop_in;
  }
}

TEST(Pipeline, progress_names_every_stage_in_order_and_never_goes_back) {
  std::vector<std::string> stages;
  double last = 0;
  mesh_soup(make_sample("sphere"), at_voxels(48), [&](std::string_view stage, double fraction) {
    if (stages.empty() || stages.back() != stage) {
      stages.emplace_back(stage);
      last = 0;
    }
    EXPECT_GE(fraction, 0);
    EXPECT_LE(fraction, 1);
    if (stage == "pseudo_volume") {
      EXPECT_GE(fraction, last);
      last = fraction;
    }
    return true;
  });
  EXPECT_EQ(stages, (std::vector<std::string>{"soup", "distance", "pseudo_volume", "lattice", "smooth"}));
}

TEST(Pipeline, a_grid_beyond_the_memory_limit_is_refused_with_what_would_fit) {
  Pipeline pipeline(make_sample("sphere"));
  MeshOptions options = at_voxels(512);
  options.memory_limit = 50'000'000;
  try {
    pipeline.run(options);
    FAIL();
  } catch (const InvalidInput& e) {
    int fits = 0;
    ASSERT_EQ(std::sscanf(e.what(), "voxels = 512 needs %*f GB of memory, must be at most %d", &fits), 1) << e.what();
    options.distance.voxels = fits;
    EXPECT_NO_THROW(pipeline.run_until(Stage::Distance, options));
    options.distance.voxels = fits + fits / 10;
    EXPECT_THROW(pipeline.run_until(Stage::Distance, options), InvalidInput);
  }
}

TEST(MeshSoup, an_empty_soup_is_an_error_that_says_so) {
  EXPECT_THROW(mesh_soup({}), InvalidInput);
  TriangleSoup nan = test::make_box({0, 0, 0}, {1, 1, 1});
  for (Vec3& v : nan.vertices) v.x = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(mesh_soup(nan), InvalidInput);
}

TEST(MeshSoup, every_sample_damaged_or_not_gives_a_valid_mesh) {
  for (const std::string& name : sample_names()) {
    for (const double damage : {0.0, 0.5, 0.95}) {
      SCOPED_TRACE(name + " damage " + std::to_string(damage));
      Pipeline pipeline(make_sample(name, {damage, 3}));
      expect_valid(pipeline.run(at_voxels(48)));
    }
  }
}

TEST(MeshSoup, soups_of_any_size_place_and_shape_give_a_valid_mesh) {
  const auto moved = [](TriangleSoup soup, double scale, double offset) {
    for (Vec3& v : soup.vertices) v = to_float(to_double(v) * scale + Vec3d{offset, -offset, offset});
    return soup;
  };
  const TriangleSoup ball = test::make_globe(8, 12, [](Vec3d p) { return p; });
  for (const double scale : {1e-36, 1e-20, 1e-3, 1.0, 1e6, 1e23}) {
    SCOPED_TRACE(scale);
    for (const double offset : {0.0, 10.0, 1e4, 1e6}) {
      SCOPED_TRACE(offset);
      Pipeline pipeline(moved(ball, scale, offset * scale));
      expect_valid(pipeline.run(at_voxels(24)));
    }
  }
}

TEST(MeshSoup, random_soups_full_of_rubbish_give_a_valid_mesh) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(seed);
    test::Random random(seed);
    TriangleSoup soup;
    const std::size_t count = 1 + random.below(40);
    const double flat = random.below(3) == 0 ? 0 : 1;
    for (std::size_t i = 0; i < 3 * count; ++i)
      soup.vertices.push_back(to_float({random.uniform(-1, 1), random.uniform(-1, 1) * flat, random.uniform(-2, 2)}));
    soup.vertices.push_back({std::numeric_limits<float>::infinity(), 0, 0});
    for (std::size_t i = 0; i < count; ++i) {
      const auto any = [&] { return static_cast<std::uint32_t>(random.below(3 * count + 3)); };
      soup.triangles.push_back({any(), any(), any()});
    }
    soup.triangles.push_back({0, 1, 2});
    MeshOptions options = at_voxels(8 + static_cast<int>(random.below(24)));
    options.lattice.rotate = {random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-3, 3)};
    options.lattice.translate_cells = {random.uniform(), random.uniform(), random.uniform()};
    options.lattice.rho_min = random.uniform(0.01, 1);
    Pipeline pipeline(soup);
    expect_valid(pipeline.run(options));
  }
}

TEST(MeshSoup, winding_order_and_threads_change_no_bit) {
  const TriangleSoup soup = test::joined(test::make_ball(), test::make_confetti(300, 0.2, 3));
  set_thread_count(1);
  const TetMesh a = mesh_soup(soup, at_voxels(48));
  set_thread_count(7);
  const TetMesh b = mesh_soup(test::scrambled(soup, 11), at_voxels(48));
  set_thread_count(0);
  EXPECT_EQ(a.vertices, b.vertices);
  EXPECT_EQ(a.tets, b.tets);
}

/// The solid of 640 flat triangles itself overlaps the exact torus by 0.989 when sampled finely (docs/RESULTS.md).
TEST(MeshSoup, the_instruction_set_changes_no_bit) {
  const TriangleSoup soup = make_sample("robot");
  const TetMesh usual = mesh_soup(soup, at_voxels(40));
  for_each_simd_target([&](const std::string& target) {
    const TetMesh mesh = mesh_soup(soup, at_voxels(40));
    EXPECT_EQ(mesh.vertices, usual.vertices) << target;
    EXPECT_EQ(mesh.tets, usual.tets) << target;
  });
}

TEST(Paper, the_inside_of_the_torus_is_the_exact_torus_as_far_as_its_triangles_are) {
  Pipeline pipeline(make_sample("torus"));
  pipeline.run_until(Stage::PseudoVolume, at_voxels(150));
  const auto in_torus = [](const Vec3d& p) {
    return std::hypot(std::hypot(p.x, p.y) - kTorusMajorRadius, p.z) < kTorusMinorRadius;
  };
  // The solid of its 640 triangles, of which voxels are exact, has .989 in common with the torus, and its volume.
  EXPECT_GE(test::overlap(pipeline.pseudo_volume().inside, in_torus), 0.988);
  EXPECT_NEAR(pipeline.pseudo_volume().report.volume / std::abs(pipeline.soup().parts.parts.front().volume), 1, 5e-3);
}

TEST(Paper, the_torus_gives_meshes_of_about_139_and_8000_tets_with_its_volume) {
  const double exact =
      2 * std::numbers::pi * std::numbers::pi * kTorusMajorRadius * kTorusMinorRadius * kTorusMinorRadius;
  Pipeline pipeline(make_sample("torus"));
  MeshOptions options = at_voxels(150);
  options.lattice.cell_size = 23;
  options.lattice.translate_cells = {0.5, 0.5, 0};
  const SmoothResult coarse = pipeline.run(options);
  EXPECT_EQ(pipeline.distance().distance.frame.size, (std::array<int, 3>{154, 154, 41}));
  expect_valid(coarse);
  EXPECT_GE(coarse.mesh.tets.size(), 100U);
  EXPECT_LE(coarse.mesh.tets.size(), 200U);
  EXPECT_TRUE(measure_quality(coarse.mesh).boundary_manifold);
  EXPECT_NEAR(measure_quality(coarse.mesh).volume / exact, 1, 0.1);
  options.lattice = {};
  options.lattice.cells = 24;
  const SmoothResult fine = pipeline.run(options);
  expect_valid(fine);
  EXPECT_GE(fine.mesh.tets.size(), 7000U);
  EXPECT_LE(fine.mesh.tets.size(), 9000U);
  EXPECT_NEAR(measure_quality(fine.mesh).volume / exact, 1, 0.02);
}

}  // namespace
}  // namespace tetsoup
