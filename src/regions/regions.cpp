#include "tetsoup/regions.h"

#include <cmath>
#include <limits>

#include "base/require.h"
#include "base/tet_geometry.h"
#include "base/triangle_boxes.h"

namespace tetsoup {
namespace {

constexpr std::int64_t kGrain = 64;  // points

/// Labels of the triangles nearest to point(0), ..., point(count - 1).
template <class Point>
std::vector<std::uint32_t> nearest_labels(std::size_t count, const Point& point, const TriangleSoup& soup,
                                          std::span<const std::uint32_t> labels, const Progress& progress) {
  require(labels.size() == soup.triangles.size(), "number of labels", labels.size(), "that of the triangles");
  StageWatch watch(progress, "regions");
  std::vector<std::uint32_t> result(count, 0);
  const TriangleBoxes boxes(soup, watch);
  if (boxes.empty()) return result;
  parallel_for(static_cast<std::int64_t>(count), kGrain, watch, [&](std::int64_t begin, std::int64_t end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      const Vec3d p = boxes.to_unit(point(i));
      double square = std::numeric_limits<double>::infinity();
      float bound = std::numeric_limits<float>::infinity();
      boxes.visit_near(to_float(p), bound, [&](std::uint32_t t) {
        const double to_t = squared_length(p - closest_on_triangle(boxes.corners_in_unit(t), p));
        if (to_t > square || (to_t == square && labels[t] >= result[i])) return;
        square = to_t;
        result[i] = labels[t];
        bound = TriangleBoxes::bound_above(square);
      });
    }
  });
  return result;
}

template <class Holds>
std::vector<std::uint32_t> vertices_where(const TetMesh& mesh, const Holds& holds) {
  std::vector<std::uint32_t> vertices;
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v)
    if (holds(to_double(mesh.vertices[v]))) vertices.push_back(v);
  return vertices;
}

}  // namespace

std::vector<std::uint32_t> label_tets(const TetMesh& mesh, const TriangleSoup& soup,
                                      std::span<const std::uint32_t> labels, const Progress& progress) {
  const auto centre = [&](std::size_t t) {
    const TetCorners p = corners_of(mesh, mesh.tets[t]);
    return (p[0] + p[1] + p[2] + p[3]) * 0.25;
  };
  return nearest_labels(mesh.tets.size(), centre, soup, labels, progress);
}

std::vector<std::uint32_t> label_vertices(const TetMesh& mesh, const TriangleSoup& soup,
                                          std::span<const std::uint32_t> labels, const Progress& progress) {
  const auto vertex = [&](std::size_t v) { return to_double(mesh.vertices[v]); };
  return nearest_labels(mesh.vertices.size(), vertex, soup, labels, progress);
}

std::vector<std::uint32_t> vertices_in_box(const TetMesh& mesh, const Box3& box) {
  return vertices_where(mesh, [&](const Vec3d& v) {
    return v.x >= box.lo.x && v.y >= box.lo.y && v.z >= box.lo.z && v.x <= box.hi.x && v.y <= box.hi.y &&
           v.z <= box.hi.z;
  });
}

std::vector<std::uint32_t> vertices_below(const TetMesh& mesh, const Vec3d& normal, double offset) {
  const double size = length(normal);
  if (!(size > 0) || !std::isfinite(size)) throw InvalidInput("normal of the plane: must be finite and not zero");
  return vertices_where(mesh, [&](const Vec3d& v) { return dot(normal, v) <= offset; });
}

}  // namespace tetsoup
