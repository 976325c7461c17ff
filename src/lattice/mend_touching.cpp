#include "lattice/mend_touching.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "base/require.h"
#include "base/unions.h"
#include "lattice/star.h"

namespace tetsoup {
namespace {

// Costs are volumes: what is added outside, what is lost inside.
constexpr double kDropWeight = 2.0;  ///< To lose inside volume is worse than to add outside volume: it may cut a limb.
constexpr double kHeldWeight = 1e3;  ///< To lose a held tet: only if nothing else is left.
constexpr double kLeastBridge = 0.15;  ///< Mean density of a bridge; through a clear gap none is built.
// To double a vertex changes no volume, but what hung together by it no longer does. In mean tets of the star:
constexpr double kDoubleSamePart = 0.5;   ///< The tets are also joined elsewhere;
constexpr double kDoubleOtherPart = 4.0;  ///< they are not: limbs thinner than a tet are strung together like this.
constexpr double kDoubleCover = 10;       ///< Times as much in a cover: what it touches it belongs to.

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::size_t kWatchEvery = 256;  ///< Repairs between two looks at the watch.

struct Repair {
  std::vector<std::uint32_t> tets;  ///< To be flipped; none: the vertex is doubled.
  double score = kInfinity;         ///< The least is taken.
};

class Mender {
 public:
  Mender(TetComplex& complex, std::vector<std::uint8_t> is_bad, TopologyReport& report)
      : complex_(complex), is_bad_(std::move(is_bad)), parts_(complex.tet_count()), report_(report) {
    for (std::uint32_t t = 0; t < complex.tet_count(); ++t) join_part(t);
  }

  /// Mends one bad vertex, if it can; says whether it did.
  bool mend(std::uint32_t v, Ways ways);
  bool is_bad(std::uint32_t v) const { return is_bad_[v] != 0; }
  /// Vertices that became bad since this was asked last.
  std::vector<std::uint32_t> take_new_bad() { return std::exchange(new_bad_, {}); }

 private:
  void join_part(std::uint32_t t) {
    if (!complex_.is_kept(t)) return;
    for (std::size_t i = 0; i < 4; ++i)
      if (const std::uint32_t n = complex_.neighbour(t, i); complex_.is_kept(n)) parts_.join(t, n);
  }
  double cost_to_flip(std::uint32_t t) const;
  void consider_flips(const Star& star, std::uint32_t v);
  bool is_thin_air(const std::vector<std::uint32_t>& tets) const;
  void consider(const std::vector<std::uint32_t>& tets);
  double cost_to_part(const Star& star);
  double score(double cost, double mended) const;
  void consider_doubling(const Star& star, std::uint32_t v);
  std::vector<std::uint32_t> vertices_of(const std::vector<std::uint32_t>& tets) const;
  void flip(const std::vector<std::uint32_t>& tets);
  void judge_again(const std::vector<std::uint32_t>& vertices);
  void carry_out(std::uint32_t v);

