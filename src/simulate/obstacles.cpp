#include "simulate/obstacles.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/require.h"
#include "tetsoup/distance.h"
#include "tetsoup/pseudo_volume.h"
#include "tetsoup/soup.h"

namespace tetsoup::simulate {
namespace {

/// Trilinear over the eight voxels around p, with its gradient.
std::optional<Clearance> sample(const Grid<float>& field, const Vec3d& p) {
  const Vec3d at = (p - field.frame.origin) * (1 / field.frame.voxel_size);
  const Vec3d low{std::floor(at.x), std::floor(at.y), std::floor(at.z)};
  const auto [nx, ny, nz] = field.frame.size;
  if (!(low.x >= 0 && low.y >= 0 && low.z >= 0 && low.x < nx - 1 && low.y < ny - 1 && low.z < nz - 1)) return {};
  const int x = static_cast<int>(low.x), y = static_cast<int>(low.y), z = static_cast<int>(low.z);
  const Vec3d f = at - low;
  Clearance c;
  Vec3d gradient;
  for (int i = 0; i < 8; ++i) {
    const bool i0 = i & 1, i1 = i & 2, i2 = i & 4;
    const double value = static_cast<double>(field.at(x + i0, y + i1, z + i2));
    const double wx = i0 ? f.x : 1 - f.x, wy = i1 ? f.y : 1 - f.y, wz = i2 ? f.z : 1 - f.z;
    c.distance += value * wx * wy * wz;
    gradient +=
        Vec3d{(i0 ? value : -value) * wy * wz, (i1 ? value : -value) * wx * wz, (i2 ? value : -value) * wx * wy};
  }
  const double size = length(gradient);
  if (!(size > 0)) return {};
  c.normal = gradient * (1 / size);
  return c;
}

/// Twelve bytes a voxel while the field is made, four of which stay: 1.8 GB. 528 along the sides of a cube.
constexpr double kMostVoxels = 1.5e8;

double voxels_in_all(const Box3& box, int along_longest) {
  constexpr double kAround = 4;  // that the grid has beyond the box
  const Vec3d extent = box.hi - box.lo;
  const double longest = std::max({extent.x, extent.y, extent.z});
  double count = 1;
  for (const double e : {extent.x, extent.y, extent.z})
    count *= (longest > 0 ? std::max(1.0, std::ceil(e / longest * along_longest)) : 1) + kAround;
  return count;
}

void check_voxels(const CleanSoup& soup, int voxels) {
  if (soup.report.used_triangles == 0 || voxels < 1 || voxels_in_all(soup.report.box, voxels) <= kMostVoxels) return;
  int fitting = 1;
  for (int step = voxels / 2 + 1; step > 0; step /= 2)
    while (voxels_in_all(soup.report.box, fitting + step) <= kMostVoxels) fitting += step;
  require(false, "voxels", voxels,
          "at most " + std::to_string(fitting) + " for this obstacle: its grid would have more than 1.5e8");
}

}  // namespace

std::optional<Clearance> distance_from(const Obstacle& obstacle, const Vec3d& p) {
  if (obstacle.field) return sample(*obstacle.field, p);
  return Clearance{dot(obstacle.normal, p) - obstacle.offset, obstacle.normal};
}

Grid<float> signed_distance(const TriangleSoup& soup, int voxels, const Progress& progress) {
  const CleanSoup clean = clean_soup(soup, progress);
  check_voxels(clean, voxels);
  DistanceOptions options;
  options.voxels = voxels;
  options.mode = DistanceMode::Full;
  const DistanceField field = unsigned_distance(clean, options, progress);
  const PseudoVolume volume = classify_volume(field, {}, progress);
  Grid<float> result = dense(field.distance);
  result.frame.origin += result.frame.soup_origin;
  result.frame.soup_origin = {};
  const auto [nx, ny, nz] = result.frame.size;
  for (int z = 0; z < nz; ++z)
    for (int y = 0; y < ny; ++y)
      for (int x = 0; x < nx; ++x)
        if (volume.inside.test(x, y, z)) result.values[result.index(x, y, z)] *= -1;
  return result;
}

}  // namespace tetsoup::simulate
