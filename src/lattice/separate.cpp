#include "lattice/separate.h"

#include <algorithm>
#include <limits>

#include "lattice/copy_vertices.h"

namespace tetsoup {
namespace {

/// Voxels. A tet with fewer shows no parts, only the grid.
constexpr double kLeastTet = 12;

std::size_t count_common(const Tet& a, const Tet& b) {
  return static_cast<std::size_t>(
      std::count_if(a.begin(), a.end(), [&](std::uint32_t v) { return std::find(b.begin(), b.end(), v) != b.end(); }));
}

/// Two copies of a tet that have a face in common would make it a face of three tets: they are merged. True if there
/// were any.
bool merge_folded(const std::vector<CopiedTet>& tets, Copies& copies) {
  bool merged = false;
  for (std::size_t i = 0; i < tets.size(); ++i) {
    for (std::size_t j = i + 1; j < tets.size() && tets[j].tet == tets[i].tet; ++j) {
      if (count_common(tets[i].vertices, tets[j].vertices) < 3) continue;
      copies.merge(tets[i].copy, tets[j].copy);
      merged = true;
    }
  }
  return merged;
}

/// Tets that are not kept go with the neighbouring copy with which they have most vertices, so that they stay of use
/// to whoever adds tets.
void attach_others(Candidates& candidates, const CopyVertices& numbered) {
  TetMesh& mesh = candidates.mesh;
  std::vector<std::uint8_t> is_doubled(mesh.vertices.size(), 0);
  for (const std::uint32_t v : numbered.sources) is_doubled[v] = 1;
  const TetMesh before = mesh;
  const Groups<std::uint32_t> around(mesh.vertices.size(), [&](const auto& put) {
    for (std::uint32_t i = 0; i < numbered.tets.size(); ++i)
      for (const std::uint32_t v : before.tets[numbered.tets[i].tet])
        if (is_doubled[v]) put(v, i);
  });
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    if (candidates.kept[t]) continue;
    Tet& tet = mesh.tets[t];
    for (std::size_t i = 0; i < 4; ++i) {
      const std::uint32_t v = before.tets[t][i];
      if (!is_doubled[v]) continue;
      std::size_t most = 0;
      for (const std::uint32_t n : around[v]) {
        const Tet& place = before.tets[numbered.tets[n].tet];
        // What is named so far counts with its new name, so that the tet's corners go with one copy if they can.
        const std::size_t common =
            4 * count_common(tet, numbered.tets[n].vertices) + count_common(before.tets[t], place);
        if (common <= most) continue;
        most = common;
        const auto at = std::find(place.begin(), place.end(), v) - place.begin();
        tet[i] = numbered.tets[n].vertices[static_cast<std::size_t>(at)];
      }
    }
  }
}

/// The first copy of a tet takes its place, the others go to the end. Each has its share of the tet's density.
std::size_t store_copies(Candidates& candidates, Copies& copies, const CopyVertices& numbered) {
  TetMesh& mesh = candidates.mesh;
  const std::size_t tets_before = mesh.tets.size();
  std::vector<float> densities;
  for (const CopiedTet& tet : numbered.tets) densities.push_back(static_cast<float>(copies.density(tet.copy)));
  for (const std::uint32_t v : numbered.sources) mesh.vertices.push_back(mesh.vertices[v]);
  std::vector<std::uint8_t> kept(tets_before, 0);
  for (std::size_t i = 0; i < numbered.tets.size(); ++i) {
    const CopiedTet& tet = numbered.tets[i];
    if (kept[tet.tet] == 0) {
      kept[tet.tet] = candidates.kept[tet.tet];
      mesh.tets[tet.tet] = tet.vertices;
      candidates.density[tet.tet] = densities[i];
    } else {
      kept.push_back(candidates.kept[tet.tet]);
      mesh.tets.push_back(tet.vertices);
      candidates.density.push_back(densities[i]);
    }
  }
  candidates.kept = std::move(kept);
  return mesh.tets.size() - tets_before;
}

/// Voxels of the smallest tet, on average.
double smallest_tet(const TetMesh& mesh, const GridFrame& grid) {
  double smallest = std::numeric_limits<double>::max();
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    smallest = std::min(smallest, signed_volume(corners_in_voxels(mesh, mesh.tets[t], grid)));
  return smallest;
}

}  // namespace

Separated separate(Candidates& candidates, const BitGrid& inside, const VoxelParts& parts, double rho_min,
                   StageWatch& watch) {
  if (smallest_tet(candidates.mesh, inside.frame) < kLeastTet) return {};
  const TetPieces pieces(candidates, inside, parts, watch);
  const std::vector<SharedFace> faces = shared_faces(candidates.mesh);
  const PieceGraph graph(candidates.mesh, faces, pieces, inside, watch);
  Copies copies(candidates, pieces, graph, rho_min);
  copies.glue();
  CopyVertices numbered = number_vertices(candidates, copies, graph);
  while (merge_folded(numbered.tets, copies)) {
    copies.glue();
    numbered = number_vertices(candidates, copies, graph);
  }
  attach_others(candidates, numbered);
  return {store_copies(candidates, copies, numbered), numbered.sources.size()};
}

}  // namespace tetsoup
