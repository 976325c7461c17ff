#include "io/animation/painter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "base/vec.h"
#include "io/animation/corner_normals.h"
#include "io/animation/tones.h"
#include "io/preview_panels.h"
#include "io/text.h"

namespace tetsoup::animation {
namespace {

constexpr Rgb kSkyTop = rgb(0xf8fafc), kSkyBottom = rgb(0xe8edf2);

Vec3d axis_of(UpAxis up) {
  return {up == UpAxis::X ? 1.0 : 0.0, up == UpAxis::Y ? 1.0 : 0.0, up == UpAxis::Z ? 1.0 : 0.0};
}

std::vector<Vec3d> corners_of(const Box3& box) {
  std::vector<Vec3d> corners;
  for (unsigned i = 0; i < 8; ++i)
    corners.push_back({i & 1U ? box.hi.x : box.lo.x, i & 2U ? box.hi.y : box.lo.y, i & 4U ? box.hi.z : box.lo.z});
  return corners;
}

/// In front of the eye; what is behind it, or has flown to it, cannot be drawn.
bool is_visible(const ScreenPoint& p) {
  constexpr double kNearest = 20;  // One over the distance, of which the middle has 1/4.
  return p.nearness > 0 && p.nearness < kNearest;
}

/// Median length of edges in pixels.
double typical_edge(const std::vector<ScreenPoint>& seen, const std::vector<Triangle>& triangles) {
  std::vector<double> lengths;
  for (const Triangle& t : triangles)
    lengths.push_back(std::hypot(seen[t[0]].x - seen[t[1]].x, seen[t[0]].y - seen[t[1]].y));
  if (lengths.empty()) return 0;
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  return *middle / TriangleTarget::kSupersampling;
}

}  // namespace

Box3 default_view(const Cast& cast, FrameView& first, UpAxis up) {
  constexpr double kSpread = 0.12;  // Of the way down, that what falls may roll aside.
  constexpr double kSag = 0.25;     // Of the width, where nothing is below.
  const Vec3d vertical = axis_of(up);
  Box3 box = box_of(first);
  if (!(box.lo.x <= box.hi.x)) box = {};
  const Vec3d extent = box.hi - box.lo;
  double down = kSag * std::max({extent.x, extent.y, extent.z});
  for (const AnimationPlane& plane : cast.scene.planes) {
    const double slant = dot(plane.normal, vertical);
    if (!(slant > 0)) continue;
    // From the box's bottom, in its middle.
    const Vec3d middle = (box.lo + box.hi) * 0.5;
    const Vec3d bottom = middle + vertical * (dot(box.lo, vertical) - dot(middle, vertical));
    down = std::max(0.0, (dot(plane.normal, bottom) - plane.offset) / slant);
    break;
  }
  const Vec3d level = Vec3d{1, 1, 1} - vertical;
  box.lo -= vertical * down + level * (kSpread * down);
  box.hi += level * (kSpread * down);
  for (const TriangleSoup& obstacle : cast.obstacles)
    for (const Triangle& t : obstacle.triangles)
      for (const std::uint32_t v : t) extend(box, to_double(obstacle.vertices[v]));
  return box;
}

Painter::Painter(const Cast& cast, const Box3& box, const AnimationOptions& options)
    : view_(corners_of(box), static_cast<int>(options.up), options.width, options.height),
      vertical_(axis_of(options.up)),
      backdrop_(options.width, options.height, kSkyTop) {
  // From above, the viewer's left and the front.
  light_ = vertical_ * 1.0 - view_.level_axes()[0] * 0.42 + view_.level_axes()[1] * 0.30;
  light_ = light_ * (1 / length(light_));
  for (int y = 0; y < options.height; ++y) {
    const float t = static_cast<float>(y) / static_cast<float>(options.height);
    fill_rect(backdrop_, {0, y, options.width, 1}, mix(kSkyTop, kSkyBottom, t));
  }
  std::vector<double> depths(backdrop_.pixels.size(), std::numeric_limits<double>::infinity());
  Layers layers{{options.width, options.height}, {}};
  for (const AnimationPlane& plane : cast.scene.planes) {
    Ground& ground = grounds_.emplace_back(plane, box, light_);
    ground.draw(backdrop_, view_, depths);
    layers.shadows.push_back(ground.shadow_target());
  }
  for (const TriangleSoup& obstacle : cast.obstacles)
    add_smooth(layers, obstacle.vertices, obstacle.triangles, tones::kObstacle);
  static_ = std::move(layers);
}

Image Painter::draw(FrameView& view) const {
  Layers layers = *static_;
  for (std::size_t b = 0; b < view.body_count(); ++b) {
    const Make& make = view.make(b);
    if (make.body.surface != nullptr)
      add_smooth(layers, view.points(b), make.triangles, tones::of_body(b));
    else
      add_tets(layers, view.points(b), make.triangles, tones::of_body(b));
  }
  Image image = backdrop_;
  for (std::size_t g = 0; g < grounds_.size(); ++g) grounds_[g].draw_shadows(image, layers.shadows[g]);
  layers.seen.resolve(image, 0, 0);
  char time[32];
  std::snprintf(time, sizeof time, "%.2f s", view.frame().time);
  const double unit = image.height / 540.0;
  draw_text(image, 20 * unit, image.height - 20 * unit, time, {13 * unit, 0.13, palette::kFaint}, image.width / 3.0);
  return image;
}

void Painter::add_smooth(Layers& layers, std::span<const Vec3> points, const std::vector<Triangle>& triangles,
                         const Rgb& colour) const {
  const SurfaceNormals normals(points, triangles);
  const std::vector<ScreenPoint> seen = projected(points);
  std::vector<Rgb> lit(points.size());
  for (std::size_t v = 0; v < points.size(); ++v) lit[v] = shaded(colour, normals.of_vertices[v]);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const Triangle& t = triangles[i];
    if (!is_visible(seen[t[0]]) || !is_visible(seen[t[1]]) || !is_visible(seen[t[2]])) continue;
    std::array<Rgb, 3> colours{lit[t[0]], lit[t[1]], lit[t[2]]};
    for (std::size_t c = 0; c < 3; ++c)
      if (!normals.is_smooth(t, i, c)) colours[c] = shaded(colour, normals.of_triangles[i]);
    layers.seen.draw_smooth({seen[t[0]], seen[t[1]], seen[t[2]]}, colours);
  }
  add_shadows(layers, points, triangles);
}

