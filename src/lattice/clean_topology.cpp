#include "lattice/clean_topology.h"

#include <algorithm>

#include "base/require.h"
#include "base/unions.h"
#include "base/vec.h"
#include "lattice/boundary_only.h"
#include "lattice/mend_touching.h"
#include "lattice/tet_complex.h"

namespace tetsoup {
namespace {

constexpr int kMostRounds = 8;  ///< Of filling bubbles and mending before mending may add no more tets.
/// Lattice edges, across: held tets that stand alone in a smaller heap are what a stray voxel left.
constexpr double kSpeck = 2.5;

/// Of a component: what drop_parts() asks.
struct Part {
  double volume = 0;
  bool is_held = false;
  Vec3d lo{1e300, 1e300, 1e300}, hi{-1e300, -1e300, -1e300};
};

/// By the component's first tet.
std::vector<Part> parts_of(const TetComplex& complex, Unions& sets) {
  std::vector<Part> parts(complex.tet_count());
  for (std::uint32_t t = 0; t < complex.tet_count(); ++t) {
    if (!complex.is_kept(t)) continue;
    Part& part = parts[sets.find(t)];
    part.volume += complex.volume(t);
    part.is_held = part.is_held || complex.is_held(t);
    for (const std::uint32_t v : complex.corners(t)) {
      part.lo = min(part.lo, to_double(complex.mesh().vertices[v]));
      part.hi = max(part.hi, to_double(complex.mesh().vertices[v]));
    }
  }
  return parts;
}

/// Components, joined through faces, below `min_part` of the volume; the largest stays, and those with a held tet
/// unless they are specks.
void drop_parts(TetComplex& complex, double min_part, TopologyReport& report) {
  Unions sets(complex.tet_count());
  for (std::uint32_t t = 0; t < complex.tet_count(); ++t) {
    if (!complex.is_kept(t)) continue;
    for (std::size_t i = 0; i < 4; ++i)
      if (const std::uint32_t n = complex.neighbour(t, i); n < t && complex.is_kept(n)) sets.join(n, t);
  }
  const std::vector<Part> parts = parts_of(complex, sets);
  double whole = 0;
  for (const Part& part : parts) whole += part.volume;
  const double speck = kSpeck * lattice_edge(complex.mesh());
  const auto largest = static_cast<std::size_t>(
      std::max_element(parts.begin(), parts.end(), [](const Part& a, const Part& b) { return a.volume < b.volume; }) -
      parts.begin());
  const auto is_small = [&](std::size_t i) {
    const Part& part = parts[i];
    return i != largest && part.volume < min_part * whole && (!part.is_held || length(part.hi - part.lo) < speck);
  };
  for (std::uint32_t t = 0; t < complex.tet_count(); ++t) {
    const std::size_t part = sets.find(t);
    if (!complex.is_kept(t) || !is_small(part)) continue;
    if (part == t) {
      ++report.parts_dropped;
      report.dropped_volume += parts[part].volume;
    }
    complex.set_state(t, 0);
  }
}

/// Absent tets that faces join to `start`; empty if they lead to where nothing is listed, which may be outside.
std::vector<std::uint32_t> enclosed_void(const TetComplex& complex, std::uint32_t start,
                                         std::vector<std::uint8_t>& is_seen) {
  std::vector<std::uint32_t> tets{start};
  is_seen[start] = 1;
  bool is_open = false;
  for (std::size_t next = 0; next < tets.size(); ++next) {
    const std::uint32_t t = tets[next];
    for (std::size_t i = 0; i < 4; ++i) {
      const std::uint32_t n = complex.neighbour(t, i);
      is_open = is_open || n == kNoTet;
      if (n == kNoTet || is_seen[n] || complex.is_kept(n)) continue;
      is_seen[n] = 1;
      tets.push_back(n);
    }
  }
  if (is_open) tets.clear();
  return tets;
}

/// Fills the voids that are candidates altogether. A larger one has an inside of which nothing is known: it stays.
bool fill_bubbles(TetComplex& complex, TopologyReport& report) {
  std::vector<std::uint8_t> is_seen(complex.tet_count(), 0);
  bool any = false;
  for (std::uint32_t t = 0; t < complex.tet_count(); ++t) {
    if (is_seen[t] || complex.is_kept(t)) continue;
    const std::vector<std::uint32_t> bubble = enclosed_void(complex, t, is_seen);
    if (bubble.empty()) continue;
    for (const std::uint32_t b : bubble) complex.set_state(b, 1);
    ++report.bubbles_filled;
    report.bubble_tets += bubble.size();
    any = true;
  }
  return any;
}

/// Mending may close a void, and filling one may bring tets together. Dropping and doubling close none: every tet that
/// is dropped has a face that is on the boundary already, so the last rounds end.
void mend_and_fill(TetComplex& complex, const TopologyOptions& options, TopologyReport& report, StageWatch& watch) {
  for (int round = 0;; ++round) {
    const bool filled = options.bubbles == Bubbles::Fill && fill_bubbles(complex, report);
    if (round > 0 && !filled) return;
    if (options.touching == Touching::Leave) return;
    watch.step(0);  // reports nothing new, but notices cancellation
    mend_touching(complex, round < kMostRounds ? Ways::All : Ways::PartingOnly, report, watch);
  }
}

}  // namespace

TopologyReport clean_topology(Candidates& candidates, const TopologyOptions& options, StageWatch& watch) {
  require(options.min_part >= 0 && options.min_part < 1, "min_part", options.min_part, "at least 0 and below 1");
  TopologyReport report;
  {
    TetComplex complex(candidates);
    mend_and_fill(complex, options, report, watch);
    if (options.boundary_only == BoundaryOnly::Remove) remove_boundary_only(complex, report);
    drop_parts(complex, options.min_part, report);
  }
  if (options.boundary_only == BoundaryOnly::Split) split_boundary_only(candidates, report);
  return report;
}

}  // namespace tetsoup
