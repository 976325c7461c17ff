#include "smooth/aims.h"

#include <cmath>

#include "smooth/volume.h"

namespace tetsoup {

namespace {

constexpr double kStep = 0.5;         // Voxels: no voxel on the way is missed by more than a corner.
constexpr double kStepsInReach = 24;  // At most so many: finer grids are passed in longer steps, halved at the end.
// Times the reach: a wall thinner than a tet may lie anywhere in the layer around it, by the other face even. Where
// there are vertices inside, the farther look gives .001 of overlap for .2 degrees of roughness.
constexpr double kThroughLayer = 2;
constexpr std::int64_t kTrianglesPerChunk = 256;

Vec3d unit_or_zero(const Vec3d& v) {
  const double size = length(v);
  return size > 0 ? v * (1 / size) : Vec3d{};
}

/// The voxels along straight lines.
class VoxelProbe {
 public:
  VoxelProbe(const BitGrid& inside, double reach)
      : inside_(inside), reach_(reach / inside.frame.voxel_size), step_(std::max(kStep, reach_ / kStepsInReach)) {}

  /// Way along the unit normal to where the voxels change; NaN beyond reach, which inwards is so many times as far.
  double way_to_surface(const Vec3d& at, const Vec3d& normal, double inwards) const {
    const Vec3d p = (at - inside_.frame.origin) * (1 / inside_.frame.voxel_size);
    const bool here = is_inside(p);
    const Vec3d along = here ? normal : normal * -1;
    const double reach = here ? reach_ : inwards * reach_;
    double same = 0, other = step_;
    while (is_inside(p + along * other) == here) {
      same = other;
      other += step_;
      if (other > reach) return std::nan("");
    }
    while (other - same > kStep) {
      const double middle = (same + other) / 2;
      (is_inside(p + along * middle) == here ? same : other) = middle;
    }
    const double way = (same + other) / 2;
    return (here ? way : -way) * inside_.frame.voxel_size;
  }

 private:
  bool is_inside(const Vec3d& p) const {
    const auto index = [](double c) { return static_cast<int>(std::floor(c + 0.5)); };
    const int x = index(p.x), y = index(p.y), z = index(p.z);
    return inside_.frame.contains(x, y, z) && inside_.test(x, y, z);
  }

  const BitGrid& inside_;
  double reach_, step_;
};

TriangleAim aim_triangle(const std::array<Vec3d, 3>& corners, const std::array<Vec3d, 3>& normals,
                         const VoxelProbe& probe, double inwards, double level) {
  TriangleAim aim;
  aim.area = length(cross(corners[1] - corners[0], corners[2] - corners[0])) / 2;
  aim.normal = unit_or_zero(normals[0] + normals[1] + normals[2]);
  for (std::size_t s = 0; s < kSamples; ++s) {
    const auto& w = kSampleWeights[s];
    const Vec3d at = corners[0] * w[0] + corners[1] * w[1] + corners[2] * w[2];
    const Vec3d normal = unit_or_zero(normals[0] * w[0] + normals[1] * w[1] + normals[2] * w[2]);
    if (normal == Vec3d{}) continue;
    const double way = probe.way_to_surface(at, normal, inwards);
    if (!std::isnan(way)) aim.samples[s] = {normal, dot(normal, at) + way + level, true};
  }
  return aim;
}

}  // namespace

std::vector<Vec3d> unit_normals(const Connectivity& links, const GuardedMesh& mesh) {
  const std::vector<Vec3d> gradients = volume_gradients(links, mesh);
  std::vector<Vec3d> normals(mesh.mesh().vertices.size());
  for (std::size_t i = 0; i < gradients.size(); ++i) normals[links.boundary[i]] = unit_or_zero(gradients[i]);
  return normals;
}

std::vector<TriangleAim> aim_at_surface(const Connectivity& links, const GuardedMesh& mesh,
                                        std::span<const Vec3d> normals, const BitGrid& inside, double reach,
                                        double level, StageWatch& watch) {
  const VoxelProbe probe(inside, reach);
  std::vector<TriangleAim> aims(links.triangles.size());
  parallel_for(static_cast<std::int64_t>(aims.size()), kTrianglesPerChunk, watch,
               [&](std::int64_t begin, std::int64_t end) {
                 for (auto t = static_cast<std::size_t>(begin); t < static_cast<std::size_t>(end); ++t) {
                   const auto& [a, b, c] = links.triangles[t];
                   const bool is_bare = (links.is_bare[a] & links.is_bare[b] & links.is_bare[c]) != 0;
                   aims[t] = aim_triangle({mesh.at(a), mesh.at(b), mesh.at(c)}, {normals[a], normals[b], normals[c]},
                                          probe, is_bare ? kThroughLayer : 1, level);
                 }
               });
  return aims;
}

}  // namespace tetsoup
