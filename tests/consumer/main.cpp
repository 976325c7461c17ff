// Meshes a cube made by formula; succeeds if there are tets, and if they reach a file where tetsoup::io is used.
#include <cstdint>
#include <cstdio>

#include "tetsoup/tetsoup.h"
#ifdef USE_IO
#include "tetsoup/animation.h"
#include "tetsoup/io.h"
#endif

namespace {

// Corner i has the bits of i as its coordinates; a face is the four corners that agree in one bit.
tetsoup::TriangleSoup make_cube() {
  tetsoup::TriangleSoup cube;
  for (unsigned i = 0; i < 8; ++i)
    cube.vertices.push_back(
        {static_cast<float>(i & 1U), static_cast<float>((i >> 1U) & 1U), static_cast<float>((i >> 2U) & 1U)});
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    const std::uint32_t u = 1U << ((axis + 1) % 3), v = 1U << ((axis + 2) % 3);
    for (const std::uint32_t side : {0U, 1U << axis}) {
      cube.triangles.push_back({side, side + u, side + v});
      cube.triangles.push_back({side + u, side + v, side + u + v});
    }
  }
  return cube;
}

}  // namespace

int main() {
  tetsoup::MeshOptions options;
  options.distance.voxels = 16;
  options.lattice.cells = 3;
  const tetsoup::TetMesh mesh = tetsoup::mesh_soup(make_cube(), options);
  std::printf("%zu tets\n", mesh.tets.size());
  if (mesh.tets.empty()) return 1;
#ifdef USE_IO
  tetsoup::write_tets("cube.msh", mesh);
  if (tetsoup::read_tets("cube.msh").tets.size() != mesh.tets.size()) return 1;
  tetsoup::AnimationWriter film({"cube.webp", "cube.glb"}, {{{"cube", &mesh, nullptr, nullptr}}, {}, {}});
  film.add_frame({0, 0, {mesh.vertices}, {}, {}});
  film.finish();
  if (film.report().files.size() != 2) return 1;
#endif
  return 0;
}
