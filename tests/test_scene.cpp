// Scenes from their words to what plays.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <fstream>

#include "base/vec.h"
#include "tetsoup/error.h"
#include "tetsoup/io.h"
#include "tetsoup/samples.h"
#include "tetsoup/scene.h"

namespace tetsoup {
namespace {

Scene parse(const std::string& text) {
  return parse_scene(text, {}, "my.json");
}

/// What is said of a text that is no scene; empty if it is one.
std::string complaint(const std::string& text) {
  try {
    parse(text);
  } catch (const IoError& error) {
    return error.what();
  }
  return {};
}

/// A scene of one small box with something added to it.
std::string box_with(const std::string& more) {
  return R"({"bodies": [{"box": [0.2, 0.2, 0.2], "mesh": {"cells": 2, "voxels": 16})" + more + "}]}";
}

LoadedScene load(const std::string& text) {
  return load_scene(parse(text));
}

Vec3d centre_of(const LoadedScene& loaded, std::size_t body) {
  Vec3d sum;
  for (const Vec3& p : loaded.simulation.positions(body)) sum += to_double(p);
  return sum * (1 / static_cast<double>(loaded.simulation.positions(body).size()));
}

TEST(Scene, what_is_left_out_is_as_the_library_has_it) {
  const Scene scene = parse(R"({"bodies": [{"sample": "torus"}]})");
  const SceneBody& body = scene.bodies.at(0);
  const SimMaterial material;
  EXPECT_EQ(body.mesh, MeshOptions{});
  EXPECT_EQ(body.material.elastic.young, material.elastic.young);
  EXPECT_EQ(body.material.damping_time, material.damping_time);
  EXPECT_EQ(scene.simulation.substeps, SimulationOptions{}.substeps);
  EXPECT_EQ(scene.simulation.gravity, SimulationOptions{}.gravity);
  EXPECT_EQ(body.place, ScenePlace{});
}

TEST(Scene, every_value_arrives_where_it_belongs) {
  const Scene scene =
      parse(R"({"title": "t", "seconds": 1.5, "fps": 30, "gravity": [0, -9.81, 0], "solver": "potentials",
    "substeps": 7, "contact_interval": 3, "contacts": "between", "potentials": {"area": 2},
    "bodies": [{"name": "b", "file": "x.obj", "metres_per_unit": 0.001, "origin": "bottom",
      "mesh": {"tets": 1e3, "min_angle": 10, "rotate": [90, 0, 0], "lattice": "bcc", "rays": 13, "separate": "off"},
      "material": {"density": 900, "young": 1e6, "poisson": 0.45, "damping_time": 0.01, "friction": 0.7},
      "place": {"translate": [1, 2, 3], "rotate": [10, 20, 30], "velocity": [4, 5, 6], "spin": [7, 8, 9], "scale": 2},
      "instances": [{"translate": [0, 0, 0]}, {"rotate": [0, 0, 0]}],
      "pins": [{"axis": "y", "above": 0.5, "below": 0.7, "release": 2}, {"box": [[0, 0, 0], [1, 1, 1]]}],
      "springs": [{"at": [1, 1, 1], "to": [2, 2, 2], "stiffness": 5}], "surface": "fine.obj"}],
    "obstacles": [{"plane": {"normal": [0, 1, 0], "offset": -1}, "friction": 0.9},
                  {"sample": "tree", "seed": 3, "damage": 0.5, "size": 4, "voxels": 32, "place": {"scale": 3}}]})");
  EXPECT_EQ(scene.seconds, 1.5);
  EXPECT_EQ(frame_count(scene), 45U);
  EXPECT_EQ(scene.simulation.solver, Solver::Potentials);
  EXPECT_EQ(scene.simulation.contacts, Contacts::Between);
  EXPECT_EQ(scene.simulation.potentials.area, 2);
  const SceneBody& body = scene.bodies.at(0);
  EXPECT_EQ(body.mesh.lattice.tets, 1000U);
  EXPECT_EQ(body.mesh.lattice.kind, LatticeKind::Bcc);
  EXPECT_EQ(body.mesh.lattice.separate, Separate::Together);
  EXPECT_EQ(body.mesh.pseudo_volume.rays, 13);
  EXPECT_DOUBLE_EQ(body.mesh.lattice.rotate.x, std::numbers::pi / 2);
  EXPECT_DOUBLE_EQ(body.mesh.smooth.min_dihedral, std::numbers::pi / 18);
  EXPECT_EQ(body.material.elastic.poisson, 0.45);
  ASSERT_EQ(body.instances.size(), 2U);
  EXPECT_EQ(body.instances[0].translate, Vec3d{});
  EXPECT_EQ(body.instances[0].rotate, (Vec3d{10, 20, 30}));  // from the body's place
  EXPECT_EQ(body.instances[1].translate, (Vec3d{1, 2, 3}));
  EXPECT_EQ(body.pins.at(0).axis, 1);
  EXPECT_EQ(body.pins.at(1).box->hi, (Vec3d{1, 1, 1}));
  EXPECT_EQ(body.springs.at(0).stiffness, 5);
  EXPECT_EQ(body.surface_file, "fine.obj");
  EXPECT_EQ(scene.obstacles.at(0).plane->offset, -1);
  EXPECT_EQ(scene.obstacles.at(1).source.seed, 3U);
}

TEST(Scene, what_is_wrong_is_named_by_its_path) {
  const std::vector<std::array<std::string, 3>> wrong{
      {R"({"bodies": [{"box": [1, 1, 1]}, {"sample": "torus", "material": {"poisson": 0.7}}]})",
       "my.json: bodies[1].material.poisson: 0.7 is out of range", "0 to 0.4999"},
      {box_with(R"(, "material": {"yung": 1})"), "bodies[0].material.\"yung\"", "young"},
      {box_with(R"(, "material": [])"), "bodies[0].material: [] is not an object", ""},
      {box_with(R"(, "material": {"young": "soft"})"), "bodies[0].material.young: \"soft\" is not a number", "Pa"},
      {box_with(R"(, "place": {"translate": [1, 2]})"), "bodies[0].place.translate: [1,2] is not three numbers", ""},
      {box_with(R"(, "place": {"translate": [1, 2, "x"]})"), "bodies[0].place.translate[2]", "number"},
      {box_with(R"(, "place": {"translate": [1, 2, 1e6]})"), "bodies[0].place.translate[2]: 1e+06", "1e5 m"},
      {box_with(R"(, "material": {"young": 5e-324})"), "bodies[0].material.young: 4.94", "out of range"},
      {box_with(R"(, "material": {"density": 1e-310})"), "bodies[0].material.density: 1e-310", "out of range"},
      {box_with(R"(, "origin": "top")"), "bodies[0].origin: \"top\" is not one of own, centre, bottom", ""},
      {box_with(R"(, "instances": [])"), "bodies[0].instances", "no instance"},
      {box_with(R"(, "instances": {"count": [100, 100, 100]})"), "bodies[0].instances: 1e+06 are too many", ""},
      {box_with(R"(, "instances": {"count": [1.5, 1, 1]})"), "bodies[0].instances.count[0]: 1.5 is not whole", ""},
      {box_with(R"(, "pins": [{}])"), "bodies[0].pins[0]", "axis"},
      {box_with(R"(, "pins": [{"axis": "x"}])"), "bodies[0].pins[0]", "below"},
      {box_with(R"(, "pins": [{"box": [[1, 0, 0], [0, 1, 1]]}])"), "bodies[0].pins[0].box", "corner"},
      {box_with(R"(, "surface": 1)"), "bodies[0].surface: 1 is not true, false", ""},
      {box_with(R"(, "size": 2)"), "bodies[0].size", "box"},
      {R"({"bodies": [{"sample": "cow"}]})", "bodies[0].sample", "torus"},
      {R"({"bodies": [{"sample": "torus", "size": 1, "metres_per_unit": 1}]})", "bodies[0]: \"size\" and", "only one"},
      {R"({"bodies": [{"sample": "torus", "file": "x.obj"}]})", "bodies[0]: \"sample\" and \"file\"", "only one"},
      {R"({"bodies": [{"sample": "torus", "mesh": {"tets": 9, "cells": 2}}]})", "bodies[0].mesh: \"tets\" and", ""},
      {R"({"bodies": [{"tets_file": "x.msh", "mesh": {"tets": 9}}]})", "bodies[0].mesh", "leave this out"},
      {R"({"bodies": [{}]})", "bodies[0]: it has no shape", "sample"},
      {R"({"bodies": []})", "bodies: there is none", ""},
      {R"({})", "bodies: there is none", ""},
      {R"([])", "the scene: [] is not an object", ""},
      {R"({"fps": 0.5, "bodies": [{"box": [1, 1, 1]}]})", "fps: 0.5 is out of range", "1 to 1000"},
      {R"({"seconds": 3600, "fps": 1000, "bodies": [{"box": [1, 1, 1]}]})", "seconds", "1e6 frames"},
      {R"({"bodies": [{"box": [1, 1, 1]}], "obstacles": [{"plane": {"normal": [0, 0, 0]}}]})",
       "obstacles[0].plane.normal", "length"},
      {R"({"bodies": [{"box": [1, 1, 1]}], "obstacles": [{"plane": {}, "box": [1, 1, 1]}]})", "obstacles[0]", "plane"},
      {R"({"bodies": [{"box": [1, 1, 1]}], "obstacles": [{"box": [1, 1, 1], "place": {"velocity": [1, 0, 0]}}]})",
       "obstacles[0].place", "not move"},
      {R"({"bodies": [{"box": [1, 1, 1]}], "obstacles": [{"tets_file": "x.msh"}]})", "obstacles[0].\"tets_file\"", ""},
      {"{\"fps\": 30, \"fps\": 30}", "\"fps\": this key is given twice", ""},
      {"{\n  \"fps\": 30,\n  \"seconds\" 3\n}", "my.json: line 3, column 13", "not JSON"},
      {"", "my.json: line 1, column 1", "not JSON"},
      {"{\"fps\": 1e999}", "my.json: the scene: a number is too large", ""},
      {std::string(100, '['), "my.json: the scene: brackets", "deep"},
  };
  for (const auto& [text, where, what] : wrong) {
    const std::string said = complaint(text);
    EXPECT_NE(said.find(where), std::string::npos) << text << "\n" << said;
    EXPECT_NE(said.find(what), std::string::npos) << text << "\n" << said;
    EXPECT_TRUE(said.starts_with("my.json: ")) << said;
  }
}

TEST(Scene, a_number_below_the_normal_ones_is_out_of_range_in_a_part_that_stands_alone_too) {
  for (const char* number : {"5e-324", "1e-310", "-2e-308"}) {
    try {
      parse_material(std::string(R"({"young": )") + number + "}");
      ADD_FAILURE() << number;
    } catch (const InvalidInput& error) {
      EXPECT_NE(std::string(error.what()).find("young"), std::string::npos) << error.what();
    }
  }
}

TEST(Scene, the_scenes_of_the_tool_are_read_back_from_their_texts) {
  EXPECT_EQ(scene_names().size(), 6U);
  for (const std::string& name : scene_names()) {
    const Scene scene = make_scene(name);
    check_scene(scene);
    EXPECT_FALSE(scene_summary(name).empty());
    const std::string text = scene_text(scene);
    EXPECT_EQ(scene_text(parse(text)), text);
  }
  EXPECT_THROW(make_scene("hop"), InvalidInput);
}

TEST(Scene, a_scene_made_in_code_is_checked_too) {
  Scene scene = make_scene("drop");
  scene.bodies[0].material.elastic.poisson = std::nan("");
  try {
    check_scene(scene);
    FAIL();
  } catch (const InvalidInput& error) {
    EXPECT_STREQ(error.what(), "bodies[0].material.poisson: this is out of range; give 0 to 0.4999");
  }
}

TEST(Scene, instances_share_one_mesh_and_stand_where_they_should) {
  const LoadedScene loaded = load(R"({"bodies": [
    {"box": [0.2, 0.2, 0.2], "mesh": {"cells": 2, "voxels": 16}, "place": {"translate": [0, 0, 5]},
     "instances": {"count": [2, 1, 3], "spacing": [1, 1, 2]}},
    {"box": [0.2, 0.2, 0.2], "mesh": {"cells": 2, "voxels": 16}, "material": {"young": 1e6}},
    {"box": [0.2, 0.2, 0.2], "mesh": {"cells": 1, "voxels": 16}, "surface": false}]})");
  EXPECT_EQ(loaded.assets.size(), 2U);
  ASSERT_EQ(loaded.bodies.size(), 8U);
  EXPECT_EQ(loaded.simulation.body_count(), 8U);
  EXPECT_LT(length(centre_of(loaded, 0) - Vec3d{-0.5, 0, 3}), 0.01);  // the lattice is not quite even
  EXPECT_LT(length(centre_of(loaded, 5) - centre_of(loaded, 0) - Vec3d{1, 0, 4}), 1e-5);
  EXPECT_EQ(loaded.bodies[1].name, "box_1");
  EXPECT_FALSE(loaded.surfaces[6].empty());
  EXPECT_TRUE(loaded.surfaces[7].empty());
}

