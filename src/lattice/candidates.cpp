#include "lattice/candidates.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/elementary.h"
#include "base/tet_geometry.h"

namespace tetsoup {

double lattice_edge(const TetMesh& mesh) {
  double volume = 0;
  for (const Tet& tet : mesh.tets) volume += signed_volume(corners_of(mesh, tet));
  return elementary::cbrt(6 * std::sqrt(2.0) * volume /
                          static_cast<double>(std::max<std::size_t>(1, mesh.tets.size())));
}

TetMesh kept_mesh(const Candidates& candidates) {
  constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();
  const TetMesh& all = candidates.mesh;
  std::vector<std::uint32_t> number(all.vertices.size(), kUnused);
  TetMesh mesh;
  for (std::size_t t = 0; t < all.tets.size(); ++t) {
    if (!candidates.kept[t]) continue;
    mesh.tets.push_back(all.tets[t]);
    for (const std::uint32_t v : all.tets[t]) number[v] = 0;
  }
  for (std::size_t v = 0; v < number.size(); ++v) {
    if (number[v] == kUnused) continue;
    number[v] = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.push_back(all.vertices[v]);
  }
  for (Tet& tet : mesh.tets)
    for (std::uint32_t& v : tet) v = number[v];
  return mesh;
}

}  // namespace tetsoup
