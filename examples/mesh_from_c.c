/* The same from C: meshes a sample, says how many tets that gave, and writes them for Gmsh. */
#include <stdio.h>

#include "tetsoup/tetsoup.h"

int main(void) {
  tetsoup_soup* soup = NULL;
  tetsoup_pipeline* pipeline = NULL;
  tetsoup_model* model = NULL;
  tetsoup_indices tets;
  const char* files = NULL;
  if (tetsoup_soup_sample("torus", 0, 1, &soup) != TETSOUP_OK ||
      tetsoup_pipeline_create(soup, NULL, NULL, &pipeline) != TETSOUP_OK ||
      tetsoup_pipeline_run(pipeline, "{\"voxels\": 96, \"tets\": 2000}", NULL, NULL) != TETSOUP_OK ||
      tetsoup_pipeline_tets(pipeline, TETSOUP_MESH_FINAL, &tets) != TETSOUP_OK ||
      tetsoup_model_create(pipeline, "torus", NULL, NULL, &model) != TETSOUP_OK ||
      tetsoup_model_write(model, "torus_from_c.msh", NULL, &files) != TETSOUP_OK) {
    fprintf(stderr, "%s\n", tetsoup_last_error());
    return 1;
  }
  printf("%zu tets in %s\n", tets.count, files);
  tetsoup_model_destroy(model);
  tetsoup_pipeline_destroy(pipeline);
  tetsoup_soup_destroy(soup);
  return 0;
}