TEST(Scene, sizes_are_metres_and_the_origin_is_what_it_says) {
  const LoadedScene loaded = load(R"({"bodies": [{"sample": "sphere", "size": 0.5, "origin": "bottom",
    "mesh": {"tets": 200, "voxels": 32}, "place": {"translate": [1, 0, 0.1]}}]})");
  Vec3d lo{1e9, 1e9, 1e9}, hi{-1e9, -1e9, -1e9};
  for (const Vec3& p : loaded.surfaces[0]) {
    lo = min(lo, to_double(p));
    hi = max(hi, to_double(p));
  }
  EXPECT_NEAR(hi.z - lo.z, 0.5, 0.01);
  EXPECT_NEAR(lo.z, 0.1, 1e-4);
  EXPECT_NEAR(lo.x + hi.x, 2, 1e-4);
}

TEST(Scene, surfaces_go_where_their_bodies_go) {
  LoadedScene loaded = load(R"({"bodies": [{"box": [0.2, 0.2, 0.2], "mesh": {"cells": 2, "voxels": 16}}]})");
  const Vec3 before = loaded.surfaces[0][0];
  for (int i = 0; i < 60; ++i) advance_frame(loaded);
  deform_surfaces(loaded);
  EXPECT_NEAR(loaded.surfaces[0][0].z - before.z, -9.81 / 2, 1e-3);
  EXPECT_EQ(loaded.frame, 60U);
}

