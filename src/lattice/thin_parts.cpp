#include "lattice/thin_parts.h"

#include <algorithm>
#include <limits>
#include <queue>
#include <tuple>

#include "base/unions.h"
#include "lattice/piece_graph.h"

namespace tetsoup {
namespace {

/// Lattice edges, between centres of tets: a shorter stretch without cover, that is one to some 1.5 edges long, is
/// left.
constexpr double kLeastLength = 0.5;
/// Voxels. Soup and volume differ by a voxel or so, which is more than a tet of a lattice with shorter edges.
constexpr double kLeastEdge = 3;
constexpr float kThick = 0.9F;      ///< Share of a tet; what fills one is not thin there.
constexpr float kTrace = 0.02F;     ///< Share of a tet; a part that has less of it is not in it.
constexpr float kOfFullest = 0.5F;  ///< A thin part keeps the tets it fills at least half as much as its fullest near.
constexpr float kStep = 0.05F;      ///< Cost of a tet on the way from one kept tet to another, besides its empty share.

double mean_edge(const TetMesh& mesh) {
  constexpr std::size_t kEnough = 64;  // tets: the lattice repeats itself
  double sum = 0;
  const std::size_t count = std::min(kEnough, mesh.tets.size());
  for (std::size_t t = 0; t < count; ++t)
    for (const auto& e : kTetEdges)
      sum += length(to_double(mesh.vertices[mesh.tets[t][static_cast<std::size_t>(e[0])]]) -
                    to_double(mesh.vertices[mesh.tets[t][static_cast<std::size_t>(e[1])]]));
  return sum / static_cast<double>(6 * count);
}

struct Extent {
  Vec3d lo{1e300, 1e300, 1e300}, hi{-1e300, -1e300, -1e300};
  void add(const Vec3d& p) {
    lo = min(lo, p);
    hi = max(hi, p);
  }
  double diagonal() const { return lo.x > hi.x ? 0 : length(hi - lo); }
};

class ThinParts {
 public:
  explicit ThinParts(Candidates& candidates)
      : c_(candidates), mesh_(candidates.mesh), faces_(shared_faces(mesh_)), is_bare_(mesh_.tets.size(), 0) {}

  std::size_t keep(const BitGrid& inside, const BitGrid& passed, StageWatch& watch) {
    std::size_t count = 0;
    if (mean_edge(mesh_) >= kLeastEdge * passed.frame.voxel_size) find_bare_tets();
    Unions bare(mesh_.tets.size());
    for (const SharedFace& f : faces_)
      if (is_bare_[f.a] && is_bare_[f.b]) bare.join(f.a, f.b);
    if (find_long([](std::size_t t) { return t; }, bare)) {
      const TetPieces pieces(c_, c_.passed, passed, watch);
      const PieceGraph graph(mesh_, faces_, pieces, passed, watch);
      Unions runs(pieces.size());
      for (const Contact& c : graph.contacts())
        if (is_bare_[pieces.tet_of(c.a)] && is_bare_[pieces.tet_of(c.b)]) runs.join(c.a, c.b);
      if (find_long([&](std::size_t piece) { return pieces.tet_of(static_cast<std::uint32_t>(piece)); }, runs)) {
        count += keep_bare();
        Unions parts = kept_parts();
        count += join(pieces, graph, parts, thin_parts(parts));
      }
    }
    Unions parts = kept_parts();
    if (count_parts(parts) > 1) {
      const TetPieces pieces(c_, c_.density, inside, watch);
      const PieceGraph graph(mesh_, faces_, pieces, inside, watch);
      count += join(pieces, graph, parts, std::vector<std::uint8_t>(mesh_.tets.size(), 1));
    }
    return count;
  }

 private:
  template <class Visit>
  void for_each_corner(const Visit& visit) const {
    for (std::size_t t = 0; t < mesh_.tets.size(); ++t)
      for (const std::uint32_t v : mesh_.tets[t]) visit(t, v);
  }
  Vec3d centre(std::size_t t) const {
    Vec3d sum;
    for (const std::uint32_t v : mesh_.tets[t]) sum += to_double(mesh_.vertices[v]) * 0.25;
    return sum;
  }

  bool has_corner(std::size_t t, const std::vector<std::uint8_t>& marked) const {
    const Tet& tet = mesh_.tets[t];
    return std::any_of(tet.begin(), tet.end(), [&](std::uint32_t v) { return marked[v] != 0; });
  }

  /// Tets that hold something, with nothing thick and no kept tet around.
  void find_bare_tets() {
    std::vector<std::uint8_t> covered(mesh_.vertices.size(), 0);
    for_each_corner([&](std::size_t t, std::uint32_t v) { covered[v] |= c_.kept[t] != 0 || c_.density[t] >= kThick; });
    for (std::size_t t = 0; t < mesh_.tets.size(); ++t) is_bare_[t] = c_.passed[t] >= kTrace && !has_corner(t, covered);
  }

  /// Marks the bare tets of sets that are long enough, sets of things that lie in tets; false if there are none.
  template <class TetOf>
  bool find_long(const TetOf& tet_of, Unions& sets) {
    std::vector<Extent> extents(sets.size());
    for (std::size_t i = 0; i < sets.size(); ++i)
      if (is_bare_[tet_of(i)]) extents[sets.find(i)].add(centre(tet_of(i)));
    const double least = kLeastLength * mean_edge(mesh_);
    in_part_.assign(mesh_.tets.size(), 0);
    for (std::size_t i = 0; i < sets.size(); ++i)
      if (extents[sets.find(i)].diagonal() >= least) in_part_[tet_of(i)] = 1;
    return std::find(in_part_.begin(), in_part_.end(), 1) != in_part_.end();
  }

