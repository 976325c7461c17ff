#include "regions/remove_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "base/elementary.h"
#include "base/tet_geometry.h"

namespace tetsoup {
namespace {

constexpr std::size_t kLargestRing = 7;  // Tets around an edge of the lattices: 4 to 8.
constexpr float kStraddles = 0.9F;       // Share of its own label below which a tet's edges are looked at.
constexpr double kLeastGain = 0.005;     // Of the volume around the edge.

/// An edge, ascending, and a tet that has it.
struct EdgeOfTet {
  std::array<std::uint32_t, 2> edge{};
  std::uint32_t tet = 0;
  bool operator<(const EdgeOfTet& o) const { return edge != o.edge ? edge < o.edge : tet < o.tet; }
};

std::vector<EdgeOfTet> edges_of(const TetMesh& mesh) {
  std::vector<EdgeOfTet> edges;
  edges.reserve(6 * mesh.tets.size());
  for (std::uint32_t t = 0; t < mesh.tets.size(); ++t) {
    for (const auto& [i, j] : kTetEdges) {
      const auto [a, b] =
          std::minmax(mesh.tets[t][static_cast<std::size_t>(i)], mesh.tets[t][static_cast<std::size_t>(j)]);
      edges.push_back({{a, b}, t});
    }
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

class EdgeRemover {
 public:
  EdgeRemover(const TetMesh& mesh, const SmoothOptions& limits, const AskTet& ask)
      : mesh_(mesh),
        ask_(ask),
        acute_(elementary::cos(limits.min_dihedral)),
        obtuse_(elementary::cos(limits.max_dihedral)),
        ratio_(limits.max_edge_ratio) {}

  /// The vertices around the edge, once around; empty where they do not close or are too many.
  std::vector<std::uint32_t> ring(const std::array<std::uint32_t, 2>& edge, std::span<const EdgeOfTet> around) const {
    if (around.size() < 3 || around.size() > kLargestRing) return {};
    std::vector<std::array<std::uint32_t, 2>> arcs;
    for (const EdgeOfTet& e : around) arcs.push_back(arc(edge, mesh_.tets[e.tet]));
    std::vector<std::uint32_t> ring{arcs.front()[0]};
    while (ring.size() <= arcs.size()) {
      const auto next = std::find_if(arcs.begin(), arcs.end(), [&](const auto& a) { return a[0] == ring.back(); });
      if (next == arcs.end()) return {};
      if ((*next)[1] == ring.front()) break;
      ring.push_back((*next)[1]);
    }
    return ring.size() == arcs.size() ? ring : std::vector<std::uint32_t>();
  }

  /// The tets that fill the ring without the edge and have least on the wrong side, and how much that is.
  struct Filling {
    double wrong = std::numeric_limits<double>::infinity();
    std::vector<Tet> tets;
  };
  Filling fill(const std::array<std::uint32_t, 2>& edge, std::span<const std::uint32_t> ring) const {
    if (ring.size() == 2) return {0, {}};
    // The last arc of the ring has a triangle, with one of the others.
    Filling best;
    for (std::size_t k = 1; k + 1 < ring.size(); ++k) {
      const std::uint32_t first = ring.front(), middle = ring[k], last = ring.back();
      Filling now{0, {{first, middle, last, edge[1]}, {first, last, middle, edge[0]}}};
      for (const Tet& tet : now.tets) now.wrong += wrong_of(tet);
      if (!(now.wrong < best.wrong)) continue;
      for (const auto& part : {ring.first(k + 1), ring.subspan(k)}) {
        const Filling rest = fill(edge, part);
        now.wrong += rest.wrong;
        now.tets.insert(now.tets.end(), rest.tets.begin(), rest.tets.end());
      }
      if (now.wrong < best.wrong) best = std::move(now);
    }
    return best;
  }

  double volume(const Tet& tet) const { return signed_volume(corners_of(mesh_, tet)); }

 private:
  /// The two other corners of a tet, such that it is positive as (edge, arc).
  std::array<std::uint32_t, 2> arc(const std::array<std::uint32_t, 2>& edge, const Tet& tet) const {
    std::array<std::uint32_t, 2> others{};
    std::size_t count = 0;
    for (const std::uint32_t v : tet)
      if (v != edge[0] && v != edge[1]) others[count++] = v;
    if (volume({edge[0], edge[1], others[0], others[1]}) < 0) std::swap(others[0], others[1]);
    return others;
  }

  /// Infinite where the tet is not to be.
  double wrong_of(const Tet& tet) const {
    constexpr double kNever = std::numeric_limits<double>::infinity();
    const TetCorners p = corners_of(mesh_, tet);
    const double size = signed_volume(p);
    if (!(size > 0)) return kNever;
    for (const double cosine : dihedral_cosines(p))
      if (!(cosine <= acute_ && cosine >= obtuse_)) return kNever;
    double shortest = kNever, longest = 0;
    for (const auto& [i, j] : kTetEdges) {
      const double edge = length(p[static_cast<std::size_t>(i)] - p[static_cast<std::size_t>(j)]);
      shortest = std::min(shortest, edge), longest = std::max(longest, edge);
    }
    if (longest > ratio_ * shortest) return kNever;
    return size * (1 - static_cast<double>(ask_(tet).front().share));
  }

  const TetMesh& mesh_;
  const AskTet& ask_;
  double acute_, obtuse_, ratio_;
};

}  // namespace

std::size_t remove_crossing_edges(TetMesh& mesh, const TetLabels& labels, const SmoothOptions& limits,
                                  const AskTet& ask) {
  const std::vector<EdgeOfTet> edges = edges_of(mesh);
  const EdgeRemover remover(mesh, limits, ask);
  std::vector<std::uint8_t> is_used(mesh.tets.size(), 0);
  std::vector<std::vector<Tet>> replaced(mesh.tets.size());
  std::size_t removed = 0;
  for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
    while (end < edges.size() && edges[end].edge == edges[begin].edge) ++end;
    const auto around = std::span(edges).subspan(begin, end - begin);
    double wrong = 0, volume = 0;
    bool straddles = false, is_free = true;
    for (const EdgeOfTet& e : around) {
      const float share = labels[e.tet].front().share;
      const double size = remover.volume(mesh.tets[e.tet]);
      wrong += size * (1 - static_cast<double>(share));
      volume += size;
      straddles = straddles || share < kStraddles;
      is_free = is_free && is_used[e.tet] == 0;
    }
    if (!straddles || !is_free) continue;
    const std::vector<std::uint32_t> ring = remover.ring(edges[begin].edge, around);
    if (ring.empty()) continue;
    EdgeRemover::Filling filling = remover.fill(edges[begin].edge, ring);
    if (!(filling.wrong < wrong - kLeastGain * volume)) continue;
    for (const EdgeOfTet& e : around) is_used[e.tet] = 1;
    replaced[around.front().tet] = std::move(filling.tets);
    ++removed;
  }
  if (removed == 0) return 0;
  std::vector<Tet> tets;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    if (is_used[t] == 0) tets.push_back(mesh.tets[t]);
    tets.insert(tets.end(), replaced[t].begin(), replaced[t].end());
  }
  mesh.tets = std::move(tets);
  return removed;
}

}  // namespace tetsoup
