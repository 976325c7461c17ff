// The command-line tool, run as a user runs it: meshes for engines.
#include <nlohmann/json.hpp>

#include "run_tool.h"

namespace tetsoup::test {

namespace {

using Json = nlohmann::json;
using Words = std::vector<std::string>;

TEST_F(Tool, help_of_mesh_lists_the_engines) {
  const std::string help = run({"mesh", "--help"}).out;
  for (const char* name : {"--for ENGINE", "mujoco", "sofa", "unity-json", "--up x|y|z", "--for mujoco"})
    EXPECT_NE(help.find(name), std::string::npos) << name;
}

TEST_F(Tool, writes_for_an_engine_by_a_stem_and_says_what_to_do_next) {
  const Outcome outcome = run({"mesh", "cube.obj", "-o", "body", "--for", "tetgen", "--voxels", "24", "--cells", "4"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char* part : {"Wrote body.node\n", "Wrote body.ele\n", "Wrote body.face\n", "Next: ", "body.node"})
    EXPECT_NE(outcome.out.find(part), std::string::npos) << outcome.out;
  EXPECT_EQ(files(), (Words{"body.ele", "body.face", "body.node", "cube.obj"}));
}

TEST_F(Tool, writes_for_an_engine_by_its_own_extension_in_metres) {
  const Outcome outcome = run({"mesh", "cube.obj", "-o", "body.json", "--for", "godot", "--voxels", "24", "--cells",
                               "4", "--metres-per-unit", "0.5", "--json", "report.json", "--up", "x"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json body = Json::parse(read_text(in_folder("body.json")));
  EXPECT_EQ(body.at("name"), "cube");
  EXPECT_EQ(body.at("up"), "x");
  EXPECT_EQ(body.at("metres_per_unit"), 1);
  const Json report = Json::parse(read_text(in_folder("report.json")));
  EXPECT_EQ(report.at("engine"), "godot");
  EXPECT_EQ(report.at("outputs"), Json({"body.json"}));
  EXPECT_EQ(body.at("tets").size(), 4 * report.at("tet_count").get<std::size_t>());
  double highest = 0;
  for (const Json& coordinate : body.at("vertices")) highest = std::max(highest, coordinate.get<double>());
  EXPECT_NEAR(highest, 0.5, 0.1);
}

TEST_F(Tool, bodies_as_large_as_houses_are_asked_for_their_unit) {
  const auto out_with = [&](const char* unit) {
    return run({"mesh", "cube.obj", "-o", "body", "--for", "godot", "--voxels", "24", "--cells", "4",
                "--metres-per-unit", unit})
        .out;
  };
  EXPECT_NE(out_with("50").find("the body is 50 m long"), std::string::npos);
  EXPECT_NE(out_with("1e-5").find("--metres-per-unit 0.001"), std::string::npos);
  EXPECT_EQ(out_with("0.1").find("m long"), std::string::npos);
}

TEST_F(Tool, models_of_obj_stand_on_y_and_others_on_z_unless_told) {
  write_text(in_folder("tet.off"), "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
  const auto up_of = [&](const std::string& input) {
    const Outcome outcome = run({"mesh", input, "-o", "m.json", "--voxels", "24", "--cells", "4", "--quiet"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return Json::parse(read_text(in_folder("m.json"))).at("up");
  };
  EXPECT_EQ(up_of("cube.obj"), "y");
  EXPECT_EQ(up_of("tet.off"), "z");
}

TEST_F(Tool, the_report_names_no_engine_where_none_was_asked_for) {
  const Outcome outcome = mesh_cube({"--json", "cube.json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(Json::parse(read_text(in_folder("cube.json"))).at("engine").is_null());
  EXPECT_EQ(outcome.out.find("Next: "), std::string::npos);
}

TEST_F(Tool, obj_is_tets_only_if_the_format_says_so) {
  EXPECT_EQ(run({"mesh", "cube.obj", "-o", "s.obj", "--voxels", "24", "--cells", "4"}).exit_code, 0);
  EXPECT_EQ(run({"mesh", "cube.obj", "-o", "t.obj", "--format", "objtets", "--voxels", "24", "--cells", "4"}).exit_code,
            0);
  const auto corners = [&](const std::string& name) {
    std::istringstream text(read_text(in_folder(name)));
    std::ptrdiff_t most = 0;
    for (std::string line; std::getline(text, line);)
      if (line.starts_with("f ")) most = std::max(most, std::count(line.begin(), line.end(), ' '));
    return most;
  };
  EXPECT_EQ(corners("s.obj"), 3);
  EXPECT_EQ(corners("t.obj"), 4);
}

TEST_F(Tool, refuses_what_an_engine_cannot_be_given_before_any_work) {
  fs::create_directory(in_folder("taken.bou"));
  const std::vector<std::pair<Words, Words>> wrong{
      {{"-o", "x", "--for", "mojuco"}, {"--for", "mojuco", "did you mean mujoco?", "vega"}},
      {{"-o", "x", "--for"}, {"--for"}},
      {{"-o", "x.vtk", "--for", "mujoco"}, {"-o", "x.vtk", ".msh"}},
      {{"-o", "x", "-o", "y", "--for", "mujoco"}, {"--for", "exactly one -o"}},
      {{"-o", "x.msh", "--for", "mujoco", "--format", "msh"}, {"--for", "--format"}},
      {{"-o", "x", "--for", "mujoco", "--json", "x.msh"}, {"--json", "x.msh"}},
      {{"-o", "x", "--for", "newton", "--embed", "x.npz"}, {"--embed x.npz", "-o writes a file of this name"}},
      {{"-o", "x.msh", "--up", "w"}, {"--up w", "x, y or z"}},
      {{"-o", "cube", "--for", "blender"}, {"-o", "cube.obj", "input"}}};
  for (const auto& [words, parts] : wrong) {
    Words line{"mesh", "cube.obj"};
    line.insert(line.end(), words.begin(), words.end());
    const Outcome outcome = run(line);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
    expect_error_line(outcome, parts);
  }
  const Outcome outcome = run({"mesh", "cube.obj", "-o", "taken", "--for", "vega"});
  EXPECT_EQ(outcome.exit_code, 3);
  expect_error_line(outcome, {"-o", "taken.bou"});
  EXPECT_EQ(files(), (Words{"cube.obj", "taken.bou"}));
}

TEST_F(Tool, a_line_break_in_a_files_name_does_not_become_a_card_of_calculix) {
  const Outcome outcome = run({"mesh", "cube.obj", "-o", "a\n*STEP", "--for", "calculix", "--cells", "2"});
  EXPECT_EQ(outcome.exit_code, 3);
  expect_error_line(outcome, {"CalculiX", "line break"});
  EXPECT_EQ(files(), Words{"cube.obj"});
}

TEST_F(Tool, a_run_that_fails_in_the_end_leaves_none_of_an_engines_files_but_what_stood_there) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "needs /dev/full";
  write_text(in_folder("body.bou"), "mine");
  const Outcome outcome =
      run({"mesh", "cube.obj", "-o", "body", "--for", "vega", "--voxels", "24", "--cells", "4", "--json", "-"},
          "/dev/full");
  EXPECT_EQ(outcome.exit_code, 3);
  expect_error_line(outcome, {"standard output"});
  EXPECT_EQ(files(), (Words{"body.bou", "cube.obj"}));
  EXPECT_EQ(read_text(in_folder("body.bou")), "mine");
}

}  // namespace

}  // namespace tetsoup::test