  std::size_t keep_bare() {
    std::vector<float> fullest(mesh_.vertices.size(), 0);
    for_each_corner([&](std::size_t t, std::uint32_t v) {
      if (in_part_[t]) fullest[v] = std::max(fullest[v], c_.passed[t]);
    });
    std::size_t count = 0;
    for (std::size_t t = 0; t < mesh_.tets.size(); ++t) {
      if (!in_part_[t]) continue;
      float most = 0;
      for (const std::uint32_t v : mesh_.tets[t]) most = std::max(most, fullest[v]);
      if (c_.passed[t] < kOfFullest * most) continue;
      c_.kept[t] = kHeld;
      ++count;
    }
    return count;
  }

  Unions kept_parts() const {
    Unions parts(mesh_.tets.size());
    for (const SharedFace& f : faces_)
      if (c_.kept[f.a] && c_.kept[f.b]) parts.join(f.a, f.b);
    return parts;
  }
  std::size_t count_parts(Unions& parts) const {
    std::size_t count = 0;
    for (std::size_t t = 0; t < mesh_.tets.size(); ++t) count += c_.kept[t] && parts.find(t) == t;
    return count;
  }
  /// Those that hold a thin part and nothing thick, by their first tet.
  std::vector<std::uint8_t> thin_parts(Unions& parts) const {
    std::vector<std::uint8_t> is_thin(mesh_.tets.size(), 0);
    for (std::size_t t = 0; t < mesh_.tets.size(); ++t)
      if (in_part_[t] && c_.kept[t]) is_thin[parts.find(t)] = 1;
    for (std::size_t t = 0; t < mesh_.tets.size(); ++t)
      if (c_.kept[t] && c_.density[t] >= kThick) is_thin[parts.find(t)] = 0;
    return is_thin;
  }

  /// Shortest ways over the pieces from every part, and of the places where two meet the cheapest that join what is not
  /// joined yet: a minimum spanning tree. One of the two must be of those to be joined.
  std::size_t join(const TetPieces& pieces, const PieceGraph& graph, Unions& parts,
                   const std::vector<std::uint8_t>& to_join) {
    find_ways(pieces, graph);
    struct Bridge {
      float cost;
      std::uint32_t a, b;
    };
    std::vector<Bridge> bridges;
    const auto part_of = [&](std::uint32_t piece) { return parts.find(pieces.tet_of(origin_[piece])); };
    for (const Contact& c : graph.contacts()) {
      if (origin_[c.a] == kNobody || origin_[c.b] == kNobody || part_of(c.a) == part_of(c.b)) continue;
      if (to_join[part_of(c.a)] || to_join[part_of(c.b)]) bridges.push_back({cost_[c.a] + cost_[c.b], c.a, c.b});
    }
    std::sort(bridges.begin(), bridges.end(),
              [](const Bridge& p, const Bridge& q) { return std::tie(p.cost, p.a, p.b) < std::tie(q.cost, q.a, q.b); });
    std::size_t count = 0;
    for (const Bridge& bridge : bridges) {
      if (part_of(bridge.a) == part_of(bridge.b)) continue;
      parts.join(part_of(bridge.a), part_of(bridge.b));
      count += keep_way(bridge.a, pieces) + keep_way(bridge.b, pieces);
    }
    return count;
  }

  void find_ways(const TetPieces& pieces, const PieceGraph& graph) {
    using Entry = std::pair<float, std::uint32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    cost_.assign(pieces.size(), std::numeric_limits<float>::infinity());
    origin_.assign(pieces.size(), kNobody);
    before_.assign(pieces.size(), kNobody);
    for (std::uint32_t p = 0; p < pieces.size(); ++p) {
      if (!c_.kept[pieces.tet_of(p)]) continue;
      cost_[p] = 0;
      origin_[p] = p;
      queue.push({0.0F, p});
    }
    while (!queue.empty()) {
      const auto [cost, p] = queue.top();
      queue.pop();
      if (cost > cost_[p]) continue;
      for (const std::uint32_t q : graph.neighbours()[p]) {
        const float longer = cost + kStep + 1 - c_.passed[pieces.tet_of(q)];
        if (longer >= cost_[q]) continue;
        cost_[q] = longer;
        origin_[q] = origin_[p];
        before_[q] = p;
        queue.push({longer, q});
      }
    }
  }

  std::size_t keep_way(std::uint32_t piece, const TetPieces& pieces) {
    std::size_t count = 0;
    for (; before_[piece] != kNobody; piece = before_[piece]) {
      c_.kept[pieces.tet_of(piece)] = kHeld;
      ++count;
    }
    return count;
  }

  static constexpr std::uint32_t kNobody = TetPieces::kNone;

  Candidates& c_;
  const TetMesh& mesh_;
  std::vector<SharedFace> faces_;
  std::vector<std::uint8_t> is_bare_;           ///< Of every tet,
  std::vector<std::uint8_t> in_part_;           ///< and whether it belongs to a bare stretch of some length.
  std::vector<float> cost_;                     ///< Of every piece: of the way there from the nearest kept tet,
  std::vector<std::uint32_t> origin_, before_;  ///< its first piece and the one before.
};

}  // namespace

std::size_t keep_thin_parts(Candidates& candidates, const BitGrid& inside, const BitGrid& passed, StageWatch& watch) {
  return ThinParts(candidates).keep(inside, passed, watch);
}

}  // namespace tetsoup
