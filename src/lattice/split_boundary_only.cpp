#include <algorithm>
#include <iterator>

#include "base/tet_geometry.h"
#include "lattice/boundary_only.h"

namespace tetsoup {
namespace {

using Edge = std::array<std::uint32_t, 2>;

Edge sorted_edge(std::uint32_t a, std::uint32_t b) {
  return {std::min(a, b), std::max(a, b)};
}

void sort_unique(std::vector<Edge>& edges) {
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
}

/// The kept tets by their vertices, so that all around an edge, a face or a tet can be split alike.
class Splitter {
 public:
  explicit Splitter(Candidates& candidates) : candidates_(candidates), tets_of_(candidates.mesh.vertices.size()) {
    find_boundary();
    for (std::uint32_t t = 0; t < tets().size(); ++t) {
      if (!candidates.kept[t]) continue;
      for (const std::uint32_t v : tets()[t])
        if (is_boundary(v)) tets_of_[v].push_back(t);
    }
  }

  std::size_t count_boundary_only() const {
    std::size_t count = 0;
    for (std::size_t t = 0; t < tets().size(); ++t) count += candidates_.kept[t] != 0 && is_boundary_only(tets()[t]);
    return count;
  }
  std::size_t split_edges();
  void split_faces();
  void split_tets();

 private:
  const std::vector<Tet>& tets() const { return candidates_.mesh.tets; }
  /// Vertices made by splits lie inside.
  bool is_boundary(std::uint32_t v) const { return v < is_boundary_.size() && is_boundary_[v]; }
  bool is_boundary_only(const Tet& tet) const {
    return std::all_of(tet.begin(), tet.end(), [&](std::uint32_t v) { return is_boundary(v); });
  }
  void find_boundary();
  std::vector<Edge> inner_edges() const;
  template <std::size_t N>
  void split(const std::array<std::uint32_t, N>& corners);

  Candidates& candidates_;
  std::vector<std::uint8_t> is_boundary_;
  std::vector<Edge> boundary_edges_;
  std::vector<std::vector<std::uint32_t>> tets_of_;  ///< Of boundary vertices; also tets that were theirs once.
};

void Splitter::find_boundary() {
  is_boundary_.assign(candidates_.mesh.vertices.size(), 0);
  const TetComplex complex(candidates_);
  for (std::uint32_t t = 0; t < complex.tet_count(); ++t) {
    for (std::size_t i = 0; i < 4 && complex.is_kept(t); ++i) {
      if (complex.is_kept(complex.neighbour(t, i))) continue;
      for (std::size_t j = 1; j < 4; ++j) {
        const std::uint32_t a = complex.corners(t)[(i + j) % 4], b = complex.corners(t)[(i + j % 3 + 1) % 4];
        boundary_edges_.push_back(sorted_edge(a, b));
        is_boundary_[a] = 1;
      }
    }
  }
  sort_unique(boundary_edges_);
}

/// Between boundary vertices, but not on the boundary; the longest first.
std::vector<Edge> Splitter::inner_edges() const {
  std::vector<Edge> between, inner;
  for (std::size_t t = 0; t < tets().size(); ++t) {
    if (!candidates_.kept[t]) continue;
    for (const auto& [i, j] : kTetEdges) {
      const std::uint32_t a = tets()[t][static_cast<std::size_t>(i)], b = tets()[t][static_cast<std::size_t>(j)];
      if (is_boundary(a) && is_boundary(b)) between.push_back(sorted_edge(a, b));
    }
  }
  sort_unique(between);
  std::set_difference(between.begin(), between.end(), boundary_edges_.begin(), boundary_edges_.end(),
                      std::back_inserter(inner));
  const auto squared = [&](const Edge& e) {
    return squared_length(to_double(candidates_.mesh.vertices[e[0]]) - to_double(candidates_.mesh.vertices[e[1]]));
  };
  std::stable_sort(inner.begin(), inner.end(), [&](const Edge& a, const Edge& b) { return squared(a) > squared(b); });
  return inner;
}

/// Puts a vertex amid the corners of an edge, a face or a tet, and splits every tet that has them all.
template <std::size_t N>
void Splitter::split(const std::array<std::uint32_t, N>& corners) {
  TetMesh& mesh = candidates_.mesh;
  Vec3d middle;
  for (const std::uint32_t v : corners) middle += to_double(mesh.vertices[v]) * (1.0 / N);
  const auto fresh = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.push_back(to_float(middle));
  const std::vector<std::uint32_t> around = tets_of_[corners[0]];
  for (const std::uint32_t t : around) {
    const Tet whole = mesh.tets[t];
    const auto has = [&](std::uint32_t v) { return std::find(whole.begin(), whole.end(), v) != whole.end(); };
    if (!std::all_of(corners.begin(), corners.end(), has)) continue;
    mesh.tets[t][corner_of(whole, corners[0])] = fresh;
    for (std::size_t i = 1; i < N; ++i) {
      Tet part = whole;
      part[corner_of(whole, corners[i])] = fresh;
      for (const std::uint32_t v : part)
        if (is_boundary(v)) tets_of_[v].push_back(static_cast<std::uint32_t>(mesh.tets.size()));
      mesh.tets.push_back(part);
      candidates_.density.push_back(candidates_.density[t]);
      candidates_.kept.push_back(candidates_.kept[t]);
    }
  }
}

std::size_t Splitter::split_edges() {
  const std::vector<Edge> edges = inner_edges();
  for (const Edge& edge : edges) split(edge);
  return edges.size();
}

void Splitter::split_faces() {
  std::vector<Triangle> faces;
  const TetComplex complex(candidates_);
  for (std::uint32_t t = 0; t < complex.tet_count(); ++t) {
    for (std::size_t i = 0; i < 4 && complex.is_kept(t); ++i) {
      const std::uint32_t n = complex.neighbour(t, i);
      const Tet& c = complex.corners(t);
      const Triangle face{c[(i + 1) % 4], c[(i + 2) % 4], c[(i + 3) % 4]};
      const bool is_once = n != kNoTet && t < n && complex.is_kept(n);
      if (is_once && std::all_of(face.begin(), face.end(), [&](std::uint32_t v) { return is_boundary(v); }))
        faces.push_back(face);
    }
  }
  for (const Triangle& face : faces) split(face);
}

/// Only tets that stand alone are left.
void Splitter::split_tets() {
  const std::size_t count = tets().size();
  for (std::size_t t = 0; t < count; ++t)
    if (candidates_.kept[t] && is_boundary_only(tets()[t])) split(Tet(tets()[t]));
}

}  // namespace

void split_boundary_only(Candidates& candidates, TopologyReport& report) {
  Splitter splitter(candidates);
  report.boundary_only_tets += splitter.count_boundary_only();
  report.boundary_only_edges += splitter.split_edges();
  splitter.split_faces();
  splitter.split_tets();
}

}  // namespace tetsoup
