#include "quality/surface.h"

#include <algorithm>
#include <cmath>

#include "base/elementary.h"
#include "base/groups.h"
#include "base/tet_geometry.h"

namespace tetsoup {

namespace {

/// An edge by its upper end, in the group of its lower one.
struct EdgeUse {
  std::uint32_t high, triangle;
  bool operator<(const EdgeUse& other) const {
    return high != other.high ? high < other.high : triangle < other.triangle;
  }
};

Groups<EdgeUse> edges_of(std::size_t vertex_count, const std::vector<Triangle>& triangles) {
  Groups<EdgeUse> edges(vertex_count, [&](const auto& put) {
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
      for (std::size_t i = 0; i < 3; ++i) {
        const auto [low, high] = std::minmax(triangles[t][i], triangles[t][(i + 1) % 3]);
        put(low, EdgeUse{high, t});
      }
    }
  });
  for (std::size_t v = 0; v < edges.size(); ++v) std::sort(edges[v].begin(), edges[v].end());
  return edges;
}

/// A triangle's normal, twice its area long.
Vec3d area_normal(const TetMesh& mesh, const Triangle& t) {
  const Vec3d a = to_double(mesh.vertices[t[0]]);
  return cross(to_double(mesh.vertices[t[1]]) - a, to_double(mesh.vertices[t[2]]) - a);
}

/// Angle between two normals; NaN where one of the triangles has no area.
double angle_between(const Vec3d& a, const Vec3d& b) {
  const double lengths = length(a) * length(b);
  return lengths > 0 ? elementary::acos(std::clamp(dot(a, b) / lengths, -1.0, 1.0)) : std::nan("");
}

void measure_bends(const TetMesh& mesh, const std::vector<Triangle>& boundary, const Groups<EdgeUse>& edges,
                   Quality& quality) {
  double angles = 0, count = 0;
  for (std::uint32_t low = 0; low < edges.size(); ++low) {
    const auto group = edges[low];
    for (std::size_t i = 0; i + 1 < group.size(); ++i) {
      const bool is_pair = group[i].high == group[i + 1].high && (i == 0 || group[i - 1].high != group[i].high) &&
                           (i + 2 == group.size() || group[i + 2].high != group[i].high);
      if (!is_pair) continue;
      const double angle = angle_between(area_normal(mesh, boundary[group[i].triangle]),
                                         area_normal(mesh, boundary[group[i + 1].triangle]));
      if (std::isnan(angle)) continue;
      angles += angle;
      ++count;
      quality.boundary_curvature +=
          angle * length(to_double(mesh.vertices[low]) - to_double(mesh.vertices[group[i].high])) / 2;
    }
  }
  if (count > 0) quality.roughness = angles / count;
}

/// Edges of the tets whose ends are on the boundary and that are not edges of it.
std::size_t count_inner_edges(const TetMesh& mesh, const std::vector<char>& on_boundary, const Groups<EdgeUse>& edges) {
  Groups<std::uint32_t> between(mesh.vertices.size(), [&](const auto& put) {
    for (const Tet& tet : mesh.tets) {
      if (!is_valid_tet(tet, mesh.vertices.size())) continue;
      for (const auto& [i, j] : kTetEdges) {
        const auto [low, high] = std::minmax(tet[static_cast<std::size_t>(i)], tet[static_cast<std::size_t>(j)]);
        if (on_boundary[low] && on_boundary[high]) put(low, high);
      }
    }
  });
  std::size_t count = 0;
  for (std::size_t low = 0; low < between.size(); ++low) {
    const auto group = between[low];
    std::sort(group.begin(), group.end());
    const auto end = std::unique(group.begin(), group.end());
    const auto is_inner = [&](std::uint32_t high) {
      const auto at = std::lower_bound(edges[low].begin(), edges[low].end(), EdgeUse{high, 0});
      return at == edges[low].end() || at->high != high;
    };
    count += static_cast<std::size_t>(std::count_if(group.begin(), end, is_inner));
  }
  return count;
}

}  // namespace

void measure_surface(const TetMesh& mesh, const std::vector<TetFace>& faces, const std::vector<Triangle>& boundary,
                     Quality& quality) {
  const Groups<EdgeUse> edges = edges_of(mesh.vertices.size(), boundary);
  measure_bends(mesh, boundary, edges, quality);
  std::vector<char> on_boundary(mesh.vertices.size(), 0);
  for (const Triangle& triangle : boundary) {
    const double area = length(area_normal(mesh, triangle)) / 2;
    if (std::isfinite(area)) quality.boundary_area += area;
    for (const std::uint32_t v : triangle) on_boundary[v] = 1;
  }
  for (std::size_t begin = 0, end = 0; begin < faces.size(); begin = end) {
    end = face_run_end(faces, begin);
    const auto& corners = faces[begin].corners;
    const bool is_between = std::all_of(corners.begin(), corners.end(), [&](auto v) { return on_boundary[v] != 0; });
    if (end - begin > 1 && is_between) ++quality.boundary_only_faces;
  }
  quality.boundary_only_edges = count_inner_edges(mesh, on_boundary, edges);
}

}  // namespace tetsoup
