// Presets: what each engine gets, in metres, all files or none.
#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "tet_models.h"
#include "tetsoup/engines.h"

namespace tetsoup {

namespace fs = std::filesystem;

namespace {

using EngineFiles = FolderTest;

template <class Act>
std::string refusal_of(const Act& act) {
  try {
    act();
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "not refused";
}

}  // namespace

TEST(Engines, are_in_alphabetical_order_and_complete) {
  const std::vector<Engine>& all = engines();
  EXPECT_TRUE(std::is_sorted(all.begin(), all.end(), [](const Engine& a, const Engine& b) { return a.name < b.name; }));
  for (const Engine& engine : all) {
    SCOPED_TRACE(engine.name);
    EXPECT_FALSE(engine.title.empty());
    EXPECT_FALSE(engine.summary.empty());
    EXPECT_NE(engine.usage.find("{"), std::string::npos) << "names no file";
    EXPECT_EQ(engine.summary.find('\n') + engine.usage.find('\n'), 2 * std::string::npos);
    const auto info = std::find_if(tet_formats().begin(), tet_formats().end(),
                                   [&](const TetFormatInfo& i) { return i.format == engine.format; });
    ASSERT_NE(info, tet_formats().end());
    EXPECT_EQ(engine.extension, info->extension);
  }
}

TEST(Engines, are_found_by_all_their_names) {
  for (const char* name : {"mujoco", "newton",   "isaac",   "isaacgym", "usd",     "drake", "sofa",       "bullet",
                           "vega",   "calculix", "abaqus",  "netgen",   "libuipc", "dart",  "unity-json", "godot",
                           "jolt",   "threejs",  "blender", "paraview", "genesis", "gmsh",  "mmg",        "tetgen"})
    EXPECT_EQ(find_engine(name).name, name);
  EXPECT_EQ(find_engine("pybullet").name, "bullet");
  EXPECT_EQ(find_engine("ftetwild").name, "mmg");
}

TEST(Engines, an_unknown_one_is_answered_with_all_and_the_nearest) {
  const std::string text = refusal_of([] { find_engine("mojuco"); });
  EXPECT_NE(text.find("engine mojuco"), text.npos) << text;
  EXPECT_NE(text.find("did you mean mujoco?"), text.npos) << text;
  for (const Engine& engine : engines()) EXPECT_NE(text.find(engine.name), text.npos) << text;
  EXPECT_EQ(refusal_of([] { find_engine("flex"); }).find("did you mean"), std::string::npos);
}

TEST(Engines, files_are_named_by_a_stem_or_the_engines_own_extension) {
  const Engine& mujoco = find_engine("mujoco");
  EXPECT_EQ(engine_files(mujoco, "a/b").front(), "a/b.msh");
  EXPECT_EQ(engine_files(mujoco, "b.msh").front(), "b.msh");
  EXPECT_EQ(engine_files(mujoco, "b.MSH").front(), "b.MSH");
  const std::string text = refusal_of([&] { engine_files(mujoco, "b.vtk"); });
  EXPECT_NE(text.find("b.vtk"), text.npos) << text;
  EXPECT_NE(text.find(".msh"), text.npos) << text;
  EXPECT_EQ(engine_files(find_engine("tetgen"), "b"), (std::vector<fs::path>{"b.node", "b.ele", "b.face"}));
  EXPECT_EQ(engine_files(find_engine("vega"), "b"), (std::vector<fs::path>{"b.veg", "b.bou"}));
}

TEST(Engines, a_scene_stands_beside_the_mesh_and_is_named_in_the_usage) {
  Engine engine = find_engine("drake");
  engine.scene_extension = "_drake.py";
  engine.usage = "python3 {scene}, which loads {mesh} of {stem}, {mesh}";
  EXPECT_EQ(engine_files(engine, "x/b"), (std::vector<fs::path>{"x/b.vtk", "x/b_drake.py"}));
  EXPECT_EQ(engine_usage(engine, "x/b"), "python3 x/b_drake.py, which loads x/b.vtk of x/b, x/b.vtk");
}

TEST_F(EngineFiles, every_preset_writes_what_it_says) {
  const TetModel model = block_of_regions(2);
  for (const Engine& engine : engines()) {
    SCOPED_TRACE(engine.name);
    const fs::path stem = folder_ / ("of_" + engine.name);
    const std::vector<fs::path> written = write_for_engine(engine, stem, model);
    EXPECT_EQ(written, engine_files(engine, stem));
    for (const fs::path& path : written) EXPECT_GT(fs::file_size(path), 0U) << path;
  }
}

TEST_F(EngineFiles, are_in_metres) {
  TetModel model;
  model.mesh = two_tets();
  model.regions.front().material.metres_per_unit = 0.5;
  const TetMesh halved = read_tets(write_for_engine(find_engine("mujoco"), folder_ / "m", model).front());
  EXPECT_EQ(halved.vertices[4], (Vec3{0.5F, 0.5F, 0.5F}));
  write_for_engine(find_engine("calculix"), folder_ / "c", model);
  EXPECT_NE(bytes_of(folder_ / "c.inp").find("*ELASTIC\n1e+05, 0.4\n*DENSITY\n1000\n"), std::string::npos)
      << "units of the material are those of the metres";
  write_for_engine(find_engine("godot"), folder_ / "g", model);
  EXPECT_NE(bytes_of(folder_ / "g.json").find("\"metres_per_unit\": 1,"), std::string::npos);
}

TEST_F(EngineFiles, a_unit_that_is_none_is_refused) {
  TetModel model;
  model.mesh = two_tets();
  for (const double unit : {0.0, -1.0, std::numeric_limits<double>::infinity()}) {
    model.regions.front().material.metres_per_unit = unit;
    EXPECT_THROW(write_for_engine(find_engine("mujoco"), folder_ / "m", model), InvalidInput);
  }
  EXPECT_TRUE(files().empty());
}

TEST_F(EngineFiles, all_appear_or_none) {
  fs::create_directory(folder_ / "m.bou");
  EXPECT_THROW(write_for_engine(find_engine("vega"), folder_ / "m", two_regions()), IoError);
  EXPECT_EQ(files(), std::vector<std::string>{"m.bou"});
}

}  // namespace tetsoup
