/* Every sample from soup to sixty steps of its fall, as numbers that are the same on every machine: printed by the
 * native build and in WebAssembly, and compared. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

#include "tetsoup/tetsoup.h"

static const char* const kSamples[] = {"torus", "heart", "sphere", "robot", "tree", "palm"};

static void ok(tetsoup_status status) {
  if (status == TETSOUP_OK) return;
  fprintf(stderr, "%s\n", tetsoup_last_error());
  exit(1);
}

/* FNV-1a */
static uint64_t hash_of(const void* bytes, size_t size) {
  const unsigned char* const p = (const unsigned char*)bytes;
  uint64_t hash = 0xcbf29ce484222325u;
  size_t i;
  for (i = 0; i < size; ++i) hash = (hash ^ p[i]) * 0x100000001b3u;
  return hash;
}
static uint64_t hash_floats(tetsoup_floats view) {
  return hash_of(view.data, view.count * view.width * sizeof(float));
}
static uint64_t hash_indices(tetsoup_indices view) {
  return hash_of(view.data, view.count * view.width * sizeof(uint32_t));
}

static void print_stage_hashes(tetsoup_pipeline* pipeline) {
  tetsoup_grid grid;
  tetsoup_floats floats;
  tetsoup_indices indices;
  ok(tetsoup_pipeline_grid(pipeline, &grid));
  ok(tetsoup_pipeline_slice(pipeline, TETSOUP_FIELD_DISTANCE, 1, grid.size[1] / 2, &floats));
  printf(" distance %016" PRIx64, hash_floats(floats));
  ok(tetsoup_pipeline_slice(pipeline, TETSOUP_FIELD_VOTES, 1, grid.size[1] / 2, &floats));
  printf(" votes %016" PRIx64, hash_floats(floats));
  ok(tetsoup_pipeline_vertices(pipeline, TETSOUP_MESH_LATTICE, &floats));
  printf(" lattice %016" PRIx64, hash_floats(floats));
  ok(tetsoup_pipeline_vertices(pipeline, TETSOUP_MESH_FINAL, &floats));
  ok(tetsoup_pipeline_tets(pipeline, TETSOUP_MESH_FINAL, &indices));
  printf(" mesh %016" PRIx64 " tets %zu %016" PRIx64, hash_floats(floats), indices.count, hash_indices(indices));
}

static void print_fall_hashes(const tetsoup_model* model) {
  const double up[3] = {0, 0, 1};
  tetsoup_simulation* simulation = NULL;
  tetsoup_floats surface, normals;
  size_t body = 0;
  uint64_t hash = 0;
  int step;
  ok(tetsoup_simulation_create(NULL, &simulation));
  ok(tetsoup_simulation_add_plane(simulation, up, -1, 0.5));
  ok(tetsoup_simulation_add_model(simulation, model, NULL, "{\"scale\": 0.01, \"rotate\": [20, 30, 40]}", &body));
  for (step = 0; step < 60; ++step) ok(tetsoup_simulation_step(simulation, 1.0 / 60));
  ok(tetsoup_simulation_surface(simulation, body, &surface, &normals));
  ok(tetsoup_simulation_state_hash(simulation, &hash));
  printf(" fall %016" PRIx64 " surface %016" PRIx64 " normals %016" PRIx64, hash, hash_floats(surface),
         hash_floats(normals));
  tetsoup_simulation_destroy(simulation);
}

/* Options of the mesh may be given as JSON. */
int main(int argc, char** argv) {
  const char* const options = argc > 1 ? argv[1] : "{\"voxels\": 64, \"tets\": 1000}";
  size_t i;
  for (i = 0; i < sizeof kSamples / sizeof kSamples[0]; ++i) {
    tetsoup_soup* soup = NULL;
    tetsoup_pipeline* pipeline = NULL;
    tetsoup_model* model = NULL;
    tetsoup_floats vertices;
    ok(tetsoup_soup_sample(kSamples[i], 0, 1, &soup));
    ok(tetsoup_soup_vertices(soup, &vertices));
    printf("%s soup %016" PRIx64, kSamples[i], hash_floats(vertices));
    ok(tetsoup_pipeline_create(soup, NULL, NULL, &pipeline));
    ok(tetsoup_pipeline_run(pipeline, options, NULL, NULL));
    print_stage_hashes(pipeline);
    ok(tetsoup_model_create(pipeline, kSamples[i], NULL, NULL, &model));
    print_fall_hashes(model);
    printf("\n");
    tetsoup_model_destroy(model);
    tetsoup_pipeline_destroy(pipeline);
    tetsoup_soup_destroy(soup);
  }
  return 0;
}
