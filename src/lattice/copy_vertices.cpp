#include "lattice/copy_vertices.h"

#include <algorithm>

namespace tetsoup {
namespace {

std::size_t place_of(std::uint32_t vertex, const Tet& tet) {
  return static_cast<std::size_t>(std::find(tet.begin(), tet.end(), vertex) - tet.begin());
}

/// The corners of two neighbouring tets (numbers 4 * tet + 0..3) at their face.
class CornerUnions {
 public:
  CornerUnions(const TetMesh& mesh, std::size_t tets) : mesh_(mesh), unions_(4 * tets) {}

  /// `a`, `b`: numbers of copies of the face's tets.
  void join(const SharedFace& face, std::size_t a, std::size_t b) {
    for (const std::uint32_t v : face.corners)
      unions_.join(4 * a + place_of(v, mesh_.tets[face.a]), 4 * b + place_of(v, mesh_.tets[face.b]));
  }
  std::size_t find(std::size_t corner) { return unions_.find(corner); }

 private:
  const TetMesh& mesh_;
  Unions unions_;
};

/// Fans of kept tets at every vertex, as if nothing were apart.
std::vector<std::uint32_t> count_fans(const Candidates& candidates, const PieceGraph& graph) {
  const TetMesh& mesh = candidates.mesh;
  CornerUnions corners(mesh, mesh.tets.size());
  for (const SharedFace& face : graph.faces())
    if (candidates.kept[face.a] && candidates.kept[face.b]) corners.join(face, face.a, face.b);
  std::vector<std::uint32_t> fans(mesh.vertices.size(), 0);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    for (std::size_t i = 0; i < 4; ++i)
      if (candidates.kept[t] && corners.find(4 * t + i) == 4 * t + i) ++fans[mesh.tets[t][i]];
  return fans;
}

std::vector<CopiedTet> list_copies(const Candidates& candidates, Copies& copies) {
  std::vector<CopiedTet> tets;
  for (std::uint32_t t = 0; t < candidates.kept.size(); ++t) {
    if (!candidates.kept[t]) continue;
    for (const std::uint32_t copy : copies.of(t)) tets.push_back({t, copy, candidates.mesh.tets[t]});
  }
  return tets;
}

}  // namespace

CopyVertices number_vertices(const Candidates& candidates, Copies& copies, const PieceGraph& graph) {
  const TetMesh& mesh = candidates.mesh;
  CopyVertices result{list_copies(candidates, copies), {}};
  std::vector<CopiedTet>& tets = result.tets;
  CornerUnions corners(mesh, tets.size());
  const auto number_of = [&](std::uint32_t copy) {
    const auto is_before = [](const CopiedTet& tet, std::uint32_t c) { return tet.copy < c; };
    return static_cast<std::size_t>(std::lower_bound(tets.begin(), tets.end(), copy, is_before) - tets.begin());
  };
  for (const Glue& g : copies.glued()) corners.join(graph.faces()[g.face], number_of(g.a), number_of(g.b));

  const std::vector<std::uint32_t> fans = count_fans(candidates, graph);
  std::vector<std::uint32_t> parts(mesh.vertices.size(), 0), begun(mesh.vertices.size(), 0);
  const auto for_each_corner = [&](const auto& visit) {
    for (std::size_t c = 0; c < 4 * tets.size(); ++c) visit(c, mesh.tets[tets[c / 4].tet][c % 4]);
  };
  for_each_corner([&](std::size_t c, std::uint32_t v) { parts[v] += corners.find(c) == c; });
  for_each_corner([&](std::size_t c, std::uint32_t v) {
    const std::size_t root = corners.find(c);
    std::uint32_t& name = tets[c / 4].vertices[c % 4];
    if (root != c) {
      name = tets[root / 4].vertices[root % 4];
    } else if (parts[v] > fans[v] && begun[v]++ > 0) {
      name = static_cast<std::uint32_t>(mesh.vertices.size() + result.sources.size());
      result.sources.push_back(v);
    }
  });
  return result;
}

}  // namespace tetsoup
