// The few formulas about one tet that several stages share.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "base/vec.h"

namespace tetsoup {

using TetCorners = std::array<Vec3d, 4>;

inline TetCorners corners_of(const TetMesh& mesh, const Tet& tet) {
  return {to_double(mesh.vertices[tet[0]]), to_double(mesh.vertices[tet[1]]), to_double(mesh.vertices[tet[2]]),
          to_double(mesh.vertices[tet[3]])};
}
/// The same in voxels of the grid: voxel centres are the whole numbers.
inline TetCorners corners_in_voxels(const TetMesh& mesh, const Tet& tet, const GridFrame& grid) {
  TetCorners p = corners_of(mesh, tet);
  for (Vec3d& corner : p) corner = (corner - grid.origin) * (1 / grid.voxel_size);
  return p;
}

/// Faces of a positive tet, each counter-clockwise from outside; face i lies opposite vertex i.
inline constexpr std::array<std::array<int, 3>, 4> kTetFaces{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
/// Edges of a tet; edge e is shared by the two faces opposite the vertices of edge 5 - e.
inline constexpr std::array<std::array<int, 2>, 6> kTetEdges{{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

/// Positive for a positive tet.
inline double signed_volume(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d) {
  return dot(cross(b - a, c - a), d - a) / 6;
}
inline double signed_volume(const TetCorners& p) {
  return signed_volume(p[0], p[1], p[2], p[3]);
}

/// Of the face opposite a corner, inwards, as long as twice its area.
inline Vec3d inward_normal(const TetCorners& p, std::size_t corner) {
  const auto& f = kTetFaces[corner];
  const Vec3d a = p[static_cast<std::size_t>(f[0])];
  return cross(p[static_cast<std::size_t>(f[2])] - a, p[static_cast<std::size_t>(f[1])] - a);
}

/// Gradients of the barycentric coordinates of a tet of positive volume.
inline std::array<Vec3d, 4> barycentric_gradients(const TetCorners& p) {
  const double scale = 1 / (6 * signed_volume(p));
  std::array<Vec3d, 4> g;
  for (std::size_t i = 0; i < 4; ++i) g[i] = inward_normal(p, i) * scale;
  return g;
}

/// Barycentric weights of a point, sum 1; not finite where the tet is flat.
inline std::array<double, 4> barycentric(const TetCorners& p, const Vec3d& point) {
  const Vec3d e1 = p[1] - p[0], e2 = p[2] - p[0], e3 = p[3] - p[0], x = point - p[0];
  const Vec3d n1 = cross(e2, e3), n2 = cross(e3, e1), n3 = cross(e1, e2);
  const double inverse = 1 / dot(e1, n1);
  const double w1 = dot(x, n1) * inverse, w2 = dot(x, n2) * inverse, w3 = dot(x, n3) * inverse;
  return {1 - w1 - w2 - w3, w1, w2, w3};
}

inline double least_weight(const TetCorners& p, const Vec3d& point) {
  const auto w = barycentric(p, point);
  return std::min({w[0], w[1], w[2], w[3]});
}

/// Cosines of the six dihedral angles, at the edges of kTetEdges; NaN where a face has no area.
inline std::array<double, 6> dihedral_cosines(const TetCorners& p) {
  std::array<Vec3d, 4> normal;
  std::array<double, 4> inverse_length{};
  for (std::size_t i = 0; i < 4; ++i) {
    const auto& f = kTetFaces[i];
    const Vec3d a = p[static_cast<std::size_t>(f[0])];
    normal[i] = cross(p[static_cast<std::size_t>(f[1])] - a, p[static_cast<std::size_t>(f[2])] - a);
    inverse_length[i] = 1 / length(normal[i]);
  }
  std::array<double, 6> cosines{};
  for (std::size_t e = 0; e < 6; ++e) {
    const auto i = static_cast<std::size_t>(kTetEdges[5 - e][0]);
    const auto j = static_cast<std::size_t>(kTetEdges[5 - e][1]);
    const double c = -dot(normal[i], normal[j]) * inverse_length[i] * inverse_length[j];
    cosines[e] = std::isnan(c) ? c : std::clamp(c, -1.0, 1.0);
  }
  return cosines;
}

}  // namespace tetsoup
