#include "c/handles.h"

#include <algorithm>
#include <cmath>

#include "base/vec.h"
#include "c/guard.h"
#include "tetsoup/io.h"
#include "tetsoup/quality.h"

namespace tetsoup::c {

namespace {

/// Weighted by area; triangles that name no vertex or no point count for nothing.
std::vector<Vec3> vertex_normals(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles) {
  std::vector<Vec3d> sums(points.size());
  for (const Triangle& triangle : triangles) {
    if (std::any_of(triangle.begin(), triangle.end(), [&](std::uint32_t v) { return v >= points.size(); })) continue;
    const Vec3d a = to_double(points[triangle[0]]);
    const Vec3d normal = cross(to_double(points[triangle[1]]) - a, to_double(points[triangle[2]]) - a);
    if (!std::isfinite(squared_length(normal))) continue;
    for (const std::uint32_t v : triangle) sums[v] += normal;
  }
  std::vector<Vec3> normals(points.size());
  for (std::size_t v = 0; v < sums.size(); ++v) {
    const double size = length(sums[v]);
    if (size > 0) normals[v] = to_float(sums[v] * (1 / size));
  }
  return normals;
}

}  // namespace

Make make_of(TetMesh mesh, RenderMesh render, std::optional<Embedding> embedding, const Progress& progress) {
  Make make;
  make.mesh = std::move(mesh);
  make.render = std::move(render);
  if (make.render.vertices.empty()) {
    make.triangles = boundary_triangles(make.mesh);
    return make;
  }
  const TriangleSoup soup = triangles_of(make.render);
  make.triangles = soup.triangles;
  make.embedding = embedding ? std::move(*embedding) : embed_points(make.mesh, soup, {}, progress);
  make.normals = vertex_normals(soup.vertices, soup.triangles);
  return make;
}

void deform(const Make& make, std::span<const Vec3> positions, std::vector<Vec3>* surface, std::vector<Vec3>* normals) {
  require(positions.size() == make.mesh.vertices.size(), "number of positions", positions.size(),
          "that of the mesh's vertices");
  if (surface != nullptr) *surface = deform_points(make.embedding, make.mesh.tets, positions);
  if (normals != nullptr) *normals = deform_normals(make.embedding, make.mesh, positions, make.normals);
}

tetsoup_floats view_of(std::span<const Vec3> points) {
  return {points.empty() ? nullptr : &points.front().x, points.size(), 3};
}

std::vector<Vec3> points_from(const float* xyz, std::size_t count, const char* name) {
  given_items(xyz, count, name);
  std::vector<Vec3> points(count);
  for (std::size_t i = 0; i < count; ++i) points[i] = {xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]};
  return points;
}

Vec3d vector_from(const double* xyz, const char* name) {
  given(xyz, name);
  return {xyz[0], xyz[1], xyz[2]};
}

}  // namespace tetsoup::c
