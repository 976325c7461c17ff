#include "smooth/fit.h"

#include <cmath>
#include <optional>

#include "base/bits.h"
#include "smooth/aims.h"
#include "smooth/draw.h"
#include "smooth/planes.h"
#include "smooth/relax.h"
#include "smooth/volume.h"

namespace tetsoup {

namespace {

constexpr double kReach = 0.5;  // Mean edges: half a tet is what density leaves or lacks.
// Of the inside voxels' volume: a mesh that differs by more does not follow them (a sheet whose tets were kept for the
// soup in them, thin parts of a plate), and its volume is left to the fit, unless that takes too much of it.
constexpr double kNear = 0.1, kLacking = 0.2;
constexpr double kNearPlane = 1.5;       // Voxels, from where they change to the plane of the soup that made them.
constexpr double kShareOfPasses = 0.95;  // Of the stage's time; the rest goes into the volume.

double volume_of(const GuardedMesh& mesh) {
  double sum = 0;
  for (std::size_t t = 0; t < mesh.mesh().tets.size(); ++t) sum += mesh.volume(t);
  return sum;
}

double volume_of(const BitGrid& inside) {
  std::size_t count = 0;
  for (const std::uint64_t word : inside.words) {
    if (word != 0) count += bit_count(word);
  }
  const double size = inside.frame.voxel_size;
  return static_cast<double>(count) * size * size * size;
}

double boundary_area(const Connectivity& links, const GuardedMesh& mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : links.triangles) {
    sum += length(cross(mesh.at(b) - mesh.at(a), mesh.at(c) - mesh.at(a))) / 2;
  }
  return sum;
}

}  // namespace

double fit_to_surface(const Connectivity& links, const SmoothTarget& target, int passes, GuardedMesh& mesh,
                      StageWatch& watch) {
  const BitGrid& inside = *target.inside;
  const double edge = mean_edge(links, mesh), counted = volume_of(inside), wanted = target.volume.value_or(counted);
  const bool follows = std::abs(volume_of(mesh) - counted) < kNear * counted;
  const auto lack = [&] {
    const double volume = wanted - volume_of(mesh);
    const bool is_taken = target.stay == Stay::Free && volume > 0 && volume < kLacking * wanted;
    return follows || is_taken ? volume : 0;
  };
  double level = (wanted - counted) / boundary_area(links, mesh);
  std::optional<SoupPoints> points;
  std::optional<PlaneFit> planes;
  if (target.soup != nullptr) {
    points.emplace(*target.soup, links, mesh.mesh(), edge, watch);
    planes.emplace(*target.soup, links, edge, watch);
  }
  for (int pass = 0; pass < passes; ++pass) {
    watch.enter_part(kShareOfPasses * pass / passes, kShareOfPasses * (pass + 1) / passes);
    const std::vector<Vec3d> normals = unit_normals(links, mesh);
    BoundaryAims aims{aim_at_surface(links, mesh, normals, inside, kReach * edge, level, watch), {}, {}};
    // The lattice's triangles face anywhere; after one pass they tell which plane is theirs.
    if (planes && pass > 0) {
      aims.creased = planes->lay(mesh, kNearPlane * inside.frame.voxel_size, level, aims.triangles, watch);
    }
    if (points) aims.pulls = points->pulls(links, mesh.mesh(), normals, watch);
    mesh.look_around(watch);
    relax(links, aims, edge, pass % 2 == 0 ? Sweep::Forwards : Sweep::Backwards, mesh, watch);
    // Chords and what blunts edges take volume: the next pass aims as far outside as gives it back.
    level += lack() / boundary_area(links, mesh);
  }
  watch.enter_part(kShareOfPasses, 1);
  mesh.look_around(watch);
  if (!follows && lack() == 0) return 0;
  approach_volume(links, wanted, mesh, watch);
  return wanted;
}

}  // namespace tetsoup
