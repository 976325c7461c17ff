#include "io/animation/corner_normals.h"

#include <cmath>

#include "base/vec.h"

namespace tetsoup::animation {
namespace {

Vec3 unit_or_zero(const Vec3d& v) {
  const double size = length(v);
  return size > 0 && std::isfinite(size) ? to_float(v * (1 / size)) : Vec3{};
}

}  // namespace

SurfaceNormals::SurfaceNormals(std::span<const Vec3> points, std::span<const Triangle> triangles)
    : of_vertices(points.size()), of_triangles(triangles.size()) {
  std::vector<Vec3d> sums(points.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const Vec3d a = to_double(points[triangles[t][0]]);
    const Vec3d normal = cross(to_double(points[triangles[t][1]]) - a, to_double(points[triangles[t][2]]) - a);
    of_triangles[t] = unit_or_zero(normal);
    for (const std::uint32_t v : triangles[t]) sums[v] += normal;  // Weighted by area.
  }
  for (std::size_t v = 0; v < sums.size(); ++v) of_vertices[v] = unit_or_zero(sums[v]);
}

bool SurfaceNormals::is_smooth(const Triangle& triangle, std::size_t index, std::size_t corner) const {
  return dot(to_double(of_vertices[triangle[corner]]), to_double(of_triangles[index])) > kCreaseCosine;
}

}  // namespace tetsoup::animation
