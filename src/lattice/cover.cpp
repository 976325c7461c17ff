#include "lattice/cover.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "base/tet_locator.h"

namespace tetsoup {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// The tet that is to hold a point: a kept one if it can, or kNone if there is none at all.
std::uint32_t holder_of(const Candidates& candidates, const TetLocator& locator, const Vec3d& point) {
  std::uint32_t best = kNone;
  locator.visit_holders(point, [&](std::uint32_t t) {
    const auto rank = [&](std::uint32_t tet) { return std::pair(candidates.kept[tet] != 0, candidates.density[tet]); };
    if (best == kNone || rank(t) > rank(best)) best = t;
  });
  return best;
}

/// Of every point, as holder_of().
std::vector<std::uint32_t> holders_of(const Candidates& candidates, std::span<const Vec3> points, StageWatch& watch) {
  constexpr std::int64_t kGrain = 1024;  // points
  const TetLocator locator(candidates.mesh);
  std::vector<std::uint32_t> tets(points.size(), kNone);
  parallel_for(static_cast<std::int64_t>(points.size()), kGrain, watch, [&](std::int64_t begin, std::int64_t end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i)
      tets[i] = holder_of(candidates, locator, to_double(points[i]));
  });
  std::erase(tets, kNone);
  return tets;
}

}  // namespace

void keep_cover(Candidates& candidates) {
  for (std::size_t t = 0; t < candidates.kept.size(); ++t) candidates.kept[t] = candidates.density[t] > 0;
}

std::size_t keep_enclosing_tets(Candidates& candidates, std::span<const Vec3> points, StageWatch& watch) {
  std::size_t count = 0;
  for (const std::uint32_t t : holders_of(candidates, points, watch)) {
    count += candidates.kept[t] == 0;
    candidates.kept[t] = kHeld;
  }
  return count;
}

std::size_t enclose_apart(Candidates& candidates, std::span<const Vec3> points, StageWatch& watch) {
  std::vector<std::uint32_t> tets = holders_of(candidates, points, watch);
  std::erase_if(tets, [&](std::uint32_t t) { return candidates.kept[t] != 0; });
  std::sort(tets.begin(), tets.end());
  tets.erase(std::unique(tets.begin(), tets.end()), tets.end());
  TetMesh& mesh = candidates.mesh;
  for (const std::uint32_t t : tets) {
    Tet copy = mesh.tets[t];
    for (std::uint32_t& v : copy) {
      mesh.vertices.push_back(Vec3(mesh.vertices[v]));
      v = static_cast<std::uint32_t>(mesh.vertices.size() - 1);
    }
    mesh.tets.push_back(copy);
    candidates.density.push_back(candidates.density[t]);
    candidates.kept.push_back(kHeld);
  }
  return tets.size();
}

void keep_inside_tets(Candidates& candidates) {
  if (candidates.density.empty()) return;
  const float most = *std::max_element(candidates.density.begin(), candidates.density.end());
  std::size_t count = 0;
  for (std::size_t t = 0; t < candidates.kept.size(); ++t) {
    if (candidates.density[t] < most) continue;
    candidates.mesh.tets[count] = candidates.mesh.tets[t];
    candidates.density[count++] = candidates.density[t];
  }
  candidates.mesh.tets.resize(count);
  candidates.density.resize(count);
  candidates.kept.assign(count, 1);
}

}  // namespace tetsoup
