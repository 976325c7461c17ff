// Meshes to smooth, and what is asked of every result.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>
#include <random>

#include "lattice_shapes.h"
#include "tetsoup/quality.h"
#include "tetsoup/smooth.h"

namespace tetsoup {

inline constexpr double kDegree = std::numbers::pi / 180;

inline bool same_bits(const TetMesh& a, const TetMesh& b) {
  return a.tets == b.tets && a.vertices.size() == b.vertices.size() &&
         std::memcmp(a.vertices.data(), b.vertices.data(), a.vertices.size() * sizeof(Vec3)) == 0;
}

inline Vec3d normal_of(const TetMesh& mesh, const Triangle& t) {
  const Vec3d a = to_double(mesh.vertices[t[0]]);
  const Vec3d n = cross(to_double(mesh.vertices[t[1]]) - a, to_double(mesh.vertices[t[2]]) - a);
  return n * (1 / length(n));
}

/// Mean angle in degrees between the normals of boundary triangles that share an edge.
inline double roughness(const TetMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, Vec3d> first;
  double sum = 0;
  int count = 0;
  for (const Triangle& t : boundary_triangles(mesh)) {
    const Vec3d n = normal_of(mesh, t);
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [at, is_new] = first.try_emplace(std::minmax(t[i], t[(i + 1) % 3]), n);
      if (is_new) continue;
      sum += std::acos(std::clamp(dot(at->second, n), -1.0, 1.0));
      ++count;
    }
  }
  return sum / count / kDegree;
}

inline TetMesh ball(double cell) {
  return lattice_of({-1.2, -1.2, -1.2}, {1.2, 1.2, 1.2}, cell, [](const Vec3d& p) { return length(p) < 1; });
}

inline TetMesh torus(double cell) {
  return lattice_of({-1.5, -1.5, -0.5}, {1.5, 1.5, 0.5}, cell, [](const Vec3d& p) {
    const double ring = std::hypot(p.x, p.y) - 1;
    return ring * ring + p.z * p.z < 0.16;
  });
}

/// A box turned by 30 degrees about z.
inline TetMesh turned_box(const Vec3d& half, double cell) {
  const double c = std::cos(30 * kDegree), s = std::sin(30 * kDegree);
  return lattice_of({-1.4, -1.4, -1.1}, {1.4, 1.4, 1.1}, cell, [=](const Vec3d& p) {
    return std::abs(c * p.x + s * p.y) < half.x && std::abs(c * p.y - s * p.x) < half.y && std::abs(p.z) < half.z;
  });
}

/// Every tet of a block stays with this probability.
inline TetMesh random_lattice(unsigned seed, const std::array<int, 3>& cells, double share) {
  std::mt19937 random(seed);
  return lattice_mesh({-1, -1, -1}, cells, 0.3, [&](const TetCorners&) {
    return static_cast<double>(random()) < share * static_cast<double>(std::mt19937::max());
  });
}

/// The promises of fairing, measured on the output bits.
inline void expect_kept(const TetMesh& before, const SmoothResult& result,
                        double floor = SmoothOptions{}.min_dihedral) {
  const Quality start = measure_quality(before), end = measure_quality(result.mesh);
  EXPECT_EQ(end.inverted_tets, 0U);
  EXPECT_GE(end.min_dihedral, std::min(floor, start.min_dihedral) - 1e-9);
  EXPECT_LE(end.max_dihedral, std::max(SmoothOptions{}.max_dihedral, start.max_dihedral) + 1e-9);
  EXPECT_LE(end.max_edge_ratio, std::max(SmoothOptions{}.max_edge_ratio, start.max_edge_ratio) * (1 + 1e-9));
  EXPECT_NEAR(end.volume, start.volume, 1e-4 * start.volume);
  EXPECT_EQ(result.mesh.tets, before.tets);
  EXPECT_NEAR(result.report.min_dihedral, end.min_dihedral, 1e-12);
  EXPECT_NEAR(result.report.volume_before, start.volume, 1e-12 * start.volume);
  EXPECT_NEAR(result.report.volume_after, end.volume, 1e-12 * start.volume);
  EXPECT_EQ(result.report.boundary_vertices, end.boundary_vertices);
  EXPECT_EQ(result.report.boundary_volume_ratio.size(), end.boundary_vertices);
}

inline TetMesh scaled(TetMesh mesh, float factor) {
  for (Vec3& v : mesh.vertices) v = {v.x * factor, v.y * factor, v.z * factor};
  return mesh;
}

}  // namespace tetsoup