TEST(Scene, pins_hold_and_move_and_let_go) {
  LoadedScene loaded = load(R"({"gravity": [0, 0, 0], "bodies": [{"box": [1, 0.2, 0.2],
    "mesh": {"cells": 5, "voxels": 20}, "place": {"rotate": [0, 0, 90]},
    "pins": [{"axis": "x", "below": -0.45},
             {"axis": "x", "above": 0.45, "velocity": [0.5, 0, 0], "until": 0.5, "release": 0.75}]}]})");
  // The body's own x is the scene's y.
  const auto reach = [&] {
    double far = -1;
    for (const Vec3& p : loaded.simulation.positions(0)) far = std::max(far, static_cast<double>(p.y));
    return far;
  };
  const double start = reach();
  for (int i = 0; i < 45; ++i) advance_frame(loaded);  // 0.75 s
  EXPECT_NEAR(reach() - start, 0.25, 1e-3);
  EXPECT_FALSE(loaded.moved.at(0).released);
  for (int i = 0; i < 15; ++i) advance_frame(loaded);
  EXPECT_TRUE(loaded.moved.at(0).released);
  EXPECT_LT(reach() - start, 0.2);
}

TEST(Scene, many_pins_are_read_and_moved_in_proportion) {
  const auto cost = [](std::size_t count) {
    const std::string pin = R"({"axis": "z", "below": 9, "velocity": [0.1, 0, 0]})";
    std::string pins = pin;
    for (std::size_t i = 1; i < count; ++i) pins += "," + pin;
    const std::string text = box_with(R"(, "surface": false, "pins": [)" + pins + "]");
    std::array<double, 2> least{1e9, 1e9};
    for (int i = 0; i < 3; ++i) {
      const std::clock_t begin = std::clock();
      LoadedScene loaded = load_scene(parse(text));
      const std::clock_t middle = std::clock();
      for (int frame = 0; frame < 2; ++frame) advance_frame(loaded);
      least[0] = std::min(least[0], static_cast<double>(middle - begin));
      least[1] = std::min(least[1], static_cast<double>(std::clock() - middle));
    }
    return least;
  };
  const auto few = cost(1500), many = cost(24000);
  EXPECT_LT(many[0], 48 * few[0]);  // each asking all others: 256
  EXPECT_LT(many[1], 48 * few[1]);
}

