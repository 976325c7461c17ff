// The C interface where callers are wrong or change their mind; tests/c/tour.c is what goes well.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <thread>

#include "io/number_text.h"
#include "tetsoup/io.h"
#include "tetsoup/samples.h"
#include "tetsoup/tetsoup.h"
#include "tetsoup/tetsoup_c.h"

namespace {

bool error_tells(const std::string& words) {
  return std::string(tetsoup_last_error()).find(words) != std::string::npos;
}

tetsoup_soup* sample(const char* name) {
  tetsoup_soup* soup = nullptr;
  EXPECT_EQ(tetsoup_soup_sample(name, 0, 1, &soup), TETSOUP_OK);
  return soup;
}

/// A sphere with its stages still to run.
class CPipeline : public ::testing::Test {
 protected:
  CPipeline() {
    tetsoup_soup* const soup = sample("sphere");
    EXPECT_EQ(tetsoup_pipeline_create(soup, nullptr, nullptr, &pipeline), TETSOUP_OK);
    tetsoup_soup_destroy(soup);
  }
  ~CPipeline() override { tetsoup_pipeline_destroy(pipeline); }

  tetsoup_status run(const char* options, tetsoup_progress progress = nullptr, void* context = nullptr) {
    return tetsoup_pipeline_run(pipeline, options, progress, context);
  }

  tetsoup_pipeline* pipeline = nullptr;
};

}  // namespace

TEST(CInterface, null_arguments_are_named_and_nothing_happens) {
  const char* json = nullptr;
  tetsoup_floats view{};
  EXPECT_EQ(tetsoup_soup_sample("torus", 0, 1, nullptr), TETSOUP_INVALID_INPUT);
  EXPECT_TRUE(error_tells("soup is NULL"));
  EXPECT_EQ(tetsoup_soup_vertices(nullptr, &view), TETSOUP_INVALID_INPUT);
  EXPECT_EQ(tetsoup_soup_report(nullptr, &json), TETSOUP_INVALID_INPUT);
  EXPECT_EQ(json, nullptr);
  tetsoup_soup* soup = nullptr;
  EXPECT_EQ(tetsoup_soup_sample(nullptr, 0, 1, &soup), TETSOUP_INVALID_INPUT);
  EXPECT_TRUE(error_tells("name is NULL"));
  EXPECT_EQ(tetsoup_soup_create(nullptr, 3, nullptr, 0, &soup), TETSOUP_INVALID_INPUT);
  EXPECT_TRUE(error_tells("vertices is NULL"));
  EXPECT_EQ(soup, nullptr);
  tetsoup_pipeline_destroy(nullptr);
  tetsoup_model_destroy(nullptr);
  tetsoup_simulation_destroy(nullptr);
}

TEST(CInterface, a_soup_is_told_by_its_bytes_and_refused_with_its_name) {
  const std::string off = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  tetsoup_soup* soup = nullptr;
  ASSERT_EQ(tetsoup_soup_parse(off.data(), off.size(), "named_wrongly.bin", &soup), TETSOUP_OK);
  tetsoup_indices triangles{};
  ASSERT_EQ(tetsoup_soup_triangles(soup, &triangles), TETSOUP_OK);
  EXPECT_EQ(triangles.count, 1U);
  tetsoup_soup_destroy(soup);

  const std::string wrong = "v 0 0 nonsense\n";
  EXPECT_EQ(tetsoup_soup_parse(wrong.data(), wrong.size(), "wrong.obj", &soup), TETSOUP_IO_ERROR);
  EXPECT_TRUE(error_tells("wrong.obj, line 1"));
  EXPECT_EQ(tetsoup_soup_parse(wrong.data(), wrong.size(), "wrong.foo", &soup), TETSOUP_IO_ERROR);
  EXPECT_TRUE(error_tells(".obj .stl"));
  EXPECT_EQ(tetsoup_soup_parse(wrong.data(), wrong.size(), "points.xyz", &soup), TETSOUP_IO_ERROR);
  EXPECT_TRUE(error_tells("points, not triangles"));
  EXPECT_EQ(tetsoup_soup_parse(nullptr, 0, "empty.obj", &soup), TETSOUP_IO_ERROR);
  EXPECT_TRUE(error_tells("empty.obj: is empty"));
}

