// The shortest use: half of a sphere's triangles are gone, and it still becomes a solid body.
#include <cstdio>

#include "tetsoup/io.h"
#include "tetsoup/samples.h"
#include "tetsoup/tetsoup.h"

int main() {
  const tetsoup::TriangleSoup soup = tetsoup::make_sample("sphere", {.damage = 0.5});
  const tetsoup::TetMesh mesh = tetsoup::mesh_soup(soup);
  tetsoup::write_tets("sphere.msh", mesh);
  std::printf("%zu triangles -> %zu tets, in sphere.msh\n", soup.triangles.size(), mesh.tets.size());
}
