/* All of the C interface, as a C program sees it: from a sample to a mesh, its surface, files, a falling body, a scene.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tetsoup/tetsoup.h"

#define CHECK(condition)                                                                          \
  do {                                                                                            \
    if (!(condition)) {                                                                           \
      fprintf(stderr, "%s:%d: %s\n  %s\n", __FILE__, __LINE__, #condition, tetsoup_last_error()); \
      exit(1);                                                                                    \
    }                                                                                             \
  } while (0)
#define OK(call) CHECK((call) == TETSOUP_OK)

static int count_calls(const char* stage, double fraction, void* context) {
  CHECK(stage[0] != '\0' && fraction >= 0 && fraction <= 1);
  ++*(int*)context;
  return 1;
}

static tetsoup_soup* tour_soup(void) {
  static const char obj[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\n";
  const float corners[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const uint32_t triangle[3] = {0, 1, 2};
  tetsoup_soup* soup = NULL;
  tetsoup_floats vertices;
  tetsoup_indices triangles;
  const char* json = NULL;
  OK(tetsoup_soup_create(corners, 3, triangle, 1, &soup));
  tetsoup_soup_destroy(soup);
  OK(tetsoup_soup_parse(obj, strlen(obj), "two.obj", &soup));
  OK(tetsoup_soup_vertices(soup, &vertices));
  OK(tetsoup_soup_triangles(soup, &triangles));
  CHECK(vertices.count == 4 && vertices.width == 3 && triangles.count == 2 && triangles.data[5] == 3);
  tetsoup_soup_destroy(soup);
  OK(tetsoup_sample_list(&json));
  CHECK(strstr(json, "\"torus\"") != NULL);
  OK(tetsoup_soup_sample("torus", 0, 1, &soup));
  OK(tetsoup_soup_report(soup, &json));
  CHECK(strstr(json, "\"class\":\"closed\"") != NULL);
  return soup;
}

static void tour_fields(tetsoup_pipeline* pipeline) {
  tetsoup_grid grid;
  tetsoup_floats slice;
  float most = 0;
  size_t i;
  OK(tetsoup_pipeline_grid(pipeline, &grid));
  CHECK(grid.rays == 26 && grid.size[0] == 48 + 2 * grid.pad && grid.band > 0);
  OK(tetsoup_pipeline_slice(pipeline, TETSOUP_FIELD_VOTES, 2, grid.size[2] / 2, &slice));
  CHECK(slice.width == (size_t)grid.size[0] && slice.count == (size_t)grid.size[1]);
  for (i = 0; i < slice.count * slice.width; ++i) most = slice.data[i] > most ? slice.data[i] : most;
  CHECK(most == 26);
  OK(tetsoup_pipeline_slice(pipeline, TETSOUP_FIELD_DISTANCE, 0, 0, &slice));
  CHECK(slice.width == (size_t)grid.size[1] && slice.count == (size_t)grid.size[2]);
  OK(tetsoup_pipeline_slice(pipeline, TETSOUP_FIELD_INSIDE, 1, grid.size[1] - 1, &slice));
  CHECK(slice.data[0] == 0);
}

static void tour_search(tetsoup_pipeline* pipeline) {
  tetsoup_indices found;
  size_t count = 0;
  int32_t held = -1;
  OK(tetsoup_pipeline_find_tets(pipeline, "{\"voxels\": 48}", NULL, NULL, &count, &held));
  OK(tetsoup_pipeline_tets(pipeline, TETSOUP_MESH_FINAL, &found));
  CHECK(held == 1 && count >= 500 && found.count > count * 9 / 10 && found.count < count * 11 / 10);
  CHECK(tetsoup_pipeline_find_tets(pipeline, "{\"cells\": 4}", NULL, NULL, NULL, NULL) == TETSOUP_INVALID_INPUT);
}

static void tour_mesh(tetsoup_pipeline* pipeline) {
  tetsoup_floats vertices, quality;
  tetsoup_indices tets, boundary, cavities;
  const char* json = NULL;
  OK(tetsoup_pipeline_vertices(pipeline, TETSOUP_MESH_LATTICE, &vertices));
  OK(tetsoup_pipeline_vertices(pipeline, TETSOUP_MESH_FINAL, &vertices));
  OK(tetsoup_pipeline_tets(pipeline, TETSOUP_MESH_FINAL, &tets));
  OK(tetsoup_pipeline_boundary(pipeline, TETSOUP_MESH_FINAL, &boundary));
  OK(tetsoup_pipeline_cavities(pipeline, TETSOUP_MESH_FINAL, &cavities));
  CHECK(cavities.count == 0);
  CHECK(tets.width == 4 && tets.count > 400 && boundary.width == 3 && boundary.count > 100);
  OK(tetsoup_pipeline_tet_quality(pipeline, TETSOUP_MESH_FINAL, TETSOUP_MEAN_RATIO, &quality));
  CHECK(quality.count == tets.count && quality.data[0] > 0 && quality.data[0] <= 1);
  OK(tetsoup_pipeline_tet_quality(pipeline, TETSOUP_MESH_FINAL, TETSOUP_MIN_DIHEDRAL, &quality));
  CHECK(quality.data[0] > 20 && quality.data[0] < 71);
  OK(tetsoup_pipeline_report(pipeline, "{\"density\": 500}", &json));
  CHECK(strstr(json, "\"dihedral_histogram\"") != NULL && strstr(json, "\"mass_kg\"") != NULL);
  OK(tetsoup_pipeline_accuracy(pipeline, &json));
  CHECK(strstr(json, "\"iou_pseudo_volume\"") != NULL);
}

static void tour_model(tetsoup_model* model, const char* folder) {
  const double low[3] = {-1e3, -1e3, -1e3}, high[3] = {1e3, 1e3, -10};
  char path[512];
  tetsoup_floats mesh, rest, moved, normals;
  tetsoup_indices tets, triangles;
  const char* json = NULL;
  size_t held = 0;
  float length;
  OK(tetsoup_model_vertices(model, &mesh));
  OK(tetsoup_model_tets(model, &tets));
  OK(tetsoup_model_surface(model, &rest, &triangles));
  OK(tetsoup_model_deform(model, mesh.data, mesh.count, &moved, &normals));
  CHECK(moved.count == rest.count && normals.count == rest.count && triangles.count == 640);
  CHECK(fabs(moved.data[0] - rest.data[0]) < 1e-3);
  length = normals.data[0] * normals.data[0] + normals.data[1] * normals.data[1] + normals.data[2] * normals.data[2];
  CHECK(fabs(length - 1) < 1e-5);
  OK(tetsoup_model_set_material(model, 900, 2e5, 0.3, 0.001));
  OK(tetsoup_model_set_up(model, 1));
  OK(tetsoup_model_add_pins(model, "low", low, high, &held));
  CHECK(held > 0);
  OK(tetsoup_model_report(model, &json));
  CHECK(strstr(json, "\"embedding\"") != NULL);
  OK(tetsoup_format_list(&json));
  CHECK(strstr(json, "\"msh\"") != NULL);
  OK(tetsoup_engine_list(&json));
  CHECK(strstr(json, "\"mujoco\"") != NULL);
  sprintf(path, "%.480s/torus.msh", folder);
  OK(tetsoup_model_write(model, path, "msh", &json));
  CHECK(strstr(json, "torus.msh") != NULL);
  sprintf(path, "%.480s/torus_for_engine", folder);
  OK(tetsoup_model_write_for_engine(model, path, "mujoco", &json));
  CHECK(strstr(json, "\"usage\"") != NULL);
}

static void tour_simulation(const tetsoup_model* model) {
  const double up[3] = {0, 0, 1}, target[3] = {0, 0, 2};
  const float corners[12] = {0, 0, 3, 1, 0, 3, 0, 1, 3, 0, 0, 4};
  const uint32_t tet[4] = {0, 1, 2, 3};
  tetsoup_simulation* simulation = NULL;
  tetsoup_floats positions, velocities, surface, normals;
  tetsoup_indices indices;
  size_t body = 9, single = 9, spring = 9, count = 0;
  uint64_t before = 0, after = 0;
  const char* json = NULL;
  int step;
  OK(tetsoup_simulation_create("{\"substeps\": 8}", &simulation));
  OK(tetsoup_simulation_add_plane(simulation, up, 0, 0.5));
  OK(tetsoup_simulation_add_model(simulation, model, "{\"young\": 5e4}", "{\"scale\": 0.01, \"translate\": [0, 0, 1]}",
                                  &body));
  OK(tetsoup_simulation_add_mesh(simulation, corners, 4, tet, 1, NULL, NULL, &single));
  OK(tetsoup_simulation_body_count(simulation, &count));
  CHECK(body == 0 && single == 1 && count == 2);
  OK(tetsoup_simulation_pin(simulation, single, 3));
  OK(tetsoup_simulation_unpin(simulation, single, 3));
  OK(tetsoup_simulation_add_spring(simulation, body, 0, target, 10, &spring));
  OK(tetsoup_simulation_move_spring(simulation, spring, target));
  OK(tetsoup_simulation_state_hash(simulation, &before));
  OK(tetsoup_simulation_positions(simulation, body, &positions));
  for (step = 0; step < 30; ++step) OK(tetsoup_simulation_step(simulation, 1.0 / 60));
  CHECK(positions.data[2] < 0.9F); /* The view shows every step. */
  OK(tetsoup_simulation_remove_spring(simulation, spring));
  OK(tetsoup_simulation_velocities(simulation, body, &velocities));
  OK(tetsoup_simulation_surface(simulation, body, &surface, &normals));
  OK(tetsoup_simulation_triangles(simulation, body, &indices));
  CHECK(indices.count == 640 && surface.count == normals.count && velocities.count == positions.count);
  OK(tetsoup_simulation_surface(simulation, single, &surface, NULL));
  OK(tetsoup_simulation_triangles(simulation, single, &indices));
  CHECK(surface.count == 4 && indices.count == 4);
  OK(tetsoup_simulation_tets(simulation, single, &indices));
  CHECK(indices.count == 1);
  OK(tetsoup_simulation_state_hash(simulation, &after));
  CHECK(before != after);
  OK(tetsoup_simulation_set_positions(simulation, single, corners, 4));
  OK(tetsoup_simulation_set_velocities(simulation, single, corners, 4));
  OK(tetsoup_simulation_report(simulation, &json));
  CHECK(strstr(json, "\"energy\"") != NULL);
  tetsoup_simulation_destroy(simulation);
}