TEST(CInterface, a_soup_of_nan_is_diagnosed_and_cannot_be_meshed) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float vertices[9] = {nan, nan, nan, nan, nan, nan, nan, nan, nan};
  const std::uint32_t triangles[6] = {0, 1, 2, 0, 1, 77};
  tetsoup_soup* soup = nullptr;
  tetsoup_pipeline* pipeline = nullptr;
  const char* json = nullptr;
  ASSERT_EQ(tetsoup_soup_create(vertices, 3, triangles, 2, &soup), TETSOUP_OK);
  ASSERT_EQ(tetsoup_soup_report(soup, &json), TETSOUP_OK);
  EXPECT_NE(std::string(json).find("\"class\":\"empty\""), std::string::npos);
  ASSERT_EQ(tetsoup_pipeline_create(soup, nullptr, nullptr, &pipeline), TETSOUP_OK);
  EXPECT_EQ(tetsoup_pipeline_run(pipeline, nullptr, nullptr, nullptr), TETSOUP_INVALID_INPUT);
  EXPECT_TRUE(error_tells("no finite triangle"));
  tetsoup_pipeline_destroy(pipeline);
  tetsoup_soup_destroy(soup);
}

TEST_F(CPipeline, options_that_are_wrong_are_named_by_their_key) {
  EXPECT_EQ(run("{\"voxels\": 0}"), TETSOUP_INVALID_INPUT);
  EXPECT_TRUE(error_tells("voxels")) << tetsoup_last_error();
  EXPECT_EQ(run("{\"voxel\": 64}"), TETSOUP_INVALID_INPUT);
  EXPECT_TRUE(error_tells("mesh.\"voxel\"") && error_tells("there is no such key")) << tetsoup_last_error();
  EXPECT_EQ(run("{\"rho_min\": \"half\"}"), TETSOUP_INVALID_INPUT);
  EXPECT_TRUE(error_tells("mesh.rho_min")) << tetsoup_last_error();
  EXPECT_EQ(run("{\"voxels\": 64"), TETSOUP_INVALID_INPUT);
  EXPECT_TRUE(error_tells("line 1")) << tetsoup_last_error();
  EXPECT_EQ(run("[]"), TETSOUP_INVALID_INPUT);
  EXPECT_EQ(tetsoup_pipeline_run_until(pipeline, static_cast<tetsoup_stage>(5), nullptr, nullptr, nullptr),
            TETSOUP_INVALID_INPUT);
  EXPECT_TRUE(error_tells("stage = 5"));
}

TEST_F(CPipeline, results_are_refused_until_their_stage_is_up_to_date) {
  tetsoup_floats view{};
  tetsoup_grid grid{};
  EXPECT_EQ(tetsoup_pipeline_grid(pipeline, &grid), TETSOUP_INVALID_INPUT);
  EXPECT_TRUE(error_tells("distance"));
  ASSERT_EQ(tetsoup_pipeline_run_until(pipeline, TETSOUP_STAGE_DISTANCE, "{\"voxels\": 24}", nullptr, nullptr),
            TETSOUP_OK);
  EXPECT_EQ(tetsoup_pipeline_grid(pipeline, &grid), TETSOUP_OK);
  EXPECT_EQ(tetsoup_pipeline_slice(pipeline, TETSOUP_FIELD_VOTES, 0, 0, &view), TETSOUP_INVALID_INPUT);
  EXPECT_EQ(tetsoup_pipeline_slice(pipeline, TETSOUP_FIELD_DISTANCE, 0, grid.size[0], &view), TETSOUP_INVALID_INPUT);
  EXPECT_TRUE(error_tells("layer"));
  EXPECT_EQ(tetsoup_pipeline_slice(pipeline, TETSOUP_FIELD_DISTANCE, 3, 0, &view), TETSOUP_INVALID_INPUT);
  EXPECT_EQ(tetsoup_pipeline_vertices(pipeline, TETSOUP_MESH_FINAL, &view), TETSOUP_INVALID_INPUT);
  EXPECT_TRUE(error_tells("smooth"));
  EXPECT_EQ(view.data, nullptr);
}

