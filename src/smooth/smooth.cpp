#include "tetsoup/smooth.h"

#include <bit>
#include <cmath>
#include <numbers>
#include <string>

#include "base/bits.h"
#include "base/parallel.h"
#include "base/require.h"
#include "base/tet_faces.h"
#include "smooth/connectivity.h"
#include "smooth/draw.h"
#include "smooth/fairing.h"
#include "smooth/fit.h"
#include "smooth/guard.h"
#include "smooth/volume.h"

namespace tetsoup {

namespace {

constexpr int kInteriorSweeps = 2;       // A pass moves the boundary by a fraction of an edge; the effect decays fast.
constexpr double kParting = 0.2;         // Of the way to the mean of its neighbours.
constexpr double kShareOfPasses = 0.95;  // Of the stage's time; the rest goes into the total volume.

void check(const SmoothOptions& options) {
  require(options.passes >= 0 && options.passes <= 1000, "passes", options.passes, "0 to 1000");
  require(options.strength > 0 && std::isfinite(options.strength), "strength", options.strength, "above 0 and finite");
  require(options.min_dihedral >= 0 && options.min_dihedral < std::numbers::pi / 3, "min_dihedral",
          options.min_dihedral, "at least 0 and below pi / 3 radians");
  require(options.max_dihedral >= std::numbers::pi / 2 && options.max_dihedral <= std::numbers::pi, "max_dihedral",
          options.max_dihedral, "pi / 2 to pi radians");
  require(options.max_edge_ratio >= 1, "max_edge_ratio", options.max_edge_ratio, "1 or more");
}

void check(const TetMesh& mesh) {
  const auto name = [](std::size_t t) { return "mesh.tets[" + std::to_string(t) + "]"; };
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const Tet& tet = mesh.tets[t];
    if (!is_valid_tet(tet, mesh.vertices.size())) require(false, name(t), "invalid", "four different vertices");
    const double volume = signed_volume(corners_of(mesh, tet));
    if (!(volume > 0) || !std::isfinite(volume)) require(false, name(t) + " volume", volume, "above 0 and finite");
  }
}

std::vector<Vec3d> fair_boundary(const Connectivity& links, const GuardedMesh& mesh, const BoundaryFlow& flow,
                                 double strength) {
  std::vector<Vec3d> targets;
  targets.reserve(links.boundary.size());
  for (const std::uint32_t v : links.boundary) targets.push_back(mesh.at(v));
  const std::vector<Vec3d> moves = flow.fair(targets, strength);
  for (std::size_t i = 0; i < targets.size(); ++i) targets[i] += moves[i];
  return targets;
}

void move_boundary(const Connectivity& links, const std::vector<Vec3d>& targets, GuardedMesh& mesh, StageWatch& watch) {
  for (std::size_t i = 0; i < targets.size(); ++i) {
    if (i % kVerticesPerStep == 0) watch.step(0.5 * static_cast<double>(i) / static_cast<double>(targets.size()));
    mesh.move(links.boundary[i], targets[i]);
  }
}

/// Gauss-Seidel towards the harmonic positions, the boundary held.
void relax_interior(const Connectivity& links, GuardedMesh& mesh, StageWatch& watch) {
  for (int sweep = 0; sweep < kInteriorSweeps; ++sweep) {
    for (std::size_t i = 0; i < links.interior.size(); ++i) {
      if (i % kVerticesPerStep == 0) watch.step(0.5 + 0.5 * sweep / kInteriorSweeps);
      const std::uint32_t v = links.interior[i];
      Vec3d offset;
      for (const std::uint32_t neighbour : links.neighbours[v]) offset += mesh.at(neighbour) - mesh.at(v);
      mesh.move(v, mesh.at(v) + offset * (1 / static_cast<double>(links.neighbours[v].size())));
    }
  }
}

/// The centres of the outside voxels that have an inside one among their 26 neighbours.
void add_outer_shell(const BitGrid& inside, std::vector<Vec3>& points) {
  const GridFrame& frame = inside.frame;
  const BitRows rows(inside);
  for (int z = 0; z < frame.size[2]; ++z) {
    for (int y = 0; y < frame.size[1]; ++y) {
      for (std::size_t w = 0; w < inside.words_per_row; ++w) {
        for (std::uint64_t shell = rows.grown(y, z, w) & ~rows.at(y, z)[w]; shell != 0; shell &= shell - 1) {
          const auto x = static_cast<double>(64 * w + static_cast<std::size_t>(std::countr_zero(shell)));
          points.push_back(
              to_float(frame.origin + Vec3d{x, static_cast<double>(y), static_cast<double>(z)} * frame.voxel_size));
        }
      }
    }
  }
}

/// Copies of a vertex part, each towards its own tets: sheets that touch are none that a move could take for one.
void pull_apart(const Connectivity& links, GuardedMesh& mesh, StageWatch& watch) {
  mesh.look_around(watch);
  for (const std::uint32_t v : mesh.sheets().doubled()) {
    Vec3d offset;
    for (const std::uint32_t neighbour : links.neighbours[v]) offset += mesh.at(neighbour) - mesh.at(v);
    mesh.move(v, mesh.at(v) + offset * (kParting / static_cast<double>(links.neighbours[v].size())));
  }
}

/// Fairing passes, and the volume put right.
void fair(const Connectivity& links, const SmoothOptions& options, GuardedMesh& mesh, StageWatch& watch) {
  const BoundaryFlow flow(links);
  for (int pass = 0; pass < options.passes; ++pass) {
    watch.enter_part(kShareOfPasses * pass / options.passes, kShareOfPasses * (pass + 1) / options.passes);
    std::vector<Vec3d> targets = fair_boundary(links, mesh, flow, options.strength);
    restore_swept_volume(links, mesh, flow, targets);
    mesh.look_around(watch);
    move_boundary(links, targets, mesh, watch);
    relax_interior(links, mesh, watch);
  }
  watch.enter_part(kShareOfPasses, 1);
  mesh.look_around(watch);
  if (!mesh.has_sided_points()) return restore_total_volume(links, mesh, watch);
  double volume = 0;
  for (std::size_t t = 0; t < mesh.mesh().tets.size(); ++t) volume += mesh.start_volume(t);
  approach_volume(links, volume, mesh, watch);
}

SmoothReport report_on(const Connectivity& links, const GuardedMesh& mesh, int passes) {
  SmoothReport report;
  report.passes = passes;
  report.boundary_vertices = links.boundary.size();
  report.shortened_moves = mesh.shortened_moves();
  report.min_dihedral = mesh.min_dihedral();
  for (std::size_t t = 0; t < mesh.mesh().tets.size(); ++t) {
    report.volume_before += mesh.start_volume(t);
    report.volume_after += mesh.volume(t);
  }
  report.volume_wanted = report.volume_before;
  for (const std::uint32_t v : links.boundary) {
    double before = 0, after = 0;
    for (const std::uint32_t tet : links.tets[v]) before += mesh.start_volume(tet), after += mesh.volume(tet);
    report.boundary_volume_ratio.push_back(static_cast<float>(after / before));
  }
  return report;
}

}  // namespace

