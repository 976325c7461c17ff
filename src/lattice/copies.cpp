#include "lattice/copies.h"

#include <algorithm>
#include <map>
#include <tuple>

namespace tetsoup {
namespace {

/// A piece smaller than this share of the largest in its tet gets no copy: it would be a tet of mostly nothing.
constexpr double kLeastShare = 0.25;
/// Voxels; fewer are grid noise, which neither parts nor doubles.
constexpr std::uint32_t kLeastVoxels = 6;
/// Share of a tet; where a part fills one so far, it is no thin part.
constexpr double kThick = 0.9;
/// Tets; copies that hang together in smaller numbers, apart from the part whose pieces they hold, go.
constexpr std::uint32_t kCrumb = 3;

}  // namespace

Copies::Copies(const Candidates& candidates, const TetPieces& pieces, const PieceGraph& graph, double rho_min)
    : candidates_(candidates),
      pieces_(pieces),
      graph_(graph),
      keeps_thin_(rho_min <= 0),
      walk_(candidates.mesh, pieces),
      sets_(pieces.size()),
      worthy_(pieces.size(), 0),
      is_scrap_(pieces.size(), 0) {
  find_worthy();
  join_near();
  drop_thin_of_thick(rho_min);
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

bool Copies::is_small(std::uint32_t copy) {
  return candidates_.density[pieces_.tet_of(copy)] < 1 && voxels(copy) < kLeastVoxels;
}

/// A tet that is dense by several parts only: of parts that fill others around it the copies go that would not have
/// stayed alone, as if each part had a lattice to itself. Thin parts keep them.
void Copies::drop_thin_of_thick(double rho_min) {
  std::vector<std::uint32_t> dropped;
  for (std::size_t t = 0; t < candidates_.kept.size(); ++t) {
    if (pieces_.count(t) < 2 || candidates_.kept[t] != 1) continue;
    const std::vector<std::uint32_t> copies = of(t);
    if (copies.size() < 2) continue;
    for (const std::uint32_t copy : copies) {
      const auto is_thick = [&](std::uint32_t piece) { return has_copy(piece) && density(set_of(piece)) >= kThick; };
      if (density(copy) < rho_min && walk_.leads(graph_.neighbours(), candidates_.mesh.tets[t], copy, is_thick))
        dropped.push_back(copy);
    }
  }
  for (const std::uint32_t copy : dropped) worthy_[copy] = 0;
}

std::vector<std::uint32_t> Copies::of(std::size_t tet) {
  std::vector<std::uint32_t> copies;
  const std::uint32_t first = pieces_.first(tet), end = first + pieces_.count(tet);
  for (std::uint32_t p = first; p < end; ++p)
    if (set_of(p) == p && has_copy(p)) copies.push_back(p);
  return copies;
}

double Copies::density(std::uint32_t copy) {
  const std::size_t tet = pieces_.tet_of(copy);
  if (pieces_.count(tet) == 1) return candidates_.density[tet];
  std::uint32_t all = 0;
  for (std::uint32_t p = pieces_.first(tet); p < pieces_.first(tet) + pieces_.count(tet); ++p) all += pieces_.voxels(p);
  return static_cast<double>(candidates_.density[tet]) * voxels(copy) / std::max(all, 1U);
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
  for (const std::uint32_t a : of(f.a))
    for (const std::uint32_t b : of(f.b))
      if (!are_apart(f.corners, a, b)) pairs.push_back({a, b, 0});
}

/// True if nothing had to be merged.
bool Copies::glue_once() {
  glued_.clear();
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
  }
  return !merge_rivals(rejected) && !(keeps_thin_ && link_torn()) && !drop_crumbs();
}

/// The glued copies are to hang together as the body does. Where a piece of one lot touches a piece too small for a
/// copy, that goes with a copy of its tet; a lot beside a larger one of the same body is no longer told from what is
/// around it. True if there were any.
bool Copies::link_torn() {
  Unions lots(pieces_.size());
  for (const Glue& g : glued_) lots.join(g.a, g.b);
  bool any = false;
  for (std::uint32_t p = 0; p < pieces_.size(); ++p) {
    if (!has_copy(p)) continue;
    for (const std::uint32_t q : graph_.neighbours()[p]) {
      if (has_copy(q)) continue;
      const std::vector<std::uint32_t> copies = of(pieces_.tet_of(q));
      const auto other = std::find_if(copies.begin(), copies.end(), [&](std::uint32_t c) {
        return pieces_.part(c) == pieces_.part(q) && lots.find(c) != lots.find(set_of(p));
      });
      if (other == copies.end()) continue;
      merge(*other, q);
      worthy_[set_of(q)] = 1;
      any = true;
    }
  }
  return any || mark_scraps(lots);
}

/// True if any is new.
bool Copies::mark_scraps(Unions& lots) {
  std::vector<std::uint32_t> sizes(pieces_.size(), 0);
  std::map<std::uint32_t, std::uint32_t> largest;  // of every part of the body, the largest lot's copies
  const auto size_of = [&](std::uint32_t piece) -> std::uint32_t& { return sizes[lots.find(set_of(piece))]; };
  for (std::uint32_t p = 0; p < pieces_.size(); ++p)
    if (has_copy(p) && set_of(p) == p) ++size_of(p);
  for (std::uint32_t p = 0; p < pieces_.size(); ++p)
    if (has_copy(p)) largest[pieces_.part(p)] = std::max(largest[pieces_.part(p)], size_of(p));
  bool any = false;
  for (std::uint32_t p = 0; p < pieces_.size(); ++p) {
    if (!has_copy(p) || is_scrap_[p]) continue;
    if (pieces_.part(p) == VoxelParts::kNone || size_of(p) == largest[pieces_.part(p)]) continue;
    is_scrap_[p] = 1;
    any = true;
  }
  for (std::size_t t = 0; t < candidates_.kept.size(); ++t) {
    if (!candidates_.kept[t] || pieces_.count(t) < 2) continue;
    const std::vector<std::uint32_t> copies = of(t);
    for (const std::uint32_t a : copies)
      for (const std::uint32_t b : copies)
        if (a < b && are_scraps(a, b)) merge(a, b);
  }
  return any;
}

bool Copies::are_scraps(std::uint32_t a, std::uint32_t b) const {
  return (is_scrap_[a] || is_scrap_[b]) && pieces_.part(a) == pieces_.part(b);
}

/// A few copies that separation tore off from all others go if their part goes on where no tet is kept: they would hang
/// in the air. True if there were any.
bool Copies::drop_crumbs() {
  Unions parts(pieces_.size());
  for (const Glue& g : glued_) parts.join(g.a, g.b);
  std::vector<std::uint32_t> sizes(pieces_.size(), 0);
  std::vector<std::uint8_t> torn(pieces_.size(), 0), goes_on(pieces_.size(), 0);
  for (std::uint32_t p = 0; p < pieces_.size(); ++p) {
    if (!has_copy(p)) continue;
    const std::size_t part = parts.find(set_of(p));
    sizes[part] += set_of(p) == p ? 1 : 0;
    for (const std::uint32_t other : graph_.neighbours()[p])
      if (!has_copy(other) || parts.find(set_of(other)) != part) goes_on[part] = 1;
  }
  for (const SharedFace& f : graph_.faces()) {
    if (!candidates_.kept[f.a] || !candidates_.kept[f.b]) continue;
    const std::size_t part = parts.find(set_of(pieces_.first(f.a)));
    for (const std::uint32_t tet : {f.a, f.b})
      for (const std::uint32_t copy : of(tet))
        if (parts.find(copy) != part) torn[parts.find(copy)] = torn[part] = 1;
  }
  bool any = false;
  for (std::uint32_t p = 0; p < pieces_.size(); ++p) {
    const std::size_t part = parts.find(set_of(p));
    if (!worthy_[p] || candidates_.kept[pieces_.tet_of(p)] == kHeld) continue;
    if (sizes[part] > kCrumb || !torn[part] || !goes_on[part]) continue;
    worthy_[p] = 0;
    any = true;
  }
  return any;
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