  TetComplex& complex_;
  std::vector<std::uint8_t> is_bad_;
  Unions parts_;
  TopologyReport& report_;
  std::vector<std::uint32_t> new_bad_;
  Ways ways_ = Ways::All;
  double mean_volume_ = 0;   ///< Of the tets around the vertex being mended.
  bool can_double_ = false;  ///< There the kept tets are not joined through faces;
  double parting_ = 0;       ///< what doubling would cost.
  Repair best_;
};

double Mender::cost_to_flip(std::uint32_t t) const {
  const double inside = std::clamp<double>(complex_.density(t), 0, 1), volume = complex_.volume(t);
  if (!complex_.is_kept(t)) {
    return ways_ != Ways::PartingOnly && complex_.is_addable(t) ? (1 - inside) * volume : kInfinity;
  }
  if (ways_ == Ways::Covering || ways_ == Ways::JoiningOnly || (ways_ == Ways::All && complex_.is_held(t)))
    return kInfinity;
  return complex_.is_held(t) ? kHeldWeight * volume : kDropWeight * inside * volume;
}

std::vector<std::uint32_t> Mender::vertices_of(const std::vector<std::uint32_t>& tets) const {
  std::vector<std::uint32_t> vertices;
  for (const std::uint32_t t : tets)
    for (const std::uint32_t v : complex_.corners(t))
      if (std::find(vertices.begin(), vertices.end(), v) == vertices.end()) vertices.push_back(v);
  return vertices;
}

void Mender::flip(const std::vector<std::uint32_t>& tets) {
  for (const std::uint32_t t : tets) complex_.set_state(t, complex_.is_kept(t) ? 0 : 1);
}

/// Whether the tets would bridge a clear gap, though the vertex can be doubled instead.
bool Mender::is_thin_air(const std::vector<std::uint32_t>& tets) const {
  if (ways_ == Ways::Covering || !can_double_ || complex_.is_kept(tets[0])) return false;
  double inside = 0, volume = 0;
  for (const std::uint32_t t : tets) {
    inside += complex_.density(t) * complex_.volume(t);
    volume += complex_.volume(t);
  }
  return inside < kLeastBridge * volume;
}

/// By the vertices it mends. Where not all ways are open, what mends none may have to do.
double Mender::score(double cost, double mended) const {
  if (ways_ == Ways::JoiningOnly || ways_ == Ways::PartingOnly) return cost - mended * mean_volume_;
  return mended > 0 ? cost / mended : kInfinity;
}

/// Takes the flip as the best so far if it is. At first it may mend all bad vertices around, and one fewer for each
/// that turns out to be unsound with it.
void Mender::consider(const std::vector<std::uint32_t>& tets) {
  double cost = 0;
  for (const std::uint32_t t : tets) cost += cost_to_flip(t);
  if (!tets.empty() && complex_.is_kept(tets[0])) cost += parting_;
  if (tets.empty() || !std::isfinite(cost) || is_thin_air(tets)) return;
  const std::vector<std::uint32_t> vertices = vertices_of(tets);
  auto mended = std::count_if(vertices.begin(), vertices.end(), [&](std::uint32_t v) { return is_bad(v); });
  const auto found = [&] { return score(cost, static_cast<double>(mended)); };
  std::vector<std::uint8_t> states;
  for (const std::uint32_t t : tets) states.push_back(complex_.state(t));
  flip(tets);
  for (std::size_t i = 0; i < vertices.size() && found() < best_.score; ++i)
    if (!complex_.is_sound(vertices[i])) --mended;
  for (std::size_t i = 0; i < tets.size(); ++i) complex_.set_state(tets[i], states[i]);
  if (found() < best_.score) best_ = {tets, found()};
}

/// Whole pieces, fans and gaps around pinched edges, and the cheapest paths between pieces.
void Mender::consider_flips(const Star& star, std::uint32_t v) {
  const auto consider_piece = [&](const StarPiece& piece, std::size_t kept_pieces) {
    if (piece.kept ? kept_pieces > 1 : !piece.is_open) consider(piece.tets);
  };
  for (const StarPiece& piece : star.pieces()) consider_piece(piece, star.kept_pieces());
  for (const std::uint32_t w : star.pinched_edges())
    for (const StarPiece& piece : star.pieces_at_edge(w)) consider_piece(piece, 2);
  std::vector<double> costs;
  for (std::size_t m = 0; m < star.size(); ++m) costs.push_back(cost_to_flip(star.tet(m)));
  for (std::size_t p = 0; p < star.pieces().size(); ++p) consider(star.cheapest_path(p, costs));
  if (ways_ != Ways::PartingOnly) return;
  for (const std::uint32_t t : complex_.around(v))
    if (complex_.is_kept(t)) consider({t});
}

/// What it is to part the kept tets around a vertex that only touch there.
double Mender::cost_to_part(const Star& star) {
  std::size_t part = complex_.tet_count();
  for (const StarPiece& piece : star.pieces()) {
    if (!piece.kept) continue;
    const std::size_t other = parts_.find(piece.tets[0]);
    if (part != complex_.tet_count() && other != part) return mean_volume_ * kDoubleOtherPart;
    part = other;
  }
  return mean_volume_ * kDoubleSamePart;
}

void Mender::consider_doubling(const Star& star, std::uint32_t v) {
  double mended = 1;
  for (const StarPiece& piece : star.pieces())
    if (piece.kept && !complex_.is_sound_part(v, piece.tets[0])) mended -= 1;
  const double found = score(parting_, mended);
  if (found < best_.score) best_ = {{}, found};
}

void Mender::judge_again(const std::vector<std::uint32_t>& vertices) {
  for (const std::uint32_t v : vertices) {
    const std::uint8_t bad = complex_.is_sound(v) ? 0 : 1;
    if (bad > is_bad_[v]) new_bad_.push_back(v);
    is_bad_[v] = bad;
  }
}

void Mender::carry_out(std::uint32_t v) {
  std::vector<std::uint32_t> changed;
  if (best_.tets.empty()) {
    std::vector<std::uint32_t> around(complex_.around(v).begin(), complex_.around(v).end());
    report_.vertices_doubled += complex_.double_vertex(v);
    is_bad_.resize(complex_.vertex_count(), 0);
    changed = vertices_of(around);  // with the copies, which are corners now
    changed.push_back(v);
  } else {
    for (const std::uint32_t t : best_.tets) ++(complex_.is_kept(t) ? report_.tets_dropped : report_.tets_added);
    flip(best_.tets);
    for (const std::uint32_t t : best_.tets) join_part(t);
    changed = vertices_of(best_.tets);
  }
  judge_again(changed);
}

bool Mender::mend(std::uint32_t v, Ways ways) {
  ways_ = ways;
  best_ = {};
  const Star star(complex_, v);
  mean_volume_ = 0;
  for (std::size_t m = 0; m < star.size(); ++m) mean_volume_ += complex_.volume(star.tet(m));
  mean_volume_ /= static_cast<double>(star.size());
  can_double_ = star.kept_pieces() > 1;
  parting_ = can_double_ ? cost_to_part(star) : 0;
  if (ways == Ways::Covering) parting_ *= kDoubleCover;
  if (can_double_) consider_doubling(star, v);
  consider_flips(star, v);
  if (!std::isfinite(best_.score)) return false;
  carry_out(v);
  return true;
}

std::vector<std::uint32_t> find_bad(const TetComplex& complex, std::vector<std::uint8_t>& is_bad) {
  std::vector<std::uint32_t> bad;
  is_bad.assign(complex.vertex_count(), 0);
  for (std::uint32_t v = 0; v < complex.vertex_count(); ++v) {
    if (complex.is_sound(v)) continue;
    is_bad[v] = 1;
    bad.push_back(v);
  }
  return bad;
}

/// Edges at which tets merely touch, and vertices without such an edge.
std::size_t count_places(const TetComplex& complex, const std::vector<std::uint32_t>& bad) {
  std::size_t count = 0;
  for (const std::uint32_t v : bad) {
    const std::vector<std::uint32_t> ends = Star(complex, v).pinched_edges();
    count += ends.empty() ? 1 : static_cast<std::size_t>(ends.end() - std::upper_bound(ends.begin(), ends.end(), v));
  }
  return count;
}

/// Mends until none of the vertices is bad or none can be mended; returns those left.
std::vector<std::uint32_t> mend_all(Mender& mender, std::vector<std::uint32_t> bad, Ways ways, StageWatch& watch) {
  std::size_t repairs = 0;
  for (bool any = true; any;) {
    any = false;
    std::vector<std::uint32_t> left;
    for (const std::uint32_t v : bad) {
      while (mender.is_bad(v) && mender.mend(v, ways)) {
        any = true;
        if (++repairs % kWatchEvery == 0) watch.step(0);
      }
      if (mender.is_bad(v)) left.push_back(v);
    }
    const std::vector<std::uint32_t> fresh = mender.take_new_bad();
    left.insert(left.end(), fresh.begin(), fresh.end());
    std::sort(left.begin(), left.end());
    left.erase(std::unique(left.begin(), left.end()), left.end());
    bad = std::move(left);
  }
  std::erase_if(bad, [&](std::uint32_t v) { return !mender.is_bad(v); });
  return bad;
}

bool has_held(const TetComplex& complex, std::uint32_t v) {
  const auto tets = complex.around(v);
  return std::any_of(tets.begin(), tets.end(), [&](std::uint32_t t) { return complex.is_held(t); });
}

/// A face has two tets at most.
void drop_third_tets(TetComplex& complex, TopologyReport& report) {
  for (std::uint32_t t = 0; t < complex.tet_count(); ++t) {
    if (!complex.is_kept(t) || !complex.is_left_over(t)) continue;
    complex.set_state(t, 0);
    ++report.touching_mended;
    ++report.tets_dropped;
  }
}

}  // namespace

void mend_touching(TetComplex& complex, Ways ways, TopologyReport& report, StageWatch& watch) {
  drop_third_tets(complex, report);
  std::vector<std::uint8_t> is_bad;
  std::vector<std::uint32_t> bad = find_bad(complex, is_bad);
  if (bad.empty()) return;
  report.touching_mended += count_places(complex, bad);
  Mender mender(complex, std::move(is_bad), report);
  std::vector<std::uint32_t> to_join;
  if (ways != Ways::PartingOnly) {
    bad = mend_all(mender, std::move(bad), ways, watch);
    std::copy_if(bad.begin(), bad.end(), std::back_inserter(to_join),
                 [&](auto v) { return ways == Ways::Covering || has_held(complex, v); });
  }
  const auto left = mend_all(mender, std::move(to_join), Ways::JoiningOnly, watch);
  bad.insert(bad.end(), left.begin(), left.end());
  bad = mend_all(mender, std::move(bad), Ways::PartingOnly, watch);
  TETSOUP_ASSERT(bad.empty() && find_bad(complex, is_bad).empty());
}

}  // namespace tetsoup
