#include "quality/topology.h"

#include <algorithm>
#include <tuple>

#include "base/groups.h"
#include "base/tet_faces.h"
#include "base/unions.h"
#include "quality/surface.h"

namespace tetsoup {

namespace {

/// One side of a boundary triangle, with the triangle's corners at its two ends (corner = 3 * triangle + 0..2).
struct Side {
  std::uint32_t low, high;
  std::size_t low_corner, high_corner;
};

/// Of the boundary triangles, by their ends.
std::vector<Side> sorted_sides(std::size_t vertex_count, const std::vector<Triangle>& triangles) {
  Groups<Side> by_low(vertex_count, [&](const auto& put) {
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3;
        Side side{triangles[t][i], triangles[t][j], 3 * t + i, 3 * t + j};
        if (side.low > side.high) side = {side.high, side.low, side.high_corner, side.low_corner};
        put(side.low, side);
      }
    }
  });
  for (std::size_t v = 0; v < vertex_count; ++v) {
    std::sort(by_low[v].begin(), by_low[v].end(), [](const Side& a, const Side& b) {
      return std::tie(a.high, a.low_corner) < std::tie(b.high, b.low_corner);
    });
  }
  return std::move(by_low).items();
}

std::size_t count_components(const TetMesh& mesh, const std::vector<TetFace>& faces) {
  Unions tets(mesh.tets.size());
  for (std::size_t i = 1; i < faces.size(); ++i) {
    if (faces[i].corners == faces[i - 1].corners) tets.join(faces[i - 1].slot / 4, faces[i].slot / 4);
  }
  std::size_t count = 0;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    if (is_valid_tet(mesh.tets[t], mesh.vertices.size()) && tets.find(t) == t) ++count;
  }
  return count;
}

bool any_face_has_three_tets(const std::vector<TetFace>& faces) {
  for (std::size_t i = 2; i < faces.size(); ++i) {
    if (faces[i].corners == faces[i - 2].corners) return true;
  }
  return false;
}

/// The triangles at a vertex form one fan if all their corners there are joined through sides that at most two
/// triangles share.
void measure_boundary(std::size_t vertex_count, const std::vector<Triangle>& triangles, Quality& quality) {
  Unions corners(3 * triangles.size());
  std::vector<char> has_bad_side(vertex_count, 0);
  const std::vector<Side> sides = sorted_sides(vertex_count, triangles);
  for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
    const auto [low, high, low_corner, high_corner] = sides[begin];
    for (end = begin + 1; end < sides.size() && sides[end].low == low && sides[end].high == high; ++end) {
      corners.join(low_corner, sides[end].low_corner);
      corners.join(high_corner, sides[end].high_corner);
    }
    if ((end - begin) % 2 != 0) quality.boundary_closed = false;
    if (end - begin != 2) ++quality.non_manifold_edges;
    if (end - begin > 2) has_bad_side[low] = has_bad_side[high] = 1;
  }
  std::vector<char> fans(vertex_count, 0);
  for (std::size_t c = 0; c < 3 * triangles.size(); ++c) {
    char& count = fans[triangles[c / 3][c % 3]];
    if (corners.find(c) == c && count < 2) ++count;
  }
  for (std::size_t v = 0; v < vertex_count; ++v) {
    if (fans[v] > 0) ++quality.boundary_vertices;
    if (fans[v] > 1 || has_bad_side[v]) ++quality.non_manifold_vertices;
  }
}

std::size_t count_boundary_only(const TetMesh& mesh, const std::vector<Triangle>& triangles) {
  std::vector<char> on_boundary(mesh.vertices.size(), 0);
  for (const Triangle& triangle : triangles) {
    for (const std::uint32_t v : triangle) on_boundary[v] = 1;
  }
  const auto is_boundary_only = [&](const Tet& tet) {
    return is_valid_tet(tet, mesh.vertices.size()) &&
           std::all_of(tet.begin(), tet.end(), [&](std::uint32_t v) { return on_boundary[v] != 0; });
  };
  return static_cast<std::size_t>(std::count_if(mesh.tets.begin(), mesh.tets.end(), is_boundary_only));
}

}  // namespace

void measure_topology(const TetMesh& mesh, Quality& quality) {
  const std::vector<TetFace> faces = sorted_faces(mesh);
  const std::vector<Triangle> triangles = lone_faces(mesh, faces);
  quality.components = count_components(mesh, faces);
  quality.boundary_triangles = triangles.size();
  quality.boundary_closed = !any_face_has_three_tets(faces);
  measure_boundary(mesh.vertices.size(), triangles, quality);
  quality.boundary_manifold =
      quality.boundary_closed && quality.non_manifold_edges == 0 && quality.non_manifold_vertices == 0;
  quality.boundary_only_tets = count_boundary_only(mesh, triangles);
  measure_surface(mesh, faces, triangles, quality);
}

}  // namespace tetsoup
