// Embedded points and normals after the mesh has moved.
#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "base/require.h"
#include "base/tet_geometry.h"
#include "tetsoup/embed.h"

namespace tetsoup {
namespace {

constexpr std::int64_t kGrain = 4096;  // points

void require_consistent(const Embedding& embedding, std::span<const Tet> tets, std::size_t vertex_count) {
  require(embedding.weights.size() == embedding.tets.size(), "weights of the embedding", embedding.weights.size(),
          "as many as its tets");
  // Compilers make vector code of this, and it is done for every picture.
  std::uint32_t last_tet = 0, last_vertex = 0;
  for (const std::uint32_t t : embedding.tets) last_tet = std::max(last_tet, t);
  for (const Tet& tet : tets)
    for (const std::uint32_t v : tet) last_vertex = std::max(last_vertex, v);
  require(embedding.tets.empty() || last_tet < tets.size(), "tet of the embedding", last_tet,
          "below the number of tets");
  require(tets.empty() || last_vertex < vertex_count, "vertex of a tet", last_vertex, "below the number of positions");
}

template <class Body>
void for_each(std::size_t count, const Body& body) {
  const Progress nobody;
  StageWatch watch(nobody, "embed");
  parallel_for(static_cast<std::int64_t>(count), kGrain, watch, [&](std::int64_t begin, std::int64_t end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) body(i);
  });
}

/// The cofactor of the map that takes the edges of `from` to those of `to`, times `n`, up to a positive factor: it
/// keeps normals upright on every plane that moves along. Zero where `from` is flat.
Vec3d moved_normal(const TetCorners& from, const TetCorners& to, const Vec3d& n) {
  const std::array<Vec3d, 3> e{from[1] - from[0], from[2] - from[0], from[3] - from[0]};
  const std::array<Vec3d, 3> d{to[1] - to[0], to[2] - to[0], to[3] - to[0]};
  // With F = D E^-1, cof F = cof D E^T / det E: n in coordinates along E's edges, then by the areas of D's faces.
  const Vec3d sum =
      cross(d[1], d[2]) * dot(e[0], n) + cross(d[2], d[0]) * dot(e[1], n) + cross(d[0], d[1]) * dot(e[2], n);
  const double determinant = dot(cross(e[0], e[1]), e[2]);
  return determinant < 0 ? sum * -1.0 : sum;
}

}  // namespace

std::vector<Vec3> deform_points(const Embedding& embedding, std::span<const Tet> tets,
                                std::span<const Vec3> positions) {
  require_consistent(embedding, tets, positions.size());
  std::vector<Vec3> points(embedding.tets.size());
  for_each(points.size(), [&](std::size_t i) {
    const Tet& tet = tets[embedding.tets[i]];
    const auto& w = embedding.weights[i];
    // From the first corner, so that rounding of the weights moves nothing that is far from the origin.
    const Vec3d a = to_double(positions[tet[0]]);
    points[i] =
        to_float(a + (to_double(positions[tet[1]]) - a) * double{w[1]} +
                 (to_double(positions[tet[2]]) - a) * double{w[2]} + (to_double(positions[tet[3]]) - a) * double{w[3]});
  });
  return points;
}

std::vector<Vec3> deform_normals(const Embedding& embedding, const TetMesh& rest, std::span<const Vec3> positions,
                                 std::span<const Vec3> normals) {
  require(positions.size() == rest.vertices.size(), "number of positions", positions.size(),
          "that of the mesh's vertices");
  require(normals.size() == embedding.tets.size(), "number of normals", normals.size(), "that of the embedded points");
  require_consistent(embedding, rest.tets, positions.size());
  std::vector<Vec3> moved(normals.begin(), normals.end());
  for_each(moved.size(), [&](std::size_t i) {
    const Tet& tet = rest.tets[embedding.tets[i]];
    const TetCorners to{to_double(positions[tet[0]]), to_double(positions[tet[1]]), to_double(positions[tet[2]]),
                        to_double(positions[tet[3]])};
    const Vec3d n = moved_normal(corners_of(rest, tet), to, to_double(normals[i]));
    const double size = length(n);
    if (size > 0 && std::isfinite(size)) moved[i] = to_float(n * (1 / size));
  });
  return moved;
}

}  // namespace tetsoup
