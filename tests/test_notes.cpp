// What the user should know of a mesh: the same sentences from library, tool and C.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "base/words.h"
#include "run_tool.h"
#include "tetsoup/report.h"
#include "tetsoup/samples.h"
#include "tetsoup/tetsoup.h"
#include "tetsoup/tetsoup_c.h"

namespace tetsoup {
namespace {

MeshOptions small(std::size_t tets = 300) {
  MeshOptions options;
  options.distance.voxels = 32;
  options.lattice.tets = tets;
  return options;
}

std::vector<std::string> notes_on(Pipeline& pipeline, const MeshOptions& options, const std::string& engine = {}) {
  const TetMesh& mesh = pipeline.run(options).mesh;
  return notes_of({.pipeline = pipeline,
                   .quality = measure_quality(mesh),
                   .fidelity = measure_fidelity(mesh, pipeline.soup()),
                   .engine = engine});
}

bool any_names(const std::vector<std::string>& notes, const std::string& words) {
  return std::any_of(notes.begin(), notes.end(), [&](const auto& n) { return n.find(words) != std::string::npos; });
}

TEST(Notes, counts_and_shares_read_like_text) {
  EXPECT_EQ(counted(1, "vertex") + ", " + counted(2013, "vertex") + ", " + counted(2, "tet"),
            "1 vertex, 2,013 vertices, 2 tets");
  EXPECT_EQ(percent(0.004) + ", " + percent(0.118) + ", " + percent(1), "0.4 %, 12 %, 100 %");
  EXPECT_EQ(listed({"a", "b", "c"}), "a, b and c");
}

TEST(Notes, a_sphere_needs_none) {
  Pipeline pipeline(make_sample("sphere"));
  EXPECT_EQ(notes_on(pipeline, small()), std::vector<std::string>{});
}

TEST(Notes, each_names_the_option_that_changes_what_it_says) {
  const TriangleSoup sheet{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  Pipeline pipeline(sheet);
  MeshOptions options;
  options.distance.voxels = 32;
  options.lattice.cells = 6;
  EXPECT_TRUE(any_names(notes_on(pipeline, options), "(--rho-min 0.5)"));
  Pipeline coarse(make_sample("sphere"));
  options.distance.voxels = 16;
  options.lattice.cells = 24;
  EXPECT_TRUE(any_names(notes_on(coarse, options), "--voxels 32"));
}

TEST(Notes, a_cup_whose_wall_no_tet_can_be_is_told_with_what_it_does_to_the_mass) {
  Pipeline pipeline(make_sample("cup", {.wall = 0.01}));
  const std::vector<std::string> notes = notes_on(pipeline, small());
  EXPECT_TRUE(any_names(notes, "mass")) << listed(notes);
  EXPECT_TRUE(any_names(notes, "times the model's")) << listed(notes);
  EXPECT_TRUE(any_names(notes, "--voxels") || any_names(notes, "--tets")) << listed(notes);
}

TEST(Notes, an_engine_that_reads_metres_is_told_of_a_giant) {
  Pipeline pipeline(make_sample("torus"));
  EXPECT_FALSE(any_names(notes_on(pipeline, small()), "--metres-per-unit"));
  EXPECT_TRUE(any_names(notes_on(pipeline, small(), "mujoco"), "--metres-per-unit"));
}

TEST(TetCount, is_the_smallest_at_which_the_shape_holds) {
  MeshOptions options;
  options.distance.voxels = 64;
  Pipeline ball(make_sample("sphere"));
  const CountSearch few = find_tet_count(ball, options);
  EXPECT_TRUE(few.held);
  EXPECT_EQ(few.tets, 500U);
  EXPECT_EQ(ball.options().lattice.tets, 500U);
}

class NotesOfTheTool : public test::Tool {};

TEST_F(NotesOfTheTool, json_printed_page_and_c_say_the_same) {
  test::write_text(in_folder("sheet.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const test::Outcome outcome = run({"mesh", "sheet.obj", "-o", "sheet.msh", "--cells", "6", "--json", "sheet.json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const nlohmann::json said = nlohmann::json::parse(test::read_text(in_folder("sheet.json")))["notes"];
  ASSERT_FALSE(said.empty());
  for (const auto& note : said) EXPECT_NE(outcome.out.find("Note: " + note.get<std::string>()), std::string::npos);

  const float vertices[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const std::uint32_t triangle[3] = {0, 1, 2};
  tetsoup_soup* soup = nullptr;
  tetsoup_pipeline* pipeline = nullptr;
  const char* json = nullptr;
  ASSERT_EQ(tetsoup_soup_create(vertices, 3, triangle, 1, &soup), TETSOUP_OK);
  ASSERT_EQ(tetsoup_pipeline_create(soup, nullptr, nullptr, &pipeline), TETSOUP_OK);
  ASSERT_EQ(tetsoup_pipeline_run(pipeline, "{\"cells\": 6}", nullptr, nullptr), TETSOUP_OK);
  ASSERT_EQ(tetsoup_pipeline_report(pipeline, nullptr, &json), TETSOUP_OK);
  EXPECT_EQ(nlohmann::json::parse(json)["notes"], said);
  tetsoup_pipeline_destroy(pipeline);
  tetsoup_soup_destroy(soup);
}

TEST_F(NotesOfTheTool, tets_auto_is_told_as_the_count_that_was_taken) {
  ASSERT_EQ(run({"sample", "sphere", "-q"}).exit_code, 0);
  ASSERT_EQ(run({"mesh", "sphere.obj", "-o", "a.msh", "--tets", "auto", "--json", "a.json", "-q"}).exit_code, 0);
  const nlohmann::json report = nlohmann::json::parse(test::read_text(in_folder("a.json")));
  EXPECT_EQ(report["options"]["tets"], 500);
  EXPECT_EQ(run({"mesh", "sphere.obj", "-o", "a.msh", "--tets", "many"}).exit_code, 2);
}

}  // namespace
}  // namespace tetsoup
