#include "io/animation/glb_mesh.h"

#include <algorithm>
#include <array>

#include "base/vec.h"

namespace tetsoup::animation {
namespace {

constexpr std::uint32_t kNone = RenderMesh::kNone;

/// Texture coordinates at the corners of the make's triangles; empty if the surface has none.
std::vector<std::array<std::uint32_t, 3>> triangle_texcoords(const Make& make) {
  std::vector<std::array<std::uint32_t, 3>> choices;
  const RenderMesh* surface = make.surface;
  if (surface == nullptr || surface->corner_texcoords.empty()) return choices;
  const auto choice = [&](std::size_t corner) {
    const std::uint32_t texcoord = surface->corner_texcoords[corner];
    return texcoord < surface->texcoords.size() ? texcoord : kNone;
  };
  std::size_t first = 0;
  for (const std::uint32_t size : surface->face_sizes) {
    for (std::size_t c = 2; c < size; ++c) {
      const std::array<std::size_t, 3> corners{first, first + c - 1, first + c};
      // As make_cast() leaves them out.
      if (std::all_of(corners.begin(), corners.end(),
                      [&](std::size_t corner) { return surface->corners[corner] < make.point_count; }))
        choices.push_back({choice(corners[0]), choice(corners[1]), choice(corners[2])});
    }
    first += size;
  }
  return choices;
}

}  // namespace

GlbMesh::GlbMesh(const Make& make) : make_(make), rest_(make.points(make.mesh->vertices)) {
  const SurfaceNormals normals(rest_, make.triangles);
  const auto choices = triangle_texcoords(make);
  std::vector<Vertex> corners;
  corners.reserve(3 * make.triangles.size());
  for (std::size_t i = 0; i < make.triangles.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      corners.push_back({make.triangles[i][c], choices.empty() ? kNone : choices[i][c],
                         normals.is_smooth(make.triangles[i], i, c) ? kNone : static_cast<std::uint32_t>(i)});
  vertices_ = corners;
  std::sort(vertices_.begin(), vertices_.end());
  vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
  indices_.reserve(corners.size());
  for (const Vertex& corner : corners)
    indices_.push_back(
        static_cast<std::uint32_t>(std::lower_bound(vertices_.begin(), vertices_.end(), corner) - vertices_.begin()));
  if (choices.empty()) return;
  for (const Vertex& vertex : vertices_) {
    const Vec2 t = vertex.texcoord == kNone ? Vec2{0, 1} : make.surface->texcoords[vertex.texcoord];
    texcoords_.push_back({t.x, 1 - t.y});
  }
}

std::vector<Vec3> GlbMesh::spread(const std::vector<Vec3>& points) const {
  std::vector<Vec3> spread;
  spread.reserve(vertices_.size());
  for (const Vertex& vertex : vertices_) spread.push_back(points[vertex.point]);
  return spread;
}

std::vector<Vec3> GlbMesh::normals_of(const std::vector<Vec3>& points) const {
  const SurfaceNormals normals(points, make_.triangles);
  std::vector<Vec3> spread;
  spread.reserve(vertices_.size());
  for (const Vertex& vertex : vertices_) {
    const Vec3& normal = vertex.facet == kNone ? normals.of_vertices[vertex.point] : normals.of_triangles[vertex.facet];
    spread.push_back(normal == Vec3{} ? Vec3{0, 0, 1} : normal);  // The format wants unit vectors.
  }
  return spread;
}

GlbMesh::Target GlbMesh::target(const std::vector<Vec3>& shape) const {
  // Normals are not linear in what moves: the difference over the range that is used is nearer than a derivative.
  const std::vector<Vec3>& at_rest = make_.mesh->vertices;
  std::vector<Vec3> less = at_rest, more = at_rest;
  for (std::size_t v = 0; v < at_rest.size(); ++v) {
    const Vec3d half = to_double(shape[v]) * 0.5;
    less[v] = to_float(to_double(at_rest[v]) - half);
    more[v] = to_float(to_double(at_rest[v]) + half);
  }
  Target target{spread(make_.points(shape)), normals_of(make_.points(more))};
  const std::vector<Vec3> from = normals_of(make_.points(less));
  for (std::size_t v = 0; v < from.size(); ++v)
    target.normals[v] = to_float(to_double(target.normals[v]) - to_double(from[v]));
  return target;
}

}  // namespace tetsoup::animation
