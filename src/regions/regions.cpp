#include "tetsoup/regions.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/merge_vertices.h"
#include "base/require.h"
#include "base/tet_geometry.h"
#include "base/triangle_boxes.h"
#include "base/unions.h"

namespace tetsoup {
namespace {

constexpr std::int64_t kGrain = 64;  // points
constexpr std::uint32_t kNone = 0xFFFFFFFFU;

/// Of every set that triangles are of: how many have more triangles, or as many and an earlier one.
std::vector<std::uint32_t> ranks_by_size(std::span<const Triangle> triangles, Unions& sets) {
  struct Set {
    std::size_t name = 0, size = 0;
  };
  std::vector<Set> order;  // By their first triangles.
  std::vector<std::uint32_t> places(sets.size(), kNone);
  for (const Triangle& t : triangles) {
    std::uint32_t& place = places[sets.find(t[0])];
    if (place == kNone) {
      place = static_cast<std::uint32_t>(order.size());
      order.push_back({sets.find(t[0]), 0});
    }
    ++order[place].size;
  }
  std::stable_sort(order.begin(), order.end(), [](const Set& a, const Set& b) { return a.size > b.size; });
  for (std::uint32_t rank = 0; rank < order.size(); ++rank) places[order[rank].name] = rank;
  return places;
}

template <class Holds>
std::vector<std::uint32_t> vertices_where(const TetMesh& mesh, const Holds& holds) {
  std::vector<std::uint32_t> vertices;
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v)
    if (holds(placed(mesh.vertices[v], mesh.origin))) vertices.push_back(v);
  return vertices;
}

}  // namespace

std::vector<std::uint32_t> label_vertices(const TetMesh& mesh, const TriangleSoup& soup,
                                          std::span<const std::uint32_t> labels, const Progress& progress) {
  require(labels.size() == soup.triangles.size(), "number of labels", labels.size(), "that of the triangles");
  StageWatch watch(progress, "regions");
  const std::size_t count = mesh.vertices.size();
  std::vector<std::uint32_t> result(count, 0);
  const TriangleBoxes boxes(soup, watch);
  if (boxes.empty()) return result;
  const Vec3d shift = mesh.origin - soup.origin;
  parallel_for(static_cast<std::int64_t>(count), kGrain, watch, [&](std::int64_t begin, std::int64_t end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      const Vec3d p = boxes.to_unit(to_double(mesh.vertices[i]) + shift);
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

std::vector<std::uint32_t> label_parts(const TriangleSoup& soup) {
  std::vector<Triangle> triangles;
  std::vector<std::size_t> places;  // In the soup.
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    if (!is_usable(soup, soup.triangles[t])) continue;
    triangles.push_back(soup.triangles[t]);
    places.push_back(t);
  }
  Unions parts(merge_vertices(soup.vertices, triangles).positions.size());
  for (const Triangle& t : triangles) {
    parts.join(t[0], t[1]);
    parts.join(t[0], t[2]);
  }
  const std::vector<std::uint32_t> ranks = ranks_by_size(triangles, parts);
  std::vector<std::uint32_t> labels(soup.triangles.size(), 0);
  for (std::size_t i = 0; i < triangles.size(); ++i) labels[places[i]] = ranks[parts.find(triangles[i][0])];
  return labels;
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
