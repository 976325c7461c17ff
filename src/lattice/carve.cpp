#include "lattice/carve.h"

#include <algorithm>
#include <array>
#include <functional>
#include <queue>
#include <utility>
#include <vector>

#include "lattice/mend_touching.h"
#include "lattice/reach.h"

namespace tetsoup {
namespace {

constexpr double kSliver = 0.25;  ///< Of a tet.
constexpr double kCrumb = 3;      ///< Voxels.
/// Of the fullest tet around, where none is dense: what holds so much stays, since no tet there can hold more.
/// Elsewhere `dense` itself is taken of the fullest. Without it a plate, which has no hole to lose, is carved from its
/// rim into strings.
constexpr double kOfFullest = 0.5;

class Carver {
 public:
  /// Tets that hold at least `limit`, and that share of the fullest around, stay; those that hold a volume of `crumb`
  /// are not alone by an accident.
  Carver(TetComplex& complex, double limit, double of_fullest, Reach reach, double crumb)
      : complex_(complex),
        limit_(limit),
        of_fullest_(of_fullest),
        crumb_(crumb),
        reach_(std::move(reach)),
        open_faces_(complex.vertex_count(), 0),
        is_queued_(complex.tet_count(), 0) {
    for (std::uint32_t t = 0; t < complex.tet_count(); ++t)
      for (std::size_t i = 0; i < 4 && complex.is_kept(t); ++i)
        if (!complex.is_kept(complex.neighbour(t, i))) count_face(t, i, 1);
    find_fullest();
  }

  void run(StageWatch& watch) {
    constexpr std::size_t kWatchEvery = 1024;  // tets
    std::size_t removed = 0;
    for (std::uint32_t t = 0; t < complex_.tet_count(); ++t) enqueue(t);
    while (!queue_.empty()) {
      const std::uint32_t t = queue_.top().second;
      queue_.pop();
      is_queued_[t] = 0;
      if (!is_crumb(t) && (!is_disc(t) || !leaves_cover(t))) continue;
      remove(t);
      if (++removed % kWatchEvery == 0) watch.step(0);
    }
  }

 private:
  void count_face(std::uint32_t t, std::size_t face, int by) {
    for (std::size_t k = 0; k < 4; ++k)
      if (k != face) open_faces_[complex_.corners(t)[k]] += by;
  }

  /// Of every vertex, the density of the fullest tet at it.
  void find_fullest() {
    fullest_.assign(complex_.vertex_count(), 0);
    for (std::uint32_t t = 0; t < complex_.tet_count(); ++t)
      for (std::size_t i = 0; i < 4 && complex_.is_kept(t); ++i) {
        float& most = fullest_[complex_.corners(t)[i]];
        most = std::max(most, static_cast<float>(complex_.density(t)));
      }
  }
  /// Whether a tet is as full as can be expected there.
  bool is_full(std::uint32_t t) const {
    double most = 0;
    for (const std::uint32_t v : complex_.corners(t)) most = std::max(most, static_cast<double>(fullest_[v]));
    return complex_.density(t) >= (most < limit_ ? of_fullest_ * most : limit_);
  }

  void enqueue(std::uint32_t t) {
    if (!complex_.is_kept(t) || complex_.is_held(t) || is_queued_[t] || (is_full(t) && !is_alone(t))) return;
    is_queued_[t] = 1;
    queue_.push({complex_.density(t), t});
  }

  /// Whether the tet meets the boundary of the mesh in a disc: one face, and the corner opposite is inside; two, and
  /// the edge between the other two is; or three. One that
  /// stands alone goes with what it holds.
  bool is_disc(std::uint32_t t) const {
    std::array<std::size_t, 4> open{};
    std::size_t count = 0;
    for (std::size_t i = 0; i < 4; ++i)
      if (!complex_.is_kept(complex_.neighbour(t, i))) open[count++] = i;
    if (count == 1) return open_faces_[complex_.corners(t)[open[0]]] == 0;
    if (count == 2) return is_inside_edge(t, open[0], open[1]);
    return count >= 3;
  }

