#include "lattice/cover.h"

#include <algorithm>
#include <limits>

#include "lattice/tet_locator.h"

namespace tetsoup {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// The tet to keep for a point, or kNone if one is kept.
std::uint32_t enclosing_tet(const Candidates& candidates, const TetLocator& locator, const Vec3d& point) {
  std::uint32_t best = kNone;
  bool is_enclosed = false;
  locator.visit_holders(point, [&](std::uint32_t t) {
    is_enclosed = is_enclosed || candidates.kept[t];
    if (best == kNone || candidates.density[t] > candidates.density[best]) best = t;
  });
  return is_enclosed ? kNone : best;
}

}  // namespace

std::size_t keep_enclosing_tets(Candidates& candidates, std::span<const Vec3> points, StageWatch& watch) {
  constexpr std::int64_t kGrain = 1024;  // points
  const TetLocator locator(candidates.mesh);
  std::vector<std::uint32_t> tets(points.size(), kNone);
  parallel_for(static_cast<std::int64_t>(points.size()), kGrain, watch, [&](std::int64_t begin, std::int64_t end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i)
      tets[i] = enclosing_tet(candidates, locator, to_double(points[i]));
  });
  std::size_t count = 0;
  for (const std::uint32_t t : tets) {
    if (t == kNone || candidates.kept[t]) continue;
    candidates.kept[t] = 1;
    ++count;
  }
  return count;
}

void keep_inside_tets(Candidates& candidates) {
  if (candidates.density.empty()) return;
  const float most = *std::max_element(candidates.density.begin(), candidates.density.end());
  for (std::size_t t = 0; t < candidates.kept.size(); ++t) candidates.kept[t] = candidates.density[t] >= most;
}

}  // namespace tetsoup