TEST(Scene, pins_of_one_body_are_moved_one_after_the_other) {
  LoadedScene loaded = load(box_with(
      R"(, "instances": [{}, {"translate": [2, 0, 0]}], "pins": [{"axis": "x", "below": -0.05, "velocity": [-1, 0, 0]},)"
      R"( {"axis": "x", "above": 0.05, "velocity": [1, 0, 0], "release": 0.01}, {"axis": "x", "above": 0.09, "velocity": [0, 1, 0]}])"));
  const std::vector<Vec3> first(loaded.simulation.positions(0).begin(), loaded.simulation.positions(0).end());
  advance_frame(loaded);
  for (std::size_t body = 0; body < 2; ++body)
    for (std::size_t v = 0; v < first.size(); ++v) {
      const Vec3d moved = to_double(loaded.simulation.positions(body)[v]) - to_double(first[v]) -
                          Vec3d{2 * static_cast<double>(body), 0, 0};
      if (first[v].x < -0.05F) {
        EXPECT_NEAR(moved.x, -1.0 / 60, 1e-6);
      }
      if (first[v].x > 0.09F) {
        EXPECT_NEAR(moved.y, 1.0 / 60, 1e-6);
      }
    }
}

TEST(Scene, a_pin_where_no_vertex_lies_is_an_error) {
  try {
    load(box_with(R"(, "pins": [{"axis": "z", "above": 3}])"));
    FAIL();
  } catch (const InvalidInput& error) {
    EXPECT_NE(std::string(error.what()).find("bodies[0].pins[0]: no vertex lies there"), std::string::npos)
        << error.what();
  }
}

