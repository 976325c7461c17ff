// The command-line tool, run as a user runs it: what it makes and what it says about it.
#include <nlohmann/json.hpp>

#include "run_tool.h"

namespace tetsoup::test {

namespace {

using Json = nlohmann::json;
using Words = std::vector<std::string>;

TEST_F(Tool, a_lone_triangle_is_meshed_like_anything_else) {
  write_text(in_folder("one.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const Outcome outcome = run({"mesh", "one.obj", "-o", "x.msh", "--voxels", "24", "--json", "x.json"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_GT(Json::parse(read_text(in_folder("x.json"))).at("tet_count").get<int>(), 0);
}

TEST_F(Tool, says_in_plain_words_what_was_found_and_dropped) {
  write_text(in_folder("open.obj"), std::string(kCube) + "v inf 0 0\nf 1 2 9\nf 1 2 3\nf 1 2 3\n");
  const Outcome outcome = run({"mesh", "open.obj", "-o", "x.msh", "--voxels", "24", "--cells", "5"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char* part : {"triangles were dropped", "1 with non-finite coordinates", "k = ", "was chosen",
                           "Time: ", "Wrote x.msh", "dihedral angles"})
    EXPECT_NE(outcome.out.find(part), std::string::npos) << part << "\n" << outcome.out;
}

TEST_F(Tool, the_json_report_has_the_members_that_scripts_rely_on) {
  const Outcome outcome = mesh_cube({"--json", "cube.json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json report = Json::parse(read_text(in_folder("cube.json")));
  for (const char* count : {"tet_count", "vertex_count", "inverted_tets", "components"})
    EXPECT_TRUE(report.at(count).is_number_unsigned()) << count;
  for (const char* number : {"min_dihedral_deg", "max_dihedral_deg", "volume", "iou_pseudo_volume", "k", "band_voxels"})
    EXPECT_TRUE(report.at(number).is_number_float()) << number;
  EXPECT_TRUE(report.at("boundary_manifold").is_boolean());
  EXPECT_EQ(report.at("voxels"), Json({24, 24, 24}));
  EXPECT_EQ(report.at("soup").at("class"), "closed");
  EXPECT_EQ(report.at("soup").at("triangle_count"), 12);
  for (const char* step : {"read", "distance", "pseudo_volume", "lattice", "smooth", "write", "total"})
    EXPECT_GE(report.at("seconds").at(step).get<double>(), 0) << step;
  EXPECT_EQ(report.at("inverted_tets"), 0);
  EXPECT_GT(report.at("tet_count").get<int>(), 0);
  EXPECT_NEAR(report.at("volume").get<double>(), 1, 0.2);
  EXPECT_GE(report.at("min_dihedral_deg").get<double>(), 14.99);
  EXPECT_EQ(report.at("outputs"), Json({"cube.msh"}));
}

TEST_F(Tool, options_reach_the_library) {
  const Outcome outcome = mesh_cube({"--band-voxels",
                                     "2",
                                     "--rays",
                                     "13",
                                     "--placement",
                                     "entry",
                                     "--cavities",
                                     "keep",
                                     "--rho-min",
                                     "0.25",
                                     "--translate",
                                     "-.5,0,1e-1",
                                     "--rotate=90,0,-45",
                                     "--passes",
                                     "0",
                                     "--strength",
                                     "0.5",
                                     "--min-angle",
                                     "10",
                                     "--threads",
                                     "1",
                                     "--json",
                                     "-"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json report = Json::parse(outcome.out);
  const Json& options = report.at("options");
  EXPECT_NEAR(report.at("band_voxels").get<double>(), 2, 1e-6);
  EXPECT_EQ(options.at("rays"), 13);
  EXPECT_EQ(options.at("placement"), "entry");
  EXPECT_EQ(options.at("cavities"), "keep");
  EXPECT_EQ(options.at("cells"), 5);
  EXPECT_EQ(options.at("rho_min"), 0.25);
  EXPECT_EQ(options.at("translate"), Json({-0.5, 0.0, 0.1}));
  EXPECT_NEAR(options.at("rotate_deg").at(0).get<double>(), 90, 1e-12);
  EXPECT_NEAR(options.at("rotate_deg").at(2).get<double>(), -45, 1e-12);
  EXPECT_EQ(report.at("smooth").at("passes"), 0);
  EXPECT_EQ(options.at("strength"), 0.5);
  EXPECT_NEAR(options.at("min_angle_deg").get<double>(), 10, 1e-12);
  EXPECT_EQ(options.at("threads"), 1);
}

TEST_F(Tool, a_report_on_standard_output_leaves_the_summary_to_standard_error) {
  const Outcome outcome = mesh_cube({"--json", "-"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(Json::accept(outcome.out)) << outcome.out;
  EXPECT_NE(outcome.err.find("Wrote cube.msh"), std::string::npos) << outcome.err;
}

TEST_F(Tool, quiet_prints_nothing_but_errors) {
  const Outcome outcome = mesh_cube({"--quiet"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.err, "");
  EXPECT_TRUE(fs::exists(in_folder("cube.msh")));
  EXPECT_NE(run({"mesh", "missing.obj", "-o", "x.msh", "--quiet"}).err, "");
}

TEST_F(Tool, draws_no_progress_bar_into_a_pipe_or_file) {
  const Outcome outcome = mesh_cube({});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(outcome.out.find_first_of("\r\033"), std::string::npos);
}

TEST_F(Tool, draws_a_progress_bar_on_a_terminal_and_clears_it) {
  const Words words{"mesh", "cube.obj", "-o", "cube.msh", "--voxels", "48"};
  const Outcome outcome = run_on_terminal(words, false);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find(" %"), std::string::npos) << outcome.err;
  EXPECT_TRUE(outcome.err.ends_with("\r\033[K")) << outcome.err;
  Words quiet = words;
  quiet.push_back("--quiet");
  EXPECT_EQ(run_on_terminal(quiet, false).err, "");
}

TEST_F(Tool, ctrl_c_stops_a_long_run_and_leaves_no_file) {
  const Outcome outcome = run_on_terminal({"mesh", "cube.obj", "-o", "cube.msh", "--voxels", "128", "--cells", "40",
                                           "--passes", "1000", "--json", "cube.json"},
                                          true);
  constexpr int kExitCancelled = 130;
  EXPECT_EQ(outcome.exit_code, kExitCancelled) << outcome.err;
  EXPECT_NE(outcome.err.find("cancelled"), std::string::npos) << outcome.err;
  EXPECT_EQ(files(), Words{"cube.obj"});
}

TEST_F(Tool, writes_several_formats_and_a_picture_in_one_run) {
  const Outcome outcome = mesh_cube({"-o", "cube.vtk", "-o", "cube.node", "-o", "skin.stl", "--preview", "cube.png"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(files(),
            (Words{"cube.ele", "cube.face", "cube.msh", "cube.node", "cube.obj", "cube.png", "cube.vtk", "skin.stl"}));
}

TEST_F(Tool, takes_a_format_by_name) {
  const Outcome outcome = run({"mesh", "cube.obj", "-o", "cube.dat", "--format", "msh22", "--voxels", "24", "-q"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(read_text(in_folder("cube.dat")).starts_with("$MeshFormat\n2.2 ")) << outcome.err;
}

TEST_F(Tool, inspects_a_soup) {
  const Outcome outcome = run({"inspect", "cube.obj", "--json", "-"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(Json::parse(outcome.out).at("soup").at("class"), "closed");
  EXPECT_NE(outcome.err.find("closed surface"), std::string::npos) << outcome.err;
}

TEST_F(Tool, inspect_lists_the_names_of_parts) {
  write_text(in_folder("named.obj"),
             "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\no my body\nusemtl red\x1b[1m\nf 1 2 3 4\ng lid\nf 1 2 4\n");
  const Outcome outcome = run({"inspect", "named.obj", "--json", "-"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(
      Json::parse(outcome.out).at("parts").dump(),
      R"([{"kind":"object","name":"my body","triangle_count":3},{"kind":"group","name":"lid","triangle_count":1},)"
      R"({"kind":"material","name":"red\u001b[1m","triangle_count":3}])");
  EXPECT_NE(outcome.err.find("triangles of object                  3  'my body'\n"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("'red?[1m'"), std::string::npos) << outcome.err;
}

TEST_F(Tool, inspects_a_tet_mesh_that_it_wrote) {
  ASSERT_EQ(mesh_cube({"--json", "cube.json", "-q"}).exit_code, 0);
  const Outcome outcome = run({"inspect", "cube.msh", "--json", "quality.json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("dihedral angles"), std::string::npos) << outcome.out;
  const Json written = Json::parse(read_text(in_folder("cube.json")));
  const Json quality = Json::parse(read_text(in_folder("quality.json"))).at("quality");
  EXPECT_EQ(quality.at("tet_count"), written.at("tet_count"));
  EXPECT_EQ(quality.at("vertex_count"), written.at("vertex_count"));
  EXPECT_NEAR(quality.at("volume").get<double>(), written.at("volume").get<double>(), 1e-5);
}

TEST_F(Tool, says_whether_the_mesh_is_ready_for_simulation_and_for_which_time_step) {
  const Outcome outcome = mesh_cube({"--json", "cube.json", "--density", "500", "--metres-per-unit", "0.001"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("Ready for simulation"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("explicit time steps up to"), std::string::npos) << outcome.out;
  const Json report = Json::parse(read_text(in_folder("cube.json")));
  const Json& readiness = report.at("readiness");
  EXPECT_EQ(readiness.at("checks").at("inverted_tets").at("passed"), true);
  EXPECT_EQ(readiness.at("checks").at("components").at("value"), 1);
  EXPECT_NEAR(readiness.at("mass_kg").get<double>(), 500e-9 * report.at("volume").get<double>(), 1e-12);
  EXPECT_GT(readiness.at("stable_time_step_s").get<double>(), 0);
  const Outcome inspected = run({"inspect", "cube.msh", "--density", "500", "--metres-per-unit", "0.001"});
  EXPECT_NE(inspected.out.find("explicit time steps up to"), std::string::npos) << inspected.out;
  EXPECT_EQ(run({"inspect", "cube.msh", "--poisson", "0.5"}).exit_code, 2);
}

TEST_F(Tool, writes_the_field) {
  const Outcome outcome = run({"field", "cube.obj", "-o", "cube.vti", "--voxels", "16", "--k", "0.9"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(read_text(in_folder("cube.vti")).find("ImageData"), std::string::npos);
  EXPECT_NE(outcome.out.find("16 x 16 x 16 voxels"), std::string::npos) << outcome.out;
  EXPECT_EQ(run({"field", "cube.obj", "-o", "band.vti", "--voxels", "16", "--band-only", "-q"}).exit_code, 0);
}

TEST_F(Tool, lists_and_writes_samples) {
  const Outcome list = run({"sample"});
  EXPECT_EQ(list.exit_code, 0);
  EXPECT_NE(list.out.find("torus "), std::string::npos) << list.out;
  EXPECT_EQ(run({"sample", "torus", "-q"}).exit_code, 0);
  const Outcome intact = run({"inspect", "torus.obj", "--json", "-"});
  const Json soup = Json::parse(intact.out).at("soup");
  EXPECT_EQ(soup.at("triangle_count"), 640);
  EXPECT_EQ(soup.at("class"), "closed");
}

TEST_F(Tool, damages_a_sample_by_seed) {
  for (const auto& [seed, file] : {std::pair("7", "a.ply"), std::pair("7", "b.ply"), std::pair("8", "c.ply")})
    ASSERT_EQ(run({"sample", "torus", "-o", file, "--damage", "0.5", "--seed", seed}).exit_code, 0);
  EXPECT_EQ(read_text(in_folder("a.ply")), read_text(in_folder("b.ply")));
  EXPECT_NE(read_text(in_folder("a.ply")), read_text(in_folder("c.ply")));
  const Outcome outcome = run({"inspect", "a.ply", "--json", "-"});
  EXPECT_EQ(Json::parse(outcome.out).at("soup").at("triangle_count"), 320);
}

}  // namespace

}  // namespace tetsoup::test
