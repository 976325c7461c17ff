#include "lattice/copies.h"

#include <algorithm>
#include <tuple>

namespace tetsoup {
namespace {

/// A piece smaller than this share of the largest in its tet gets no copy: it would be a tet of mostly nothing.
constexpr double kLeastShare = 0.25;
/// Voxels; fewer are grid noise, which neither parts nor doubles.
constexpr std::uint32_t kLeastVoxels = 6;

}  // namespace

Copies::Copies(const Candidates& candidates, const TetPieces& pieces, const PieceGraph& graph)
    : candidates_(candidates),
      pieces_(pieces),
      graph_(graph),
      walk_(candidates.mesh, pieces),
      sets_(pieces.size()),
      worthy_(pieces.size(), 0) {
  find_worthy();
  join_near();
}

void Copies::find_worthy() {
  for (std::size_t t = 0; t < candidates_.kept.size(); ++t) {
    if (!candidates_.kept[t]) continue;
    const std::uint32_t first = pieces_.first(t), end = first + pieces_.count(t);
    std::uint32_t largest = first;
    for (std::uint32_t p = first; p < end; ++p)
      if (pieces_.voxels(p) > pieces_.voxels(largest)) largest = p;
    const double least = std::max<double>(kLeastVoxels, kLeastShare * pieces_.voxels(largest));
    for (std::uint32_t p = first; p < end; ++p) worthy_[p] = p == largest || pieces_.voxels(p) >= least;
  }
}

/// Pieces of a tet that are one in the tets around it belong to the same copy, small ones too.
void Copies::join_near() {
  for (std::size_t t = 0; t < candidates_.kept.size(); ++t) {
    if (!candidates_.kept[t]) continue;
    const std::uint32_t first = pieces_.first(t), end = first + pieces_.count(t);
    for (std::uint32_t p = first; p < end; ++p) {
      for (std::uint32_t q = first; q < p; ++q) {
        if (set_of(p) == set_of(q)) continue;
        if (!walk_.leads(graph_.neighbours(), candidates_.mesh.tets[t], p, q)) continue;
        const bool worthy = has_copy(p) || has_copy(q);
        sets_.join(p, q);
        worthy_[set_of(p)] = worthy;
      }
    }
  }
}

std::vector<std::uint32_t> Copies::of(std::size_t tet) {
  std::vector<std::uint32_t> copies;
  const std::uint32_t first = pieces_.first(tet), end = first + pieces_.count(tet);
  for (std::uint32_t p = first; p < end; ++p)
    if (set_of(p) == p && has_copy(p)) copies.push_back(p);
  return copies;
}

std::uint32_t Copies::voxels(std::uint32_t copy) {
  const std::size_t tet = pieces_.tet_of(copy);
  std::uint32_t sum = 0;
  for (std::uint32_t p = pieces_.first(tet); p < pieces_.first(tet) + pieces_.count(tet); ++p)
    if (set_of(p) == copy) sum += pieces_.voxels(p);
  return sum;
}

/// The copies that touch through a face, those that touch most first.
std::vector<Copies::Pair> Copies::pairs_of(std::size_t face) {
  std::vector<Pair> pairs;
  for (const Contact& c : graph_.contacts(face)) {
    if (!has_copy(c.a) || !has_copy(c.b)) continue;
    const Pair pair{set_of(c.a), set_of(c.b), c.samples};
    const auto same = [&](const Pair& other) { return other.a == pair.a && other.b == pair.b; };
    const auto found = std::find_if(pairs.begin(), pairs.end(), same);
    if (found == pairs.end()) {
      pairs.push_back(pair);
    } else {
      found->samples += pair.samples;
    }
  }
  if (pairs.empty()) add_near(face, pairs);
  std::sort(pairs.begin(), pairs.end(),
            [](const Pair& p, const Pair& q) { return std::tie(q.samples, p.a, p.b) < std::tie(p.samples, q.a, q.b); });
  return pairs;
}

/// Where nothing touches through the face: copies that are one nearby, or of which one is too small to tell.
void Copies::add_near(std::size_t face, std::vector<Pair>& pairs) {
  const SharedFace& f = graph_.faces()[face];
  const auto is_small = [&](std::uint32_t copy) {
    return candidates_.density[pieces_.tet_of(copy)] < 1 && voxels(copy) < kLeastVoxels;
  };
  for (const std::uint32_t a : of(f.a))
    for (const std::uint32_t b : of(f.b))
      if (is_small(a) || is_small(b) || walk_.leads(graph_.neighbours(), f.corners, a, b)) pairs.push_back({a, b, 0});
}

/// True if nothing had to be merged.
bool Copies::glue_once() {
  glued_.clear();
  all_joined_ = true;
  std::vector<Glue> rejected;
  std::vector<std::uint32_t> taken;
  const auto is_free = [&](std::uint32_t copy) { return std::find(taken.begin(), taken.end(), copy) == taken.end(); };
  for (std::uint32_t face = 0; face < graph_.faces().size(); ++face) {
    const SharedFace& f = graph_.faces()[face];
    if (!candidates_.kept[f.a] || !candidates_.kept[f.b]) continue;
    taken.clear();
    for (const Pair& pair : pairs_of(face)) {
      if (is_free(pair.a) && is_free(pair.b)) {
        glued_.push_back({face, pair.a, pair.b});
        taken.insert(taken.end(), {pair.a, pair.b});
      } else {
        rejected.push_back({face, pair.a, pair.b});
      }
    }
    const bool is_plain = pieces_.count(f.a) == 1 && pieces_.count(f.b) == 1;
    if (taken.size() != 2 || !(is_plain || (of(f.a).size() == 1 && of(f.b).size() == 1))) all_joined_ = false;
  }
  return !merge_rivals(rejected);
}

/// Of several copies that touch the same one through a face only one can have the face. The others may go without if
/// they reach it on another way nearby; else they are one with the first. True if any were merged.
bool Copies::merge_rivals(const std::vector<Glue>& rejected) {
  if (rejected.empty()) return false;
  const Groups<std::uint32_t> neighbours(pieces_.size(), [&](const auto& put) {
    for (const Glue& g : glued_) {
      put(g.a, g.b);
      put(g.b, g.a);
    }
  });
  bool merged = false;
  for (const Glue& lost : rejected) {
    if (walk_.leads(neighbours, graph_.faces()[lost.face].corners, lost.a, lost.b)) continue;
    const auto first = std::lower_bound(glued_.begin(), glued_.end(), lost.face,
                                        [](const Glue& g, std::uint32_t face) { return g.face < face; });
    for (auto g = first; g != glued_.end() && g->face == lost.face; ++g) {
      if (g->a == lost.a) merge(g->b, lost.b);
      if (g->b == lost.b) merge(g->a, lost.a);
    }
    merged = true;
  }
  return merged;
}

void Copies::glue() {
  while (!glue_once()) {
  }
}

}  // namespace tetsoup
