// Real models, where they are present: what no formula has.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>

#include "shapes.h"
#include "tetsoup/io.h"
#include "tetsoup/samples.h"
#include "tetsoup/tetsoup.h"

namespace tetsoup {
namespace {

namespace fs = std::filesystem;

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr int kVoxels = 32;  // instrumented code is an order of magnitude slower
#else
constexpr int kVoxels = 128;
#endif

class Models : public testing::Test {
 protected:
  void SetUp() override {
    if (!fs::is_directory(folder)) GTEST_SKIP() << "no models in " << folder << ": nothing to test here";
  }
  std::vector<fs::path> files() const {
    std::vector<fs::path> found;
    for (const auto& entry : fs::directory_iterator(folder))
      if (entry.path().extension() != ".md") found.push_back(entry.path());
    std::sort(found.begin(), found.end());
    return found;
  }
  const fs::path folder = TETSOUP_MODELS_DIR;
};

TEST_F(Models, every_one_gives_a_valid_mesh_with_default_options) {
  for (const fs::path& file : files()) {
    SCOPED_TRACE(file.filename());
    Pipeline pipeline(read_soup(file));
    MeshOptions options;
    options.distance.voxels = kVoxels;
    const SmoothResult& result = pipeline.run(options);
    const Quality q = measure_quality(result.mesh);
    EXPECT_GT(q.tet_count, 0U);
    EXPECT_EQ(q.inverted_tets + q.invalid_tets, 0U);
    EXPECT_TRUE(q.boundary_manifold);
    EXPECT_GE(q.min_dihedral * 180 / std::numbers::pi, 25 - 1e-6);
    EXPECT_LE(q.max_dihedral * 180 / std::numbers::pi, 155 + 1e-6);
    EXPECT_LE(q.max_edge_ratio, 3.5 + 1e-6);
    if (result.report.volume_wanted > 0) {
      EXPECT_NEAR(result.report.volume_after / result.report.volume_wanted, 1, 1e-3);
    }
    const Quality raw = measure_quality(pipeline.lattice().mesh);
    const CleanSoup& clean = pipeline.soup();
    if (kVoxels >= 128) {  // voxels as coarse as the tets show no surface to come nearer to
      EXPECT_LT(boundary_distance(result.mesh, clean.soup, 1).mean,
                boundary_distance(pipeline.lattice().mesh, clean.soup, 1).mean);
    }
    // A lone sheet's layer is as thin as a tet may be: it gains little from smoothing.
    EXPECT_GT(raw.boundary_curvature * (pipeline.lattice().report.kept_by_soup ? 1.2 : 1.1), q.boundary_curvature);
    EXPECT_GT(pipeline.pseudo_volume().report.soup_covered, 0.9);
  }
}

/// The collection's README has a table of what other tools counted: file | triangles | vertices | components | boundary
/// edges | nonmanifold edges | turned edges.
TEST_F(Models, diagnosis_agrees_with_the_table_of_the_collection) {
  std::ifstream table(folder / "README.md");
  std::size_t compared = 0;
  for (std::string line; std::getline(table, line);) {
    std::replace(line.begin(), line.end(), '|', ' ');
    std::istringstream words(line);
    std::string name;
    std::array<std::size_t, 6> n{};
    words >> name;
    if (!fs::exists(folder / name) || name.find('.') == std::string::npos) continue;
    for (std::size_t& value : n) words >> value;
    if (!words) continue;  // the table of licences
    SCOPED_TRACE(name);
    const SoupReport r = clean_soup(read_soup(folder / name)).report;
    EXPECT_EQ(r.triangle_count, n[0]);
    EXPECT_EQ(r.components, n[2]);
    EXPECT_EQ(r.boundary_edges, n[3]);
    EXPECT_EQ(r.non_manifold_edges, n[4]);
    EXPECT_EQ(r.inconsistent_edges, n[5]);
    ++compared;
  }
  EXPECT_GE(compared, 30U);
}

TEST_F(Models, a_damaged_bunny_is_still_the_bunny) {
  const TriangleSoup bunny = read_soup(folder / "bunny-69k.ply");
  MeshOptions options;
  options.distance.voxels = 128;
  Pipeline whole(bunny);
  whole.run_until(Stage::PseudoVolume, options);
  options.distance.box = whole.soup().report.box;
  const auto overlap_with = [&](const TriangleSoup& soup) {
    Pipeline damaged(soup);
    damaged.run_until(Stage::PseudoVolume, options);
    return test::overlap(whole.pseudo_volume().inside, damaged.pseudo_volume().inside);
  };
  const double turned = overlap_with(test::scrambled(bunny, 1)), half = overlap_with(remove_triangles(bunny, 0.5, 1)),
               twentieth = overlap_with(remove_triangles(bunny, 0.95, 1));
  EXPECT_EQ(turned, 1.0);
  EXPECT_GE(half, 0.97);
  EXPECT_GE(twentieth, 0.93);
  RecordProperty("half", std::to_string(half));
  RecordProperty("twentieth", std::to_string(twentieth));
}

}  // namespace
}  // namespace tetsoup