TEST(Scene, a_spring_pulls) {
  LoadedScene loaded = load(R"({"gravity": [0, 0, 0], "bodies": [{"box": [0.2, 0.2, 0.2],
    "mesh": {"cells": 2, "voxels": 16}, "springs": [{"at": [0.1, 0, 0], "to": [1, 0, 0]}]}]})");
  for (int i = 0; i < 20; ++i) advance_frame(loaded);
  EXPECT_GT(centre_of(loaded, 0).x, 0.1);
}

TEST(Scene, obstacles_stop_what_falls) {
  LoadedScene loaded = load(R"({"bodies": [{"box": [0.2, 0.2, 0.2], "mesh": {"cells": 2, "voxels": 16},
      "instances": [{"translate": [0, 0, 0.7]}, {"translate": [3, 0, 0.3]}]}],
    "obstacles": [{"plane": {}}, {"box": [1, 1, 0.4], "voxels": 20, "place": {"translate": [0, 0, 0.2]}}]})");
  ASSERT_EQ(loaded.obstacles.size(), 1U);
  for (int i = 0; i < 90; ++i) advance_frame(loaded);
  EXPECT_NEAR(centre_of(loaded, 0).z, 0.5, 0.05);
  EXPECT_NEAR(centre_of(loaded, 1).z, 0.1, 0.02);
}

TEST(Scene, a_state_goes_on_to_the_bit_even_past_a_release) {
  const std::string text = box_with(R"(, "pins": [{"axis": "x", "below": -0.05},
    {"axis": "x", "above": 0.05, "spin": [90, 0, 0], "release": 0.1}])");
  LoadedScene whole = load(text);
  std::vector<std::vector<std::byte>> states;
  std::vector<std::uint64_t> hashes;
  for (int i = 0; i < 20; ++i) {
    states.push_back(save_scene_state(whole));
    advance_frame(whole);
    hashes.push_back(whole.simulation.state_hash());
  }
  for (const std::size_t from : {std::size_t{0}, std::size_t{5}, std::size_t{6}, std::size_t{7}, std::size_t{15}}) {
    LoadedScene part = load(text);
    restore_scene_state(part, states[from]);
    EXPECT_EQ(part.frame, from);
    for (std::size_t i = from; i < 20; ++i) {
      advance_frame(part);
      ASSERT_EQ(part.simulation.state_hash(), hashes[i]) << from << " " << i;
    }
  }
  EXPECT_THROW(restore_scene_state(whole, std::span(states[0]).first(5)), InvalidInput);
}

TEST(Scene, ready_tets_and_another_surface_come_from_files) {
  std::string pattern = (std::filesystem::temp_directory_path() / "tetsoup_scene_XXXXXX").string();
  ASSERT_NE(mkdtemp(pattern.data()), nullptr);
  const std::filesystem::path folder = pattern;
  TetMesh mesh;
  mesh.vertices = {{0, 0, 0}, {100, 0, 0}, {0, 100, 0}, {0, 0, 100}};
  mesh.tets = {{0, 1, 2, 3}};
  write_tets(folder / "one.msh", mesh);
  write_surface(folder / "skin.obj", mesh.vertices, std::array<Triangle, 1>{{{1, 2, 3}}});
  std::ofstream(folder / "scene.json") << R"({"bodies": [{"tets_file": "one.msh", "metres_per_unit": 0.01,
    "surface": "skin.obj"}]})";
  const LoadedScene loaded = load_scene(read_scene(folder / "scene.json"));
  EXPECT_EQ(loaded.simulation.report().tet_count, 1U);
  ASSERT_EQ(loaded.surfaces[0].size(), 3U);
  EXPECT_NEAR(loaded.surfaces[0][0].x, 1, 1e-6);
  std::ofstream(folder / "scene.json") << R"({"bodies": [{"file": "none.obj"}]})";
  try {
    load_scene(read_scene(folder / "scene.json"));
    FAIL();
  } catch (const IoError& error) {
    EXPECT_NE(std::string(error.what()).find("bodies[0]: "), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("none.obj"), std::string::npos);
  }
  std::filesystem::remove_all(folder);
  EXPECT_THROW(read_scene(folder / "scene.json"), IoError);
}

}  // namespace
}  // namespace tetsoup
