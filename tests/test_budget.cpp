// Stage 4: the wanted number of tets or vertices is hit, and the search for a fit finds the frame that meets the shape.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "base/vec.h"
#include "shapes.h"
#include "tetsoup/io.h"
#include "tetsoup/samples.h"
#include "tetsoup/tetsoup.h"

namespace tetsoup {
namespace {

constexpr std::array kKinds{LatticeKind::Five, LatticeKind::Bcc};

Pipeline classified(const TriangleSoup& soup, int voxels) {
  Pipeline pipeline(soup);
  MeshOptions options;
  options.distance.voxels = voxels;
  pipeline.run_until(Stage::PseudoVolume, options);
  return pipeline;
}

LatticeMesh fill(const Pipeline& pipeline, const LatticeOptions& options) {
  return fill_lattice(pipeline.pseudo_volume(), pipeline.soup(), options);
}

double tolerance(std::size_t wanted) {
  return wanted >= 200 ? 0.05 : 0.1;
}

TEST(Budget, tets_and_vertices_are_hit_on_shapes_of_all_kinds_with_few_fills) {
  for (const char* name : {"torus", "heart", "robot", "tree"}) {
    const Pipeline pipeline = classified(make_sample(name), 64);
    for (const LatticeKind kind : kKinds) {
      for (const std::size_t wanted : {50U, 200U, 500U, 2000U, 10000U}) {
        SCOPED_TRACE(std::string(name) + " " + std::to_string(wanted));
        LatticeOptions options;
        options.kind = kind;
        options.tets = wanted;
        const LatticeMesh by_tets = fill(pipeline, options);
        EXPECT_NEAR(static_cast<double>(by_tets.mesh.tets.size()) / static_cast<double>(wanted), 1, tolerance(wanted));
        EXPECT_LE(by_tets.report.fills, 16);
        options.tets.reset();
        options.vertices = wanted;
        const LatticeMesh by_vertices = fill(pipeline, options);
        EXPECT_NEAR(static_cast<double>(by_vertices.mesh.vertices.size()) / static_cast<double>(wanted), 1,
                    tolerance(wanted));
        EXPECT_LE(by_vertices.report.fills, 16);
      }
    }
  }
}

TEST(Budget, a_cube_whose_layers_come_and_go_at_once_is_hit_too) {
  const Pipeline pipeline = classified(test::make_box({0, 0, 0}, {1, 1, 1}), 64);
  for (const LatticeKind kind : kKinds) {
    for (const std::size_t wanted : {50U, 300U, 1000U, 2000U, 3000U}) {
      LatticeOptions options;
      options.kind = kind;
      options.tets = wanted;
      const double got = static_cast<double>(fill(pipeline, options).mesh.tets.size());
      EXPECT_NEAR(got / static_cast<double>(wanted), 1, tolerance(wanted)) << wanted;
    }
  }
}

TEST(Budget, two_sizes_are_refused_and_both_named) {
  const Pipeline pipeline = classified(test::make_ball(), 16);
  LatticeOptions options;
  options.tets = 100;
  options.edge = 0.2;
  try {
    fill(pipeline, options);
    FAIL() << "not refused";
  } catch (const InvalidInput& error) {
    EXPECT_NE(std::string(error.what()).find("tets"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("edge"), std::string::npos) << error.what();
  }
}

TEST(Budget, edge_is_the_mean_edge_of_a_block_of_lattice) {
  const Pipeline pipeline = classified(test::make_box({0, 0, 0}, {1, 1, 1}), 64);
  for (const LatticeKind kind : kKinds) {
    LatticeOptions options;
    options.kind = kind;
    options.edge = 0.1;
    const double cell = fill(pipeline, options).report.cell_size;
    const double mean = kind == LatticeKind::Five ? (1 + std::sqrt(2)) / 2 : (3 + 2 * std::sqrt(3)) / 7;  // in cells
    EXPECT_NEAR(cell, 0.1 / mean, 1e-12);
  }
}

/// A block that lies askew.
TriangleSoup make_turned_block() {
  TriangleSoup soup = test::make_box({-1, -0.5, -0.5}, {1, 0.5, 0.5});
  const double c = std::cos(0.5), s = std::sin(0.5);
  for (Vec3& v : soup.vertices) {
    const Vec3d p = to_double(v), q{c * p.x - s * p.y, s * p.x + c * p.y, p.z};
    v = to_float({q.x + 0.07, c * q.y - s * q.z, s * q.y + c * q.z});
  }
  return soup;
}

TEST(Fit, finds_how_a_block_lies_and_keeps_the_count) {
  const Pipeline pipeline = classified(make_turned_block(), 64);
  LatticeOptions options;
  options.tets = 8 * 4 * 4 * 5;
  options.fit = Fit::Search;
  const LatticeReport r = fill(pipeline, options).report;
  EXPECT_GT(r.overlap, 0.9);
  EXPECT_LT(r.overlap_unfitted, 0.85);
  EXPECT_NEAR(static_cast<double>(r.tet_count), 640, 32);
  EXPECT_NE(r.rotate, Vec3d());
}

TEST(Fit, the_frame_it_reports_is_the_frame_of_the_mesh) {
  const Pipeline pipeline = classified(make_sample("heart"), 64);
  for (const LatticeKind kind : kKinds) {
    LatticeOptions options;
    options.kind = kind;
    options.fit = Fit::Search;
    const LatticeMesh found = fill(pipeline, options);
    EXPECT_GE(found.report.overlap, found.report.overlap_unfitted);
    EXPECT_NEAR(found.report.overlap, intersection_over_union(found.mesh, pipeline.pseudo_volume().inside), 1e-12);
    LatticeOptions same;
    same.kind = kind;
    same.cell_size = found.report.cell_size;
    same.translate_cells = found.report.translate_cells;
    same.rotate = found.report.rotate;
    const LatticeMesh again = fill(pipeline, same);
    EXPECT_EQ(again.mesh.vertices, found.mesh.vertices);
    EXPECT_EQ(again.mesh.tets, found.mesh.tets);
  }
}

TEST(Fit, with_a_given_edge_only_shift_and_rotation_change) {
  const Pipeline pipeline = classified(make_sample("robot"), 64);
  LatticeOptions options;
  options.cells = 10;
  options.fit = Fit::Search;
  const double cell = fill(pipeline, options).report.cell_size;
  options.fit = Fit::Off;
  EXPECT_EQ(cell, fill(pipeline, options).report.cell_size);
}

TEST(Fit, same_bits_at_any_thread_count_and_cancellable) {
  const Pipeline pipeline = classified(make_sample("torus"), 48);
  LatticeOptions options;
  options.fit = Fit::Search;
  set_thread_count(1);
  const TetMesh one = fill(pipeline, options).mesh;
  set_thread_count(5);
  const TetMesh many = fill(pipeline, options).mesh;
  set_thread_count(0);
  EXPECT_EQ(one.vertices, many.vertices);
  EXPECT_EQ(one.tets, many.tets);
  int calls = 0;
  const auto stop_late = [&](std::string_view, double) { return ++calls < 200; };
  EXPECT_THROW(fill_lattice(pipeline.pseudo_volume(), pipeline.soup(), options, stop_late), Cancelled);
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST(BudgetOfModels, is_hit_on_every_model) {
  const std::filesystem::path folder = TETSOUP_MODELS_DIR;
  if (!std::filesystem::is_directory(folder)) GTEST_SKIP() << "no models in " << folder << ": nothing to test here";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".md") continue;
    const Pipeline pipeline = classified(read_soup(entry.path()), 128);
    struct Case {
      LatticeKind kind;
      std::size_t wanted;
    };
    for (const auto& [kind, wanted] :
         {Case{LatticeKind::Five, 200}, {LatticeKind::Five, 2000}, {LatticeKind::Bcc, 500}}) {
      LatticeOptions options;
      options.kind = kind;
      options.tets = wanted;
      const LatticeMesh lattice = fill(pipeline, options);
      EXPECT_NEAR(static_cast<double>(lattice.mesh.tets.size()) / static_cast<double>(wanted), 1, 0.05)
          << entry.path().filename() << ", " << wanted;
      EXPECT_LE(lattice.report.fills, 16);
    }
  }
}
#endif

}  // namespace
}  // namespace tetsoup
