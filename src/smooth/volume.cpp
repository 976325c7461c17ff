#include "smooth/volume.h"

#include <algorithm>
#include <cmath>

namespace tetsoup {

namespace {

// Reach of the diffusion, as its time step in squared edges, and how often swept volume is given back. Measured after
// five passes of strength 1 (ball, torus, turned bar and plate, ball with stick; mean over them): a reach of 10 keeps
// the shape a little closer but a tenth more of the stair steps; 40, thrice, smooths no better and rounds plates and
// bars.
constexpr double kReach = 20;
constexpr int kRestorations = 2;
constexpr double kMaxPush = 0.5;        // Of a vertex's own size: beyond, a push extrapolates from a bent surface.
constexpr int kOffsetRounds = 12;       // Newton steps, each passing on what the round before could not place.
constexpr double kKeptExactly = 1e-7;   // Of a part's volume: about what float positions can express.
constexpr double kKept = 5e-5;          // Of a part's volume, half of what the header promises for the whole.
constexpr double kSmallestBlend = 0.1;  // Of the way from the start: below, a part stays where it began.

/// A way along the normal; longer ones than kMaxPush are cut, since they extrapolate from a bent surface.
Vec3d along_normal(const Vec3d& gradient, double way) {
  const double area = length(gradient);
  if (area == 0) return {};
  const double limit = kMaxPush * std::sqrt(area);
  return gradient * (std::clamp(way, -limit, limit) / area);
}

/// The last step: equal offsets along the normals of each part, until nothing is missing or nothing can move.
class VolumeKeeper {
 public:
  VolumeKeeper(const Connectivity& links, const std::vector<std::uint32_t>& part_of_tet,
               const std::vector<std::uint32_t>& part_of_vertex, std::vector<double> wanted, GuardedMesh& mesh)
      : links_(links),
        part_of_tet_(part_of_tet),
        part_of_vertex_(part_of_vertex),
        wanted_(std::move(wanted)),
        mesh_(mesh) {}

  /// What each part lacks, 0 where it is within `tolerance` of its volume.
  std::vector<double> missing(double tolerance) const {
    std::vector<double> lack = wanted_;
    for (std::size_t t = 0; t < part_of_tet_.size(); ++t) lack[part_of_tet_[t]] -= mesh_.volume(t);
    for (std::size_t p = 0; p < lack.size(); ++p) {
      if (std::abs(lack[p]) <= tolerance * wanted_[p]) lack[p] = 0;
    }
    return lack;
  }

  void offset_until_kept(StageWatch& watch) {
    std::vector<char> blocked(links_.boundary.size(), 0);
    for (int round = 0; round < kOffsetRounds; ++round) {
      const std::vector<double> lack = missing(kKeptExactly);
      if (std::all_of(lack.begin(), lack.end(), [](double volume) { return volume == 0; })) return;
      offset_once(lack, blocked, watch);
    }
  }

 private:
  void offset_once(const std::vector<double>& lack, std::vector<char>& blocked, StageWatch& watch) {
    const std::vector<Vec3d> gradients = volume_gradients(links_, mesh_);
    std::vector<double> area(lack.size(), 0.0);
    for (std::size_t i = 0; i < links_.boundary.size(); ++i) {
      if (!blocked[i]) area[part_of(i)] += length(gradients[i]);
    }
    for (std::size_t i = 0; i < links_.boundary.size(); ++i) {
      if (i % kVerticesPerStep == 0) watch.step(1);
      if (blocked[i] || lack[part_of(i)] == 0 || area[part_of(i)] == 0) continue;
      const std::uint32_t v = links_.boundary[i];
      const double way = lack[part_of(i)] / area[part_of(i)];
      if (!mesh_.move(v, mesh_.at(v) + along_normal(gradients[i], way))) blocked[i] = 1;
    }
  }
  std::uint32_t part_of(std::size_t i) const { return part_of_vertex_[links_.boundary[i]]; }