TEST_F(CPipeline, a_cancelled_run_keeps_the_stages_that_finished) {
  const auto stop_at_lattice = [](const char* stage, double, void*) {
    return std::strcmp(stage, "lattice") == 0 ? 0 : 1;
  };
  tetsoup_floats view{};
  const char* json = nullptr;
  EXPECT_EQ(run("{\"voxels\": 24, \"tets\": 300}", stop_at_lattice), TETSOUP_CANCELLED);
  EXPECT_STREQ(tetsoup_last_error(), "cancelled");
  EXPECT_EQ(tetsoup_pipeline_slice(pipeline, TETSOUP_FIELD_VOTES, 0, 5, &view), TETSOUP_OK);
  EXPECT_EQ(tetsoup_pipeline_vertices(pipeline, TETSOUP_MESH_LATTICE, &view), TETSOUP_INVALID_INPUT);
  EXPECT_EQ(tetsoup_pipeline_report(pipeline, nullptr, &json), TETSOUP_OK);
  EXPECT_EQ(std::string(json).find("lattice_quality"), std::string::npos) << json;
  EXPECT_EQ(run("{\"voxels\": 24, \"tets\": 300}"), TETSOUP_OK);
  EXPECT_EQ(tetsoup_pipeline_vertices(pipeline, TETSOUP_MESH_FINAL, &view), TETSOUP_OK);
}

TEST_F(CPipeline, a_run_that_ends_early_withdraws_what_no_longer_holds) {
  tetsoup_floats view{};
  ASSERT_EQ(run("{\"voxels\": 24, \"tets\": 300}"), TETSOUP_OK);
  ASSERT_EQ(tetsoup_pipeline_run_until(pipeline, TETSOUP_STAGE_PSEUDO_VOLUME, "{\"voxels\": 20}", nullptr, nullptr),
            TETSOUP_OK);
  EXPECT_EQ(tetsoup_pipeline_vertices(pipeline, TETSOUP_MESH_FINAL, &view), TETSOUP_INVALID_INPUT);
}

TEST_F(CPipeline, a_grid_beyond_the_memory_limit_is_refused_with_one_that_fits) {
  ASSERT_EQ(tetsoup_pipeline_set_memory_limit(pipeline, 1000000), TETSOUP_OK);
  EXPECT_EQ(run("{\"voxels\": 256}"), TETSOUP_INVALID_INPUT);
  EXPECT_TRUE(error_tells("must be at most"));
  ASSERT_EQ(tetsoup_pipeline_set_memory_limit(pipeline, 0), TETSOUP_OK);
  EXPECT_EQ(run("{\"voxels\": 64}"), TETSOUP_OK);
}

TEST_F(CPipeline, its_mesh_is_that_of_the_library) {
  ASSERT_EQ(run("{\"voxels\": 32, \"tets\": 400, \"min_angle\": 20}"), TETSOUP_OK);
  tetsoup::MeshOptions options;
  options.distance.voxels = 32;
  options.lattice.tets = 400;
  options.smooth.min_dihedral = 20 * (std::acos(-1.0) / 180);
  const tetsoup::TetMesh mesh = tetsoup::mesh_soup(tetsoup::make_sample("sphere"), options);
  tetsoup_floats vertices{};
  tetsoup_indices tets{};
  ASSERT_EQ(tetsoup_pipeline_vertices(pipeline, TETSOUP_MESH_FINAL, &vertices), TETSOUP_OK);
  ASSERT_EQ(tetsoup_pipeline_tets(pipeline, TETSOUP_MESH_FINAL, &tets), TETSOUP_OK);
  ASSERT_EQ(vertices.count, mesh.vertices.size());
  ASSERT_EQ(tets.count, mesh.tets.size());
  EXPECT_EQ(std::memcmp(vertices.data, mesh.vertices.data(), vertices.count * sizeof(tetsoup::Vec3)), 0);
  EXPECT_EQ(std::memcmp(tets.data, mesh.tets.data(), tets.count * sizeof(tetsoup::Tet)), 0);
}

TEST_F(CPipeline, models_refuse_what_they_do_not_know) {
  tetsoup_model* model = nullptr;
  const char* json = nullptr;
  EXPECT_EQ(tetsoup_model_create(pipeline, "ball", nullptr, nullptr, &model), TETSOUP_INVALID_INPUT);
  ASSERT_EQ(run("{\"voxels\": 24, \"tets\": 300}"), TETSOUP_OK);
  EXPECT_EQ(tetsoup_model_create(pipeline, "", nullptr, nullptr, &model), TETSOUP_INVALID_INPUT);
  ASSERT_EQ(tetsoup_model_create(pipeline, "ball", nullptr, nullptr, &model), TETSOUP_OK);
  EXPECT_EQ(tetsoup_model_write(model, "ball.msh", "nonsense", &json), TETSOUP_INVALID_INPUT);
  EXPECT_TRUE(error_tells("format = 'nonsense'"));
  EXPECT_EQ(tetsoup_model_write(model, "/no/such/folder/ball.msh", nullptr, &json), TETSOUP_IO_ERROR);
  EXPECT_TRUE(error_tells("/no/such/folder"));
  EXPECT_EQ(tetsoup_model_write_for_engine(model, "ball", "unreal", &json), TETSOUP_INVALID_INPUT);
  EXPECT_EQ(tetsoup_model_set_material(model, 1000, -1, 0.4, 1), TETSOUP_INVALID_INPUT);
  EXPECT_EQ(tetsoup_model_set_up(model, 3), TETSOUP_INVALID_INPUT);
  const float one[3] = {0, 0, 0};
  tetsoup_floats view{};
  EXPECT_EQ(tetsoup_model_deform(model, one, 1, &view, nullptr), TETSOUP_INVALID_INPUT);
  tetsoup_model_destroy(model);
}

