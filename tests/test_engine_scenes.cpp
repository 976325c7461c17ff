// Scenes: what a model says of itself stands in the text of every engine that takes it. That the engines run them is
// tests/engines.
#include <cmath>
#include <regex>
#include <string>

#include "base/vec.h"
#include "io/engines/scene_parts.h"
#include "tet_models.h"
#include "tetsoup/engines.h"

namespace tetsoup {

namespace fs = std::filesystem;

namespace {

/// Two tets of 1/2 and 1 m^3, 3 m long along y: 1,500 kg, 1,000 kg/m^3 and 3e6 Pa in the mean.
TetModel two_materials() {
  TetModel model;
  model.name = "my body";
  model.mesh = two_tets();
  for (Vec3& v : model.mesh.vertices) v.y = 2 + 3 * v.y;
  model.regions = {{"soft", {600, 1e6, 0.25, 1}}, {"stiff", {1200, 4e6, 0.25, 1}}};
  model.tet_regions = {0, 1};
  model.pins = {{"floor", {0, 1}}, {"wall", {1, 3}}};
  model.up = UpAxis::Y;
  return model;
}

/// Body and scene, each scene's text in turn.
class Scenes : public FolderTest {
 protected:
  std::string text_of(const char* engine, const TetModel& model, bool material_is_default = false,
                      const std::string& stem = "body") {
    return bytes_of(write_for_engine(find_engine(engine), folder_ / stem, model, material_is_default).back());
  }
};

void expect_all(const std::string& text, std::initializer_list<const char*> parts) {
  for (const char* part : parts) EXPECT_NE(text.find(part), text.npos) << part << " is not in\n" << text;
}

}  // namespace

TEST_F(Scenes, know_the_material_and_what_is_held) {
  const TetModel model = two_materials();
  expect_all(text_of("mujoco", model), {"mass=\"1500\"", "young=\"3e+06\" poisson=\"0.25\"", "<pin id=\"0 1 3\"/>"});
  expect_all(text_of("bullet", model), {"MASS = 1500 ", "MU, LAMBDA = 1.2e+06, 1.2e+06 ", "HELD = [0, 1, 3]"});
  expect_all(text_of("drake", model), {"set_mass_density(1000)", "YOUNG = 3e+06 ", "set_poissons_ratio(0.25)",
                                       "HELD = [0, 1, 3]", "for vertex in HELD"});
  expect_all(text_of("sofa", model),
             {"totalMass=1500,", "YOUNG = [1e+06, 4e+06] ", "poissonRatio=0.25)", "HELD = [0, 1, 3]"});
  expect_all(text_of("newton", model), {"STIFFENING = 1 ", "YOUNG = 3e+06 "});
  expect_all(bytes_of(folder_ / "body.npz"), {"pin_floor.npy", "pin_wall.npy", "tet_densities.npy"});
  expect_all(text_of("calculix", model), {"NSET=HELD_IN_SCENE\n1, 2, 4\n"});
  expect_all(bytes_of(folder_ / "body.inp"), {"1e+06, 0.25\n*DENSITY\n600\n", "4e+06, 0.25\n*DENSITY\n1200\n"});
}

TEST_F(Scenes, hold_nothing_unless_asked) {
  TetModel model = two_materials();
  model.pins.clear();
  EXPECT_EQ(text_of("mujoco", model).find("<pin"), std::string::npos);
  for (const char* engine : {"bullet", "drake", "sofa"}) expect_all(text_of(engine, model), {"HELD = []"});
  // But for CalculiX's, whose static step needs a foot to stand on: the four lowest vertices.
  expect_all(text_of("calculix", model), {"NSET=HELD_IN_SCENE\n1, 2, 3, 4\n"});
}

TEST_F(Scenes, pybullet_refuses_a_body_of_pieces_rather_than_hang) {
  TetModel model = two_materials();
  expect_all(text_of("bullet", model), {"PIECES = 1 ", "if PIECES > 1:"});
  for (const Vec3& v : two_tets().vertices) model.mesh.vertices.push_back({v.x + 9, v.y, v.z});
  model.mesh.tets.push_back({5, 6, 7, 8});
  model.tet_regions.push_back(0);
  expect_all(text_of("bullet", model), {"PIECES = 2 "});
}

TEST_F(Scenes, turn_the_axis_that_points_up) {
  TetModel model = two_materials();
  expect_all(text_of("mujoco", model), {"quat=\"0.70710678 0.70710678 0 0\""});
  expect_all(text_of("bullet", model), {"baseOrientation=[0.70710678, 0, 0, 0.70710678]"});
  expect_all(text_of("drake", model), {"Quaternion(0.70710678, 0.70710678, 0, 0)"});
  expect_all(text_of("newton", model), {"warp.quat(0.70710678, 0, 0, 0.70710678)"});
  expect_all(text_of("sofa", model), {"= [90, 0, 0], ["});
  expect_all(text_of("calculix", model), {"GRAV, 9.81, 0, -1, 0\n"});
  model.up = UpAxis::Z;
  expect_all(text_of("mujoco", model), {"quat=\"1 0 0 0\""});
  expect_all(text_of("calculix", model), {"GRAV, 9.81, 0, 0, -1\n"});
}

TEST_F(Scenes, start_a_little_above_the_plane_over_the_origin) {
  TetModel model = two_materials();
  for (const UpAxis up : {UpAxis::X, UpAxis::Y, UpAxis::Z}) {
    model.up = up;
    const Drop drop = plan_drop({model, "body.msh", true}, {0.01, 0});
    double w = 0;
    Vec3d axis;
    ASSERT_EQ(std::sscanf(upright_wxyz(up, " ").c_str(), "%lf %lf %lf %lf", &w, &axis.x, &axis.y, &axis.z), 4);
    Vec3d low{9, 9, 9}, high{-9, -9, -9};
    for (const Vec3& v : model.mesh.vertices) {
      const Vec3d p = to_double(v), turn = cross(axis, p) * 2;
      const Vec3d placed = p + turn * w + cross(axis, turn) + Vec3d{drop.x, drop.y, drop.lift};
      low = min(low, placed);
      high = max(high, placed);
    }
    EXPECT_NEAR(high.z - low.z, up == UpAxis::Y ? 3 : 1, 1e-6);
    EXPECT_NEAR(low.z, 0.05 * (high.z - low.z), 1e-6);
    EXPECT_NEAR(low.x + high.x, 0, 1e-6);
    EXPECT_NEAR(low.y + high.y, 0, 1e-6);
  }
}

TEST_F(Scenes, a_default_material_suits_the_step_and_a_chosen_one_shortens_it) {
  TetModel model = two_materials();
  expect_all(text_of("mujoco", model, true), {"timestep=\"0.002\""});
  for (Region& region : model.regions) region.material.young = 1e12;
  const std::string text = text_of("mujoco", model);
  EXPECT_EQ(text.find("timestep=\"0.002\""), text.npos);
  expect_all(text, {"young=\"1e+12\"", "as asked for; it needs a shorter time step"});
  // Implicit engines keep theirs.
  expect_all(text_of("drake", model), {"STEP = 0.01 "});
}

TEST_F(Scenes, names_are_legal_and_every_gap_is_filled) {
  const std::regex gap("@[a-z]+@");
  for (const Engine& engine : engines()) {
    if (engine.scene_extension.empty()) continue;
    SCOPED_TRACE(engine.name);
    const std::string text = text_of(engine.name.c_str(), two_materials(), true, "Jo's \"body\" & <co>");
    EXPECT_FALSE(std::regex_search(text, gap)) << text;
    if (engine.name == "mujoco") {
      expect_all(text, {"<mujoco model=\"my_body\">", "file=\"Jo's &quot;body&quot; &amp; &lt;co>.msh\""});
    } else if (engine.name != "calculix") {
      expect_all(text, {"\"Jo's \\\"body\\\" & <co>"});
    }
  }
}

}  // namespace tetsoup
