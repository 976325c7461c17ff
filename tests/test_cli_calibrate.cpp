// The command-line tool, run as a user runs it: meshes that move like fine ones.
#include <nlohmann/json.hpp>

#include "run_tool.h"
#include "tetsoup/io.h"

namespace tetsoup::test {

namespace {

using Json = nlohmann::json;

Json json_of(const fs::path& path) {
  return Json::parse(read_text(path));
}

TEST_F(Tool, a_calibrated_mesh_says_what_was_gained_and_what_its_files_hold) {
  const Outcome outcome = run({"mesh", "cube.obj", "-o", "a.json", "-o", "a.inp", "-o", "a.msh", "--tets", "300",
                               "--calibrate", "--json", "report.json", "--density", "500"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char* part : {"Moves like ", "without calibration they would be ", "a.json holds every tet's factors",
                           "a.inp holds them in up to eight steps", "a.msh has no place for materials: multiply"})
    EXPECT_NE(outcome.out.find(part), std::string::npos) << part << "\n" << outcome.out;
  const Json report = json_of(in_folder("report.json")), calibration = report.at("calibration");
  EXPECT_GT(calibration.at("reference_tets"), 20000);
  EXPECT_LT(calibration.at("after").at("frequencies_1_to_10"), 0.04);
  EXPECT_GT(calibration.at("before").at("frequencies_1_to_10"), calibration.at("after").at("frequencies_1_to_10"));
  EXPECT_LT(calibration.at("mass_error"), 0.01);
  EXPECT_EQ(calibration.at("files"), Json({{{"file", "a.json"}, {"holds", "per-tet"}},
                                           {{"file", "a.inp"}, {"holds", "steps"}},
                                           {{"file", "a.msh"}, {"holds", "none"}}}));
  EXPECT_GT(report.at("seconds").at("calibrate"), 0);
  // The unit cube's mass, not the mesh's: what the report says is what the scales give.
  EXPECT_NEAR(report.at("readiness").at("mass_kg").get<double>(), 500, 0.02 * 500);
  const Json body = json_of(in_folder("a.json"));
  EXPECT_EQ(body.at("stiffness_scale").size(), report.at("tet_count"));
  EXPECT_EQ(body.at("density_scale").size(), report.at("tet_count"));
  EXPECT_LT(body.at("stiffness_factor"), 1);
}

TEST_F(Tool, any_tools_mesh_is_calibrated_by_the_model_it_was_made_of) {
  ASSERT_EQ(run({"mesh", "cube.obj", "-o", "m.vtk", "--tets", "300", "--quiet"}).exit_code, 0);
  const Outcome outcome = run({"calibrate", "m.vtk", "--model", "cube.obj", "-o", "c.json", "--json", "-"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("Moves like "), std::string::npos) << outcome.err;
  EXPECT_LT(Json::parse(outcome.out).at("after").at("frequencies_1_to_10"), 0.04);
  const TetMesh mesh = read_tets(in_folder("m.vtk"));
  const Json body = json_of(in_folder("c.json"));
  EXPECT_EQ(body.at("tets").size(), 4 * mesh.tets.size());
  EXPECT_EQ(body.at("stiffness_scale").size(), mesh.tets.size());
}

TEST_F(Tool, calibrate_refuses_what_it_cannot_do) {
  ASSERT_EQ(run({"mesh", "cube.obj", "-o", "m.vtk", "--voxels", "24", "--cells", "4", "--quiet"}).exit_code, 0);
  EXPECT_EQ(run({"calibrate", "m.vtk", "-o", "c.npz"}).exit_code, 2);
  EXPECT_EQ(run({"calibrate", "m.vtk", "--model", "none.obj", "-o", "c.npz"}).exit_code, 3);
  EXPECT_EQ(run({"calibrate", "m.vtk", "--model", "cube.obj", "-o", "m.vtk"}).exit_code, 2);
  EXPECT_EQ(run({"calibrate", "cube.obj", "--model", "cube.obj", "-o", "c.npz"}).exit_code, 3);
}

TEST_F(Tool, a_mass_may_be_given_instead_of_a_density) {
  const Outcome outcome = run({"mesh", "cube.obj", "-o", "a.json", "--voxels", "24", "--cells", "4", "--mass", "3",
                               "--metres-per-unit", "0.1", "--json", "report.json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json report = json_of(in_folder("report.json")), body = json_of(in_folder("a.json"));
  EXPECT_NEAR(report.at("readiness").at("mass_kg").get<double>(), 3, 1e-6);
  const double volume = report.at("quality").at("volume").get<double>() * 1e-3;
  EXPECT_NEAR(body.at("regions")[0].at("density").get<double>(), 3 / volume, 0.001 * 3 / volume);
  EXPECT_EQ(run({"mesh", "cube.obj", "-o", "a.json", "--mass", "3", "--density", "5"}).exit_code, 2);
  EXPECT_EQ(run({"mesh", "cube.obj", "-o", "a.json", "--mass", "0"}).exit_code, 2);
}

}  // namespace

}  // namespace tetsoup::test
