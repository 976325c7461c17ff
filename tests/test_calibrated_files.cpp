// What files and scenes say of a calibrated model: every tet's factors, a few steps of them, or the one for all.
#include <nlohmann/json.hpp>

#include <cmath>
#include <regex>

#include "base/tet_geometry.h"
#include "io/calibrated_model.h"
#include "io/npz.h"
#include "io/tet_writers.h"
#include "io/zip_reader.h"
#include "tet_models.h"
#include "tetsoup/engines.h"
#include "tetsoup/error.h"
#include "tetsoup/io.h"

namespace tetsoup {

namespace fs = std::filesystem;

namespace {

/// Volumes 1/6 and 1/3: mean density 2/3 of the material's.
TetModel two_scales() {
  TetModel model;
  model.mesh = two_tets();
  model.regions = {{"all", {900, 1e6, 0.25, 1}}};
  model.stiffness_scale = {0.5F, 0.25F};
  model.density_scale = {1.0F, 0.5F};
  model.stiffness_factor = 0.375;
  return model;
}

/// Many tets, `scale` a function of the number of each.
template <class Scale>
TetModel block_with(const Scale& scale) {
  TetModel model;
  model.mesh = block_of_tets(6);
  for (std::size_t t = 0; t < model.mesh.tets.size(); ++t)
    model.stiffness_scale.push_back(static_cast<float>(scale(t, model.mesh.tets.size())));
  model.density_scale.assign(model.mesh.tets.size(), 1.0F);
  return model;
}

class CalibratedFiles : public FolderTest {
 protected:
  std::string text_of(const char* engine, const TetModel& model, bool material_is_default = false) {
    return bytes_of(write_for_engine(find_engine(engine), folder_ / "body", model, material_is_default).back());
  }
  std::string mesh_of(const char* name, const TetModel& model) {
    return bytes_of(write_tets(folder_ / name, model).front());
  }
};

void expect_all(const std::string& text, std::initializer_list<const char*> parts) {
  for (const char* part : parts) EXPECT_NE(text.find(part), text.npos) << part << " is not in\n" << text;
}

}  // namespace

TEST_F(CalibratedFiles, npz_has_the_scales_and_moduli_with_them) {
  const std::string bytes = npz_text(two_scales());
  const auto arrays = read_npz(bytes, "f");
  EXPECT_EQ(npz_reals(arrays, "f", "stiffness_scale", 0), (std::vector<double>{0.5, 0.25}));
  EXPECT_EQ(npz_reals(arrays, "f", "density_scale", 0), (std::vector<double>{1, 0.5}));
  EXPECT_EQ(npz_reals(arrays, "f", "k_mu", 0), (std::vector<double>{2e5F, 1e5F}));
  EXPECT_EQ(npz_reals(arrays, "f", "k_lambda", 0), (std::vector<double>{2e5F, 1e5F}));
  double density = 0;
  std::memcpy(&density, arrays.at("density").bytes.data(), sizeof density);
  EXPECT_NEAR(density, 600, 1e-9);
}

TEST_F(CalibratedFiles, vtk_vtu_and_json_have_the_scales) {
  expect_all(mesh_of("a.vtk", two_scales()),
             {"CELL_DATA 2\nSCALARS stiffness_scale float 1\nLOOKUP_TABLE default\n0.5\n0.25\n",
              "SCALARS density_scale float 1\nLOOKUP_TABLE default\n1\n0.5\n"});
  expect_all(mesh_of("a.vtu", two_scales()),
             {"<CellData>", "type=\"Float32\" Name=\"stiffness_scale\"", "type=\"Float32\" Name=\"density_scale\""});
  const auto json = nlohmann::json::parse(mesh_of("a.json", two_scales()));
  EXPECT_EQ(json.at("stiffness_scale"), nlohmann::json({0.5, 0.25}));
  EXPECT_EQ(json.at("density_scale"), nlohmann::json({1, 0.5}));
  EXPECT_EQ(json.at("stiffness_factor"), 0.375);
  EXPECT_EQ(json.at("regions")[0].at("young"), 1e6);
  for (const char* name : {"b.vtk", "b.vtu", "b.json"}) {
    TetModel plain = two_scales();
    plain.stiffness_scale.clear();
    plain.density_scale.clear();
    EXPECT_EQ(mesh_of(name, plain).find("_scale"), std::string::npos) << name;
  }
}

TEST_F(CalibratedFiles, decks_hold_a_material_for_each_step) {
  const std::string inp = mesh_of("a.inp", two_scales());
  expect_all(inp, {"** Calibrated", "*ELASTIC\n250000, 0.25\n*DENSITY\n450\n", "*ELASTIC\n5e+05, 0.25\n*DENSITY\n900\n",
                   "*ELSET, ELSET=EALL\nall_1\nall_8\n"});
  expect_all(mesh_of("a.veg", two_scales()), {"ENU, 450, 250000, 0.25\n", "ENU, 900, 5e+05, 0.25\n"});
}

TEST_F(CalibratedFiles, eight_steps_are_enough_however_far_apart_moduli_are) {
  // Half of the tets within a tenth of 1, the others up to 400 apart: even steps of the logarithm would put the former
  // into one.
  const TetModel model = block_with([](std::size_t t, std::size_t count) {
    const double at = double(t) / double(count);
    return at < 0.5 ? 0.95 + 0.2 * at : std::pow(400.0, 2 * at - 1.5);
  });
  const TetModel stepped = in_stiffness_steps(model);
  EXPECT_EQ(stepped.regions.size(), 8U);
  EXPECT_TRUE(stepped.stiffness_scale.empty());
  double mean = 0, most = 0;
  for (std::size_t t = 0; t < model.mesh.tets.size(); ++t) {
    const double young = stepped.regions[stepped.tet_regions[t]].material.young / model.regions[0].material.young;
    const double off = std::log(young / model.stiffness_scale[t]);
    mean += off / double(model.mesh.tets.size());
    most = std::max(most, std::abs(off));
  }
  EXPECT_NEAR(mean, 0, 1e-3);             // means are by volume, and tets of two sizes
  EXPECT_LT(most, std::log(400.0) / 14);  // half of an even step of seven, as if the flat half took one
}

TEST_F(CalibratedFiles, steps_keep_regions_and_the_mass_of_each) {
  TetModel model = block_of_regions(4);
  model.regions[1].material.density = 3000;
  for (std::size_t t = 0; t < model.mesh.tets.size(); ++t) {
    model.stiffness_scale.push_back(t % 3 == 0 ? 0.2F : 0.7F);
    model.density_scale.push_back(t % 2 == 0 ? 0.5F : 1.5F);
  }
  const TetModel stepped = in_stiffness_steps(model);
  ASSERT_EQ(stepped.regions.size(), 4U);
  EXPECT_EQ(stepped.regions[0].name, "lower_1");
  EXPECT_EQ(stepped.regions[3].name, "upper_8");
  EXPECT_NEAR(stepped.regions[3].material.young, 0.7 * model.regions[1].material.young, 1);
  double mass = 0, wanted = 0;
  for (std::size_t t = 0; t < model.mesh.tets.size(); ++t) {
    const double volume = signed_volume(corners_of(model.mesh, model.mesh.tets[t]));
    mass += volume * stepped.regions[stepped.tet_regions[t]].material.density;
    wanted += volume * model.density_scale[t] * model.regions[model.tet_regions[t]].material.density;
  }
  EXPECT_NEAR(mass, wanted, 1e-9 * wanted);
}

TEST_F(CalibratedFiles, scenes_with_one_material_take_the_one_factor_and_say_so) {
  const char* said = "calibrated: 0.375 times that of the body they stand for, 1e+06 Pa";
  expect_all(text_of("mujoco", two_scales()), {"young=\"3.75e+05\"", "mass=\"300\"", said});
  expect_all(text_of("bullet", two_scales()), {"MASS = 300 ", "Young's modulus of 3.75e+05 Pa", said});
  expect_all(text_of("drake", two_scales()), {"YOUNG = 3.75e+05 ", "set_mass_density(600)", said});
  expect_all(text_of("usd", two_scales()),
             {"float physics:youngsModulus = 375000", "float physics:density = 600", "calibrated"});
  EXPECT_EQ(bytes_of(folder_ / "body.vtk").find("_scale"), std::string::npos);  // Drake's, with the one factor
  // A material that nobody chose is made stiff enough by the scene, and that is what the factor is of.
  const std::string text = text_of("drake", two_scales(), true);
  std::smatch young, of;
  ASSERT_TRUE(std::regex_search(text, young, std::regex("YOUNG = ([0-9.e+]+)")));
  ASSERT_TRUE(std::regex_search(text, of, std::regex("stand for, ([0-9.e+]+) Pa")));
  EXPECT_NEAR(std::stod(young[1]) / std::stod(of[1]), 0.375, 0.001);
}

TEST_F(CalibratedFiles, scenes_with_a_modulus_a_tet_list_them) {
  expect_all(text_of("sofa", two_scales()), {"YOUNG = [5e+05, 2.5e+05] ", "totalMass=300,", "a factor for every tet"});
  // The file's moduli have the factors already: the scene multiplies by none.
  expect_all(text_of("newton", two_scales()), {"STIFFENING = 1 ", "a factor for every tet"});
  const std::string plain = [&] {
    TetModel model = two_scales();
    model.stiffness_scale.clear();
    model.density_scale = {};
    model.stiffness_factor = 1;
    return text_of("newton", model, true);
  }();
  std::smatch without, with;
  const std::string text = text_of("newton", two_scales(), true);
  ASSERT_TRUE(std::regex_search(plain, without, std::regex("STIFFENING = ([0-9.e+]+)")));
  ASSERT_TRUE(std::regex_search(text, with, std::regex("STIFFENING = ([0-9.e+]+)")));
  EXPECT_NEAR(std::stod(with[1]) / std::stod(without[1]), 2.0 / 3, 0.001);  // as its weight, which it is a hundred of
}

TEST_F(CalibratedFiles, every_engine_and_format_says_what_it_holds) {
  EXPECT_EQ(calibration_of(find_engine("newton")), CalibrationForm::PerTet);
  EXPECT_EQ(calibration_of(find_engine("sofa")), CalibrationForm::PerTet);
  EXPECT_EQ(calibration_of(find_engine("godot")), CalibrationForm::PerTet);
  EXPECT_EQ(calibration_of(find_engine("calculix")), CalibrationForm::Steps);
  EXPECT_EQ(calibration_of(find_engine("vega")), CalibrationForm::Steps);
  for (const char* name : {"mujoco", "bullet", "drake", "isaac", "usd"})
    EXPECT_EQ(calibration_of(find_engine(name)), CalibrationForm::OneFactor) << name;
  EXPECT_EQ(calibration_of(find_engine("libuipc")), CalibrationForm::None);
  EXPECT_EQ(calibration_of(TetFormat::Vtk), CalibrationForm::PerTet);
}

TEST_F(CalibratedFiles, scales_that_do_not_fit_are_refused) {
  TetModel model = two_scales();
  model.stiffness_scale.pop_back();
  EXPECT_THROW(mesh_of("a.vtk", model), InvalidInput);
  model = two_scales();
  model.density_scale[1] = 0;
  EXPECT_THROW(mesh_of("a.vtk", model), InvalidInput);
  model.density_scale[1] = std::nanf("");
  EXPECT_THROW(text_of("newton", model), InvalidInput);
}

}  // namespace tetsoup