void Painter::add_tets(Layers& layers, std::span<const Vec3> points, const std::vector<Triangle>& triangles,
                       const Rgb& colour) const {
  const SurfaceNormals normals(points, triangles);
  const std::vector<ScreenPoint> seen = projected(points);
  // Edges of faces a few pixels wide would hide the faces.
  const double alpha = std::clamp((typical_edge(seen, triangles) - 3) / 14, 0.0, 1.0);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const Triangle& t = triangles[i];
    if (!is_visible(seen[t[0]]) || !is_visible(seen[t[1]]) || !is_visible(seen[t[2]])) continue;
    const Rgb face = shaded(colour, normals.of_triangles[i]);
    const EdgeStyle edge{mix(face, palette::kInk, 0.6F), 0.9, static_cast<float>(0.7 * alpha)};
    layers.seen.draw({seen[t[0]], seen[t[1]], seen[t[2]]}, face, edge);
  }
  add_shadows(layers, points, triangles);
}

void Painter::add_shadows(Layers& layers, std::span<const Vec3> points, const std::vector<Triangle>& triangles) const {
  std::vector<ScreenPoint> dropped(points.size());
  for (std::size_t g = 0; g < grounds_.size(); ++g) {
    for (std::size_t v = 0; v < points.size(); ++v) dropped[v] = grounds_[g].shadow_of(to_double(points[v]));
    for (const Triangle& t : triangles) layers.shadows[g].draw({dropped[t[0]], dropped[t[1]], dropped[t[2]]}, {}, {});
  }
}

std::vector<ScreenPoint> Painter::projected(std::span<const Vec3> points) const {
  std::vector<ScreenPoint> seen;
  seen.reserve(points.size());
  for (const Vec3& p : points) seen.push_back(view_.project(to_double(p)));
  return seen;
}

Rgb Painter::shaded(const Rgb& colour, const Vec3& normal) const {
  Vec3d n = to_double(normal);
  // Both sides look alike: nobody knows which one of a soup's is outside.
  if (dot(n, view_.towards_eye()) < 0) n = n * -1;
  const double light = 0.52 + 0.10 * dot(n, vertical_) + 0.40 * std::max(0.0, dot(n, light_)) +
                       0.14 * std::max(0.0, dot(n, view_.towards_eye()));
  return scaled(colour, static_cast<float>(light));
}

}  // namespace tetsoup::animation