  const Connectivity& links_;
  const std::vector<std::uint32_t>&part_of_tet_, &part_of_vertex_;
  std::vector<double> wanted_;
  GuardedMesh& mesh_;
};

/// Puts the vertices of the parts with `share[part] < 1` so far along the way from their start to `smoothed`.
void blend_parts(const Connectivity& links, const std::vector<double>& share, const TetMesh& smoothed,
                 GuardedMesh& mesh) {
  for (std::uint32_t v = 0; v < smoothed.vertices.size(); ++v) {
    const double part_share = share[links.part_of_vertex[v]];
    if (part_share == 1 || links.tets[v].empty()) continue;
    const Vec3d start = mesh.start_of(v);
    mesh.place(v, to_float(start + (to_double(smoothed.vertices[v]) - start) * part_share));
  }
}

std::vector<char> unsound_parts(const Connectivity& links, const GuardedMesh& mesh) {
  std::vector<char> unsound(links.part_count, 0);
  for (std::size_t t = 0; t < links.part_of_tet.size(); ++t) {
    if (!mesh.is_sound(t)) unsound[links.part_of_tet[t]] = 1;
  }
  mesh.sheets().visit_crossings(mesh.mesh(), [&](std::uint32_t v, std::uint32_t triangle) {
    unsound[links.part_of_vertex[v]] = unsound[links.part_of_vertex[links.triangles[triangle][0]]] = 1;
  });
  return unsound;
}

}  // namespace

std::vector<Vec3d> volume_gradients(const Connectivity& links, const GuardedMesh& mesh) {
  std::vector<Vec3d> at_vertex(mesh.mesh().vertices.size());
  for (const auto& [a, b, c] : links.triangles) {
    const Vec3d share = cross(mesh.at(b) - mesh.at(a), mesh.at(c) - mesh.at(a)) * (1.0 / 6);
    for (const std::uint32_t v : {a, b, c}) at_vertex[v] += share;
  }
  std::vector<Vec3d> gradients;
  gradients.reserve(links.boundary.size());
  for (const std::uint32_t v : links.boundary) gradients.push_back(at_vertex[v]);
  return gradients;
}

void restore_swept_volume(const Connectivity& links, const GuardedMesh& mesh, const BoundaryFlow& flow,
                          std::vector<Vec3d>& targets) {
  const std::vector<Vec3d> gradients = volume_gradients(links, mesh);
  std::vector<double> areas, swept(targets.size());
  for (const Vec3d& gradient : gradients) areas.push_back(length(gradient));
  for (int round = 0; round < kRestorations; ++round) {
    for (std::size_t i = 0; i < targets.size(); ++i) {
      swept[i] = dot(targets[i] - mesh.start_of(links.boundary[i]), gradients[i]);
    }
    const std::vector<double> layer = flow.spread(swept, areas, kReach);
    for (std::size_t i = 0; i < targets.size(); ++i) targets[i] -= along_normal(gradients[i], layer[i]);
  }
}

void restore_total_volume(const Connectivity& links, GuardedMesh& mesh, StageWatch& watch) {
  std::vector<double> wanted(links.part_count);
  for (std::size_t t = 0; t < links.part_of_tet.size(); ++t) wanted[links.part_of_tet[t]] += mesh.start_volume(t);
  VolumeKeeper keeper(links, links.part_of_tet, links.part_of_vertex, std::move(wanted), mesh);
  const TetMesh smoothed = mesh.mesh();
  std::vector<double> share(links.part_count, 1.0);
  for (;;) {
    mesh.look_around(watch);
    keeper.offset_until_kept(watch);
    const std::vector<double> lack = keeper.missing(kKept);
    std::vector<char> failed = unsound_parts(links, mesh);
    bool any_failed = false;
    for (std::size_t p = 0; p < share.size(); ++p) {
      if (share[p] == 0 || (lack[p] == 0 && !failed[p])) continue;
      share[p] = share[p] / 2 < kSmallestBlend ? 0 : share[p] / 2;
      any_failed = true;
    }
    if (!any_failed) return;
    blend_parts(links, share, smoothed, mesh);
  }
}

void approach_volume(const Connectivity& links, double wanted, GuardedMesh& mesh, StageWatch& watch) {
  const std::vector<std::uint32_t> of_tet(links.part_of_tet.size(), 0), of_vertex(links.part_of_vertex.size(), 0);
  VolumeKeeper(links, of_tet, of_vertex, {wanted}, mesh).offset_until_kept(watch);
}

}  // namespace tetsoup
