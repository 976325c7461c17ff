#include "io/animation/cast.h"

#include <algorithm>
#include <limits>
#include <map>
#include <string>
#include <tuple>
#include <utility>

#include "base/require.h"
#include "base/vec.h"
#include "io/pictures/preview_view.h"
#include "tetsoup/io.h"
#include "tetsoup/quality.h"

namespace tetsoup::animation {
namespace {

void check_body(const AnimationBody& body) {
  const std::string of = " of body '" + body.name + "'";
  require(body.mesh != nullptr, "mesh" + of, "null", "given");
  const std::size_t vertex_count = body.mesh->vertices.size();
  for (const Tet& tet : body.mesh->tets)
    for (const std::uint32_t v : tet) require(v < vertex_count, "vertex of a tet" + of, v, "below the vertex count");
  require((body.surface == nullptr) == (body.embedding == nullptr), "embedding" + of,
          body.embedding == nullptr ? "null" : "given", "given with the surface, and only then");
  if (body.surface == nullptr) return;
  const Embedding& embedding = *body.embedding;
  require(embedding.tets.size() == body.surface->vertices.size(), "points of the embedding" + of, embedding.tets.size(),
          "as many as the surface has vertices");
  require(embedding.weights.size() == embedding.tets.size(), "weights of the embedding" + of, embedding.weights.size(),
          "as many as its points");
  for (const std::uint32_t tet : embedding.tets)
    require(tet < body.mesh->tets.size(), "tet of the embedding" + of, tet, "below the tet count");
}

/// The boundary, over its own vertices in the mesh's order.
Make make_of_boundary(const AnimationBody& body) {
  Make make{body.mesh, body.surface, body.embedding, {}, 0, {}};
  make.triangles = boundary_triangles(*body.mesh);
  for (const Triangle& t : make.triangles) make.shown.insert(make.shown.end(), t.begin(), t.end());
  std::sort(make.shown.begin(), make.shown.end());
  make.shown.erase(std::unique(make.shown.begin(), make.shown.end()), make.shown.end());
  make.point_count = make.shown.size();
  for (Triangle& t : make.triangles)
    for (std::uint32_t& v : t)
      v = static_cast<std::uint32_t>(std::lower_bound(make.shown.begin(), make.shown.end(), v) - make.shown.begin());
  return make;
}

Make make_of(const AnimationBody& body) {
  check_body(body);
  if (body.surface == nullptr) return make_of_boundary(body);
  Make make{body.mesh, body.surface, body.embedding, {}, 0, {}};
  make.triangles = triangles_of(*body.surface).triangles;
  make.point_count = body.surface->vertices.size();
  std::erase_if(make.triangles, [&](const Triangle& t) {
    return std::any_of(t.begin(), t.end(), [&](std::uint32_t v) { return v >= make.point_count; });
  });
  return make;
}

TriangleSoup drawable_part(const TriangleSoup& soup) {
  TriangleSoup part{soup.vertices, {}};
  for (const Triangle& t : soup.triangles)
    if (is_drawable(soup, t)) part.triangles.push_back(t);
  return part;
}

void require_finite(std::span<const Vec3> points, const char* what) {
  const auto bad = std::find_if(points.begin(), points.end(), [](const Vec3& p) { return !is_drawable(p); });
  if (bad != points.end()) require(false, what, bad - points.begin(), "finite");
}

}  // namespace

Cast make_cast(AnimationScene scene) {
  Cast cast;
  std::map<std::tuple<const TetMesh*, const RenderMesh*, const Embedding*>, std::size_t> known;
  for (const AnimationBody& body : scene.bodies) {
    const auto [place, is_new] = known.try_emplace({body.mesh, body.surface, body.embedding}, cast.makes.size());
    if (is_new) cast.makes.push_back(make_of(body));
    cast.make_of.push_back(place->second);
  }
  for (const AnimationObstacle& obstacle : scene.obstacles) {
    require(obstacle.soup != nullptr, "soup of obstacle '" + obstacle.name + "'", "null", "given");
    cast.obstacles.push_back(drawable_part(*obstacle.soup));
  }
  for (const AnimationPlane& plane : scene.planes) {
    const double size = length(plane.normal);
    require(size > 0 && std::isfinite(size) && std::isfinite(plane.offset), "length of a plane's normal", size,
            "above 0 and finite, as its offset");
  }
  cast.scene = std::move(scene);
  return cast;
}

std::vector<Vec3> Make::points(std::span<const Vec3> positions) const {
  if (surface != nullptr) return deform_points(*embedding, mesh->tets, positions);
  std::vector<Vec3> boundary;
  boundary.reserve(shown.size());
  for (const std::uint32_t v : shown) boundary.push_back(positions[v]);
  return boundary;
}

FrameView::FrameView(const Cast& cast, const AnimationFrame& frame)
    : cast_(cast), frame_(frame), surfaces_(cast.make_of.size()) {
  const std::size_t bodies = body_count();
  require(frame.positions.size() == bodies, "positions", frame.positions.size(), "one span for every body");
  require(frame.velocities.empty() || frame.velocities.size() == bodies, "velocities", frame.velocities.size(),
          "none or one span for every body");
  require(frame.surfaces.empty() || frame.surfaces.size() == bodies, "surfaces", frame.surfaces.size(),
          "none or one span for every body");
  for (std::size_t b = 0; b < bodies; ++b) {
    const std::size_t vertices = make(b).mesh->vertices.size();
    require(frame.positions[b].size() == vertices, "positions of a body", frame.positions[b].size(),
            "as many as its vertices");
    require_finite(frame.positions[b], "position of vertex");
    if (!frame.velocities.empty())
      require(frame.velocities[b].size() == vertices, "velocities of a body", frame.velocities[b].size(),
              "as many as its vertices");
    if (frame.surfaces.empty() || frame.surfaces[b].empty()) continue;
    require(make(b).surface != nullptr && frame.surfaces[b].size() == make(b).point_count, "surface points of a body",
            frame.surfaces[b].size(), "as many as its surface has vertices");
    require_finite(frame.surfaces[b], "position of surface point");
  }
}

std::span<const Vec3> FrameView::points(std::size_t body) {
  if (!frame_.surfaces.empty() && !frame_.surfaces[body].empty()) return frame_.surfaces[body];
  std::vector<Vec3>& surface = surfaces_[body];
  if (surface.empty()) surface = make(body).points(frame_.positions[body]);
  return surface;
}

PlaneAxes axes_of(const AnimationPlane& plane) {
  const double size = length(plane.normal);
  const Vec3d normal = plane.normal * (1 / size);
  const Vec3d along = std::abs(normal.x) < 0.8 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
  Vec3d u = along - normal * dot(normal, along);
  u = u * (1 / length(u));
  return {normal, u, cross(normal, u), plane.offset / size};
}

void extend(Box3& box, const Vec3d& point) {
  box = {min(box.lo, point), max(box.hi, point)};
}

Box3 box_of(FrameView& view) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Box3 box{{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};
  for (std::size_t b = 0; b < view.body_count(); ++b)
    for (const Vec3& p : view.points(b)) extend(box, to_double(p));
  return box;
}

}  // namespace tetsoup::animation
