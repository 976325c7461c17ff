#include "embed/tet_walk.h"

#include <algorithm>

#include "base/tet_faces.h"

namespace tetsoup {
namespace {

/// Mean edges of the mesh: tets around the ends of a line are within, the far side of a thin part is not.
constexpr double kReach = 1;

double mean_edge(const TetMesh& mesh) {
  double sum = 0;
  for (const Tet& tet : mesh.tets) {
    const TetCorners p = corners_of(mesh, tet);
    for (const auto& [i, j] : kTetEdges) sum += length(p[static_cast<std::size_t>(i)] - p[static_cast<std::size_t>(j)]);
  }
  return sum / (6 * static_cast<double>(mesh.tets.size()));
}

}  // namespace

TetWalk::TetWalk(const TetMesh& mesh) : mesh_(mesh), reach_(kReach * mean_edge(mesh)), seen_(mesh.tets.size(), 0) {
  neighbours_.assign(mesh.tets.size(), {kNone, kNone, kNone, kNone});
  const std::vector<TetFace> faces = sorted_faces(mesh);
  for (std::size_t i = 1; i < faces.size(); ++i) {
    if (faces[i].corners != faces[i - 1].corners) continue;
    const std::uint64_t a = faces[i - 1].slot, b = faces[i].slot;
    neighbours_[a / 4][a % 4] = static_cast<std::uint32_t>(b / 4);
    neighbours_[b / 4][b % 4] = static_cast<std::uint32_t>(a / 4);
  }
}

bool TetWalk::is_near(std::uint32_t tet, const Vec3d& begin, const Vec3d& end) const {
  const TetCorners p = corners_of(mesh_, mesh_.tets[tet]);
  const Vec3d centre = (p[0] + p[1] + p[2] + p[3]) * 0.25, along = end - begin;
  const double square = squared_length(along);
  const double t = square > 0 ? std::clamp(dot(centre - begin, along) / square, 0.0, 1.0) : 0;
  return squared_length(centre - begin - along * t) <= reach_ * reach_;
}

template <class Visit>
void TetWalk::walk(std::uint32_t from, const Vec3d& begin, const Vec3d& end, const Visit& visit) {
  seen_[from] = ++walks_;
  queue_.assign(1, from);
  for (std::size_t next = 0; next < queue_.size(); ++next) {
    if (visit(queue_[next])) return;
    for (const std::uint32_t tet : neighbours_[queue_[next]]) {
      if (tet == kNone || seen_[tet] == walks_ || !is_near(tet, begin, end)) continue;
      seen_[tet] = walks_;
      queue_.push_back(tet);
    }
  }
}

bool TetWalk::leads(std::uint32_t from, std::uint32_t to, const Vec3d& begin, const Vec3d& end) {
  if (share_a_vertex(mesh_.tets[from], mesh_.tets[to])) return true;
  bool found = false;
  walk(from, begin, end, [&](std::uint32_t tet) { return found = tet == to; });
  return found;
}

std::uint32_t TetWalk::best_at_end(std::uint32_t from, const Vec3d& begin, const Vec3d& end) {
  std::uint32_t best = from;
  double least = least_weight(corners_of(mesh_, mesh_.tets[from]), end);
  walk(from, begin, end, [&](std::uint32_t tet) {
    const double w = least_weight(corners_of(mesh_, mesh_.tets[tet]), end);
    if (w > least) best = tet, least = w;
    return false;
  });
  return best;
}

}  // namespace tetsoup