TEST_F(CPipeline, models_are_calibrated_by_the_pipeline_they_are_of) {
  tetsoup_model* model = nullptr;
  const char* json = nullptr;
  ASSERT_EQ(run("{\"voxels\": 24, \"tets\": 300}"), TETSOUP_OK);
  ASSERT_EQ(tetsoup_model_create(pipeline, "ball", nullptr, nullptr, &model), TETSOUP_OK);
  EXPECT_EQ(tetsoup_model_calibrate(model, nullptr, nullptr, nullptr, &json), TETSOUP_INVALID_INPUT);
  const auto stop = [](const char*, double, void*) { return 0; };
  EXPECT_EQ(tetsoup_model_calibrate(model, pipeline, stop, nullptr, &json), TETSOUP_CANCELLED);
  ASSERT_EQ(tetsoup_model_calibrate(model, pipeline, nullptr, nullptr, &json), TETSOUP_OK);
  EXPECT_NE(std::strstr(json, "\"factor\""), nullptr);
  const std::string path = (std::filesystem::temp_directory_path() / "tetsoup_c_calibrated.json").string();
  ASSERT_EQ(tetsoup_model_write(model, path.c_str(), nullptr, &json), TETSOUP_OK);
  std::ifstream file(path);
  const std::string text((std::istreambuf_iterator<char>(file)), {});
  EXPECT_NE(text.find("\"stiffness_scale\": ["), std::string::npos);
  std::filesystem::remove(path);
  tetsoup_model_destroy(model);
}

