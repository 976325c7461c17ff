/* What the sliders of the studio cost: one line a sample, milliseconds, median of nine. scripts/studio_times runs it
 * natively and in WebAssembly, and makes the table of docs/C.md of it. */
#define _POSIX_C_SOURCE 199309L
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "tetsoup/tetsoup.h"

enum { kRuns = 9, kFrames = 120 };

static void ok(tetsoup_status status) {
  if (status == TETSOUP_OK) return;
  fprintf(stderr, "%s\n", tetsoup_last_error());
  exit(1);
}

static double now_ms(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec * 1e3 + (double)now.tv_nsec * 1e-6;
}

static int by_size(const void* a, const void* b) {
  const double x = *(const double*)a, y = *(const double*)b;
  return (x > y) - (x < y);
}
static double median(double* times, size_t count) {
  qsort(times, count, sizeof *times, by_size);
  return times[count / 2];
}

static double run_ms(tetsoup_pipeline* pipeline, const char* options) {
  const double begin = now_ms();
  ok(tetsoup_pipeline_run(pipeline, options, NULL, NULL));
  return now_ms() - begin;
}

/* From the soup, then with another k, another density, another smoothing. */
static void print_sample(const char* name) {
  static const char* const options[] = {
      "{\"voxels\": 96, \"tets\": 2000}",
      "{\"voxels\": 96, \"tets\": 2000, \"band_voxels\": 1.5}",
      "{\"voxels\": 96, \"tets\": 2000, \"band_voxels\": 1.5, \"rho_min\": 0.4}",
      "{\"voxels\": 96, \"tets\": 2000, \"band_voxels\": 1.5, \"rho_min\": 0.4, \"passes\": 5}",
  };
  double times[4][kRuns];
  int run, step;
  for (run = 0; run < kRuns; ++run) {
    tetsoup_soup* soup = NULL;
    tetsoup_pipeline* pipeline = NULL;
    double begin;
    ok(tetsoup_soup_sample(name, 0, 1, &soup));
    begin = now_ms();
    ok(tetsoup_pipeline_create(soup, NULL, NULL, &pipeline));
    begin = now_ms() - begin;
    for (step = 0; step < 4; ++step) times[step][run] = run_ms(pipeline, options[step]) + (step == 0 ? begin : 0);
    tetsoup_pipeline_destroy(pipeline);
    tetsoup_soup_destroy(soup);
  }
  printf("%s", name);
  for (step = 0; step < 4; ++step) printf(" %.1f", median(times[step], kRuns));
  printf("\n");
}

/* A frame of the simulation, and the surfaces with their normals. */
static void print_scene(const char* name) {
  const char* text = NULL;
  tetsoup_simulation* scene = NULL;
  tetsoup_floats vertices, normals;
  double steps[kFrames], surfaces[kFrames], begin;
  size_t bodies = 0, body;
  int frame;
  ok(tetsoup_scene_text(name, &text));
  ok(tetsoup_scene_load(text, NULL, NULL, NULL, &scene));
  ok(tetsoup_simulation_body_count(scene, &bodies));
  for (frame = 0; frame < kFrames; ++frame) {
    begin = now_ms();
    ok(tetsoup_scene_advance(scene));
    steps[frame] = now_ms() - begin;
    begin = now_ms();
    for (body = 0; body < bodies; ++body) ok(tetsoup_simulation_surface(scene, body, &vertices, &normals));
    surfaces[frame] = now_ms() - begin;
  }
  printf("%s %.1f %.1f\n", name, median(steps, kFrames), median(surfaces, kFrames));
  tetsoup_simulation_destroy(scene);
}

int main(void) {
  print_sample("torus");
  print_sample("robot");
  print_sample("tree");
  print_scene("robots-on-tree");
  return 0;
}
