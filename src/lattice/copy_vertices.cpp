#include "lattice/copy_vertices.h"

#include <algorithm>

namespace tetsoup {
namespace {

std::size_t place_of(std::uint32_t vertex, const Tet& tet) {
  return static_cast<std::size_t>(std::find(tet.begin(), tet.end(), vertex) - tet.begin());
}

std::vector<CopiedTet> list_copies(const Candidates& candidates, Copies& copies) {
  std::vector<CopiedTet> tets;
  for (std::uint32_t t = 0; t < candidates.kept.size(); ++t) {
    if (!candidates.kept[t]) continue;
    for (const std::uint32_t copy : copies.of(t)) tets.push_back({t, copy, candidates.mesh.tets[t]});
  }
  return tets;
}

class Numbering {
 public:
  Numbering(const Candidates& candidates, Copies& copies, const PieceGraph& graph)
      : mesh_(candidates.mesh),
        copies_(copies),
        graph_(graph),
        tets_(list_copies(candidates, copies)),
        corners_(4 * tets_.size()) {}

  CopyVertices number() {
    for (const Glue& g : copies_.glued()) join(graph_.faces()[g.face], number_of(g.a), number_of(g.b));
    join_touching();
    CopyVertices result{tets_, {}};
    std::vector<std::uint8_t> is_taken(mesh_.vertices.size(), 0);
    for (std::size_t c = 0; c < 4 * tets_.size(); ++c) {
      const std::size_t root = corners_.find(c);
      std::uint32_t& name = result.tets[c / 4].vertices[c % 4];
      if (root != c) {
        name = result.tets[root / 4].vertices[root % 4];
      } else if (is_taken[name]) {
        result.sources.push_back(name);
        name = static_cast<std::uint32_t>(mesh_.vertices.size() + result.sources.size() - 1);
      } else {
        is_taken[name] = 1;
      }
    }
    return result;
  }

 private:
  /// Corners are 4 * number of the copy + 0..3.
  std::uint32_t vertex_of(std::size_t corner) const { return mesh_.tets[tets_[corner / 4].tet][corner % 4]; }
  std::size_t number_of(std::uint32_t copy) const {
    const auto is_before = [](const CopiedTet& tet, std::uint32_t c) { return tet.copy < c; };
    return static_cast<std::size_t>(std::lower_bound(tets_.begin(), tets_.end(), copy, is_before) - tets_.begin());
  }
  void join(const SharedFace& face, std::size_t a, std::size_t b) {
    for (const std::uint32_t v : face.corners)
      corners_.join(4 * a + place_of(v, mesh_.tets[face.a]), 4 * b + place_of(v, mesh_.tets[face.b]));
  }

  /// Of vertices with several fans of copies.
  void join_touching() {
    std::vector<std::uint32_t> fans(mesh_.vertices.size(), 0);
    for (std::size_t c = 0; c < 4 * tets_.size(); ++c) fans[vertex_of(c)] += corners_.find(c) == c;
    const Groups<std::size_t> roots(mesh_.vertices.size(), [&](const auto& put) {
      for (std::size_t c = 0; c < 4 * tets_.size(); ++c)
        if (fans[vertex_of(c)] > 1) put(vertex_of(c), c);
    });
    for (std::uint32_t v = 0; v < fans.size(); ++v)
      if (fans[v] > 1) join_fans(v, roots[v]);
  }
  void join_fans(std::uint32_t v, std::span<const std::size_t> corners) {
    std::vector<std::uint32_t> largest;  // copy of every fan
    std::vector<std::size_t> roots;
    for (const std::size_t c : corners) {
      const std::uint32_t copy = tets_[c / 4].copy;
      const auto at = std::find(roots.begin(), roots.end(), corners_.find(c)) - roots.begin();
      if (at == std::ssize(roots)) {
        roots.push_back(corners_.find(c));
        largest.push_back(copy);
      } else if (auto& other = largest[static_cast<std::size_t>(at)]; copies_.density(copy) > copies_.density(other)) {
        other = copy;
      }
    }
    for (std::size_t i = 0; i < roots.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (!copies_.are_apart(std::span(&v, 1), largest[i], largest[j])) corners_.join(roots[i], roots[j]);
  }

  const TetMesh& mesh_;
  Copies& copies_;
  const PieceGraph& graph_;
  std::vector<CopiedTet> tets_;
  Unions corners_;
};

}  // namespace

CopyVertices number_vertices(const Candidates& candidates, Copies& copies, const PieceGraph& graph) {
  return Numbering(candidates, copies, graph).number();
}

}  // namespace tetsoup