TEST(CSimulation, what_is_out_of_range_is_named) {
  tetsoup_simulation* simulation = nullptr;
  EXPECT_EQ(tetsoup_simulation_create("{\"substeps\": 0}", &simulation), TETSOUP_INVALID_INPUT);
  EXPECT_TRUE(error_tells("simulation.substeps"));
  ASSERT_EQ(tetsoup_simulation_create(nullptr, &simulation), TETSOUP_OK);
  const float corners[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  const std::uint32_t tet[4] = {0, 1, 2, 3};
  std::size_t body = 0, spring = 0;
  tetsoup_floats view{};
  EXPECT_EQ(tetsoup_simulation_add_mesh(simulation, corners, 4, tet, 1, "{\"poisson\": 1}", nullptr, &body),
            TETSOUP_INVALID_INPUT);
  EXPECT_TRUE(error_tells("material.poisson"));
  EXPECT_EQ(tetsoup_simulation_add_mesh(simulation, corners, 4, tet, 1, nullptr, "{\"scale\": 0}", &body),
            TETSOUP_INVALID_INPUT);
  EXPECT_TRUE(error_tells("place.scale"));
  ASSERT_EQ(tetsoup_simulation_add_mesh(simulation, corners, 4, tet, 1, nullptr, nullptr, &body), TETSOUP_OK);
  EXPECT_EQ(tetsoup_simulation_positions(simulation, 1, &view), TETSOUP_INVALID_INPUT);
  EXPECT_EQ(tetsoup_simulation_surface(simulation, 1, &view, nullptr), TETSOUP_INVALID_INPUT);
  EXPECT_EQ(tetsoup_simulation_pin(simulation, 0, 4), TETSOUP_INVALID_INPUT);
  EXPECT_EQ(tetsoup_simulation_add_spring(simulation, 0, 0, nullptr, 1, &spring), TETSOUP_INVALID_INPUT);
  EXPECT_EQ(tetsoup_simulation_step(simulation, 2), TETSOUP_INVALID_INPUT);
  EXPECT_EQ(tetsoup_scene_advance(simulation), TETSOUP_INVALID_INPUT);
  EXPECT_EQ(tetsoup_scene_seek(simulation, 3), TETSOUP_INVALID_INPUT);
  EXPECT_TRUE(error_tells("not of a scene"));
  tetsoup_simulation_destroy(simulation);
}

TEST(CSimulation, a_scene_loaded_anew_goes_on_at_the_time_of_the_old_one) {
  const char* const text =
      R"({"gravity": [0, 0, 0], "fps": 60, "bodies": [{"box": [0.2, 0.2, 0.2], "mesh": {"cells": 2, "voxels": 16},)"
      R"( "surface": false, "pins": [{"axis": "x", "below": 9, "velocity": [6, 0, 0], "release": 0.4}]}]})";
  const auto load = [&] {
    tetsoup_simulation* scene = nullptr;
    EXPECT_EQ(tetsoup_scene_load(text, nullptr, nullptr, nullptr, &scene), TETSOUP_OK);
    return scene;
  };
  const auto x_of = [](tetsoup_simulation* scene) {
    tetsoup_floats at{};
    EXPECT_EQ(tetsoup_simulation_positions(scene, 0, &at), TETSOUP_OK);
    return at.data[0];
  };
  tetsoup_simulation *played = load(), *anew = load();
  for (int i = 0; i < 10; ++i) EXPECT_EQ(tetsoup_scene_advance(played), TETSOUP_OK);
  EXPECT_EQ(tetsoup_scene_seek(anew, 9), TETSOUP_OK);
  EXPECT_EQ(tetsoup_scene_advance(anew), TETSOUP_OK);
  EXPECT_FLOAT_EQ(x_of(anew), x_of(played));
  EXPECT_EQ(tetsoup_scene_seek(anew, 30), TETSOUP_OK);  // let go: nothing moves it any more
  EXPECT_EQ(tetsoup_scene_advance(anew), TETSOUP_OK);
  EXPECT_NEAR(x_of(anew), x_of(played), 1e-3);
  tetsoup_simulation_destroy(anew);
  tetsoup_simulation_destroy(played);
}

TEST(CSimulation, a_scene_that_is_wrong_or_cancelled_gives_no_handle) {
  tetsoup_simulation* scene = nullptr;
  EXPECT_EQ(tetsoup_scene_load("{\"bodies\": [{\"sample\": \"spher\"}]}", nullptr, nullptr, nullptr, &scene),
            TETSOUP_IO_ERROR);
  EXPECT_TRUE(error_tells("bodies[0]")) << tetsoup_last_error();
  const auto stop = [](const char*, double, void*) { return 0; };
  EXPECT_EQ(tetsoup_scene_load("{\"bodies\": [{\"sample\": \"sphere\"}]}", nullptr, stop, nullptr, &scene),
            TETSOUP_CANCELLED);
  EXPECT_EQ(scene, nullptr);
  const char* json = nullptr;
  EXPECT_EQ(tetsoup_scene_text("robots", &json), TETSOUP_INVALID_INPUT);
}

TEST(CInterface, every_thread_has_an_error_of_its_own) {
  tetsoup_soup* soup = nullptr;
  EXPECT_EQ(tetsoup_soup_sample("cube", 0, 1, &soup), TETSOUP_INVALID_INPUT);
  std::thread([] { EXPECT_STREQ(tetsoup_last_error(), ""); }).join();
  EXPECT_TRUE(error_tells("cube"));
}

TEST(NumberText, without_the_standard_librarys_help_numbers_have_the_same_characters) {
  std::uint64_t state = 1;
  for (int i = 0; i < 20000; ++i) {
    state = state * 6364136223846793005U + 1442695040888963407U;
    const double magnitude = std::pow(10.0, static_cast<double>(state >> 33 & 63U) - 32);
    const double value = (static_cast<double>(state >> 11) * 0x1p-53 - 0.5) * magnitude;
    const double rounded = i % 2 == 0 ? value : std::round(value * 1000) / 1000;
    std::string by_library, slowly;
    tetsoup::append_number(by_library, rounded);
    tetsoup::append_number_slowly(slowly, rounded);
    ASSERT_EQ(by_library, slowly);
    tetsoup::append_float(by_library, static_cast<float>(rounded));
    tetsoup::append_float_slowly(slowly, static_cast<float>(rounded));
    ASSERT_EQ(by_library, slowly);
  }
}