  /// Whether a walk around the edge between two corners of a tet, from kept tet to kept tet, comes back.
  bool is_inside_edge(std::uint32_t start, std::size_t i, std::size_t j) const {
    const std::uint32_t a = complex_.corners(start)[i], b = complex_.corners(start)[j];
    const auto third = [&](std::uint32_t t, std::uint32_t but) {
      const Tet& tet = complex_.corners(t);
      return *std::find_if(tet.begin(), tet.end(), [&](std::uint32_t v) { return v != a && v != b && v != but; });
    };
    std::uint32_t t = start, left = third(start, a);  // the next tet lies behind the face without this corner
    for (;;) {
      const std::uint32_t next = complex_.neighbour(t, corner_of(complex_.corners(t), left));
      if (next == start) return true;
      if (!complex_.is_kept(next)) return false;
      left = third(t, left);  // which the next tet has too
      t = next;
    }
  }

  bool is_alone(std::uint32_t t) const {
    for (std::size_t i = 0; i < 4; ++i)
      if (complex_.is_kept(complex_.neighbour(t, i))) return false;
    return true;
  }

  /// A tet that stands alone for a voxel or two.
  bool is_crumb(std::uint32_t t) const { return is_alone(t) && complex_.density(t) * complex_.volume(t) < crumb_; }

  /// Whether what the tet holds, and what was left to it, stays near the mesh without it.
  bool leaves_cover(std::uint32_t t) const {
    if (complex_.density(t) > 0 && reach_.count[t] == 0) return false;
    const auto served = reach_.served[t];
    return std::all_of(served.begin(), served.end(),
                       [&](std::uint32_t n) { return complex_.is_kept(n) || reach_.count[n] > 1; });
  }

  void remove(std::uint32_t t) {
    complex_.set_state(t, 0);
    for (const std::uint32_t n : reach_.served[t]) --reach_.count[n];
    for (std::size_t i = 0; i < 4; ++i) count_face(t, i, complex_.is_kept(complex_.neighbour(t, i)) ? 1 : -1);
    // Only behind its faces may a tet have become one that can go.
    for (std::size_t i = 0; i < 4; ++i)
      if (const std::uint32_t n = complex_.neighbour(t, i); complex_.is_kept(n)) enqueue(n);
  }

  using Entry = std::pair<float, std::uint32_t>;

  TetComplex& complex_;
  double limit_, of_fullest_;
  double crumb_;  ///< Volume.
  Reach reach_;
  std::vector<float> fullest_;
  std::vector<int> open_faces_;  ///< Of every vertex: faces of the boundary at it.
  std::vector<std::uint8_t> is_queued_;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;  ///< The emptiest first.
};

/// A volume of a few voxels, or less where no tet holds so much.
double crumb_in(const TetComplex& complex, const BitGrid& body) {
  const double h = body.frame.voxel_size;
  double most = 0;
  for (std::uint32_t t = 0; t < complex.tet_count(); ++t)
    if (complex.is_kept(t)) most = std::max(most, complex.density(t) * complex.volume(t));
  return std::min(most, kCrumb * h * h * h);
}

}  // namespace

void trim_slivers(Candidates& candidates, double dense, const BitGrid& body, StageWatch& watch) {
  const double limit = std::min(kSliver, dense);
  TetComplex complex(candidates);
  Carver(complex, limit, 1, find_reach(complex, {limit, dense}, body, watch), 0).run(watch);
}

std::size_t carve(Candidates& candidates, double dense, const BitGrid& body, TopologyReport& report,
                  StageWatch& watch) {
  TetComplex complex(candidates);
  mend_touching(complex, Ways::Covering, report, watch);
  Carver(complex, dense, kOfFullest, find_reach(complex, {dense, 0}, body, watch), crumb_in(complex, body)).run(watch);
  std::size_t left = 0;
  for (std::uint32_t t = 0; t < complex.tet_count(); ++t) {
    if (!complex.is_kept(t)) continue;
    const bool is_thin = complex.density(t) < dense;
    if (!complex.is_held(t)) complex.set_state(t, is_thin ? kHeld : std::uint8_t{1});
    left += is_thin;
  }
  return left;
}

}  // namespace tetsoup