static void tour_scene(void) {
  static const char text[] =
      "{\"bodies\": [{\"sample\": \"sphere\", \"size\": 0.5, \"mesh\": {\"voxels\": 24, \"tets\": 300},"
      " \"place\": {\"translate\": [0, 0, 1]}}],"
      " \"obstacles\": [{\"sample\": \"heart\", \"size\": 0.5, \"voxels\": 16}]}";
  tetsoup_simulation* scene = NULL;
  tetsoup_floats vertices;
  tetsoup_indices triangles;
  size_t count = 0;
  const char* json = NULL;
  int calls = 0;
  OK(tetsoup_scene_list(&json));
  OK(tetsoup_scene_text("robots-on-tree", &json));
  CHECK(strstr(json, "\"bodies\"") != NULL);
  OK(tetsoup_scene_load(text, NULL, count_calls, &calls, &scene));
  CHECK(calls > 0);
  OK(tetsoup_scene_advance(scene));
  OK(tetsoup_scene_obstacle_count(scene, &count));
  CHECK(count == 1);
  OK(tetsoup_scene_obstacle(scene, 0, &vertices, &triangles));
  CHECK(vertices.count > 1000 && triangles.count > 1000);
  OK(tetsoup_simulation_surface(scene, 0, &vertices, NULL));
  CHECK(vertices.count > 1000);
  tetsoup_simulation_destroy(scene);
}