SmoothResult smooth_tets(const TetMesh& mesh, const SmoothOptions& options, const Progress& progress) {
  return smooth_tets(mesh, SmoothTarget{}, options, progress);
}

SmoothResult smooth_tets(const TetMesh& mesh, const SmoothTarget& target, const SmoothOptions& options,
                         const Progress& progress) {
  check(options);
  StageWatch watch(progress, "smooth");
  check(mesh);
  const Connectivity links = connect(mesh);
  std::vector<Vec3> sided = pulled_inside(target.enclosed, mesh);
  if (target.stay == Stay::WithinVolume && target.inside != nullptr) add_outer_shell(*target.inside, sided);
  GuardedMesh moving(mesh, links, {options.min_dihedral, options.max_dihedral, options.max_edge_ratio}, sided);
  if (options.passes > 0) pull_apart(links, moving, watch);
  const bool snaps = options.snap == Snap::Surface && target.inside != nullptr && options.passes > 0;
  if (!snaps) {
    fair(links, options, moving, watch);
    return {moving.mesh(), report_on(links, moving, options.passes)};
  }
  const double wanted = fit_to_surface(links, target, options.passes, moving, watch);
  SmoothReport report = report_on(links, moving, options.passes);
  report.snapped = true;
  report.volume_wanted = wanted;
  return {moving.mesh(), std::move(report)};
}

TetMesh draw_faces(const TetMesh& mesh, std::span<const FaceAim> aims, const SmoothOptions& options,
                   const Progress& progress) {
  check(options);
  StageWatch watch(progress, "smooth");
  check(mesh);
  const Connectivity links = connect(mesh);
  GuardedMesh moving(mesh, links, {options.min_dihedral, options.max_dihedral, options.max_edge_ratio});
  moving.look_around(watch);
  draw(links, aims, moving, watch);
  return moving.mesh();
}

}  // namespace tetsoup