int main(int argc, char** argv) {
  tetsoup_soup* soup;
  tetsoup_pipeline* pipeline = NULL;
  tetsoup_model* model = NULL;
  int calls = 0;
  CHECK(argc == 2);
  CHECK(tetsoup_c_version() == TETSOUP_C_VERSION && tetsoup_version()[0] != '\0');
  OK(tetsoup_set_thread_count(0));
  CHECK(tetsoup_thread_count() >= 1);
  soup = tour_soup();
  OK(tetsoup_pipeline_create(soup, NULL, NULL, &pipeline));
  tetsoup_soup_destroy(soup);
  OK(tetsoup_pipeline_set_memory_limit(pipeline, 1000000000));
  OK(tetsoup_pipeline_run_until(pipeline, TETSOUP_STAGE_PSEUDO_VOLUME, "{\"voxels\": 48}", count_calls, &calls));
  CHECK(calls > 0);
  tour_fields(pipeline);
  OK(tetsoup_pipeline_run(pipeline, "{\"voxels\": 48, \"tets\": 500}", NULL, NULL));
  tour_mesh(pipeline);
  OK(tetsoup_model_create(pipeline, "torus", NULL, NULL, &model));
  tour_search(pipeline);
  tetsoup_pipeline_destroy(pipeline);
  tour_model(model, argv[1]);
  tour_simulation(model);
  tetsoup_model_destroy(model);
  tour_scene();
  tetsoup_soup_destroy(NULL);
  puts("ok");
  return 0;
}
