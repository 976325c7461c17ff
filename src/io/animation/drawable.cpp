#include "io/animation/drawable.h"

#include <algorithm>
#include <cmath>

#include "base/vec.h"
#include "io/pictures/preview_panels.h"

namespace tetsoup::animation {
namespace {

/// In front of the eye; what is behind it, or has flown to it, cannot be drawn.
bool is_visible(const ScreenPoint& p) {
  constexpr double kNearest = 20;  // One over the distance, of which the middle has 1/4.
  return p.nearness > 0 && p.nearness < kNearest;
}

/// Whether any of the points lies in these rows or on both sides of them.
bool meets(const std::vector<ScreenPoint>& points, const Rows& rows) {
  double low = INFINITY, high = -INFINITY;
  for (const ScreenPoint& p : points) {
    low = std::min(low, p.y);
    high = std::max(high, p.y);
  }
  return low < rows.end && high > rows.begin;
}

}  // namespace

Rgb Light::on(const Rgb& colour, const Vec3& normal) const {
  Vec3d n = to_double(normal);
  // Both sides look alike: nobody knows which one of a soup's is outside.
  if (dot(n, towards_eye) < 0) n = n * -1;
  const double light = 0.52 + 0.10 * dot(n, vertical) + 0.40 * std::max(0.0, dot(n, towards_light)) +
                       0.14 * std::max(0.0, dot(n, towards_eye));
  return scaled(colour, static_cast<float>(light));
}

Drawable::Drawable(std::span<const Vec3> points, const std::vector<Triangle>& triangles, const Rgb& colour, Look look,
                   const Light& light, const PreviewView& view, const std::vector<Ground>& grounds)
    : triangles_(triangles), colour_(colour), look_(look), light_(light), normals_(points, triangles) {
  seen_.reserve(points.size());
  for (const Vec3& p : points) seen_.push_back(view.project(to_double(p)));
  if (look == Look::Smooth) {
    lit_.reserve(points.size());
    for (const Vec3& normal : normals_.of_vertices) lit_.push_back(light.on(colour, normal));
  }
  for (const Ground& ground : grounds) {
    std::vector<ScreenPoint>& shadow = shadows_.emplace_back();
    shadow.reserve(points.size());
    for (const Vec3& p : points) shadow.push_back(ground.shadow_of(to_double(p)));
  }
}

void Drawable::draw(TriangleTarget& target, const Rows& rows) const {
  if (!meets(seen_, rows)) return;
  if (look_ == Look::Smooth)
    draw_smooth(target, rows);
  else
    draw_faceted(target, rows);
}

void Drawable::draw_smooth(TriangleTarget& target, const Rows& rows) const {
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    const Triangle& t = triangles_[i];
    const std::array<ScreenPoint, 3> corners{seen_[t[0]], seen_[t[1]], seen_[t[2]]};
    if (!std::all_of(corners.begin(), corners.end(), is_visible) || target.misses(corners, rows)) continue;
    std::array<Rgb, 3> colours{lit_[t[0]], lit_[t[1]], lit_[t[2]]};
    for (std::size_t c = 0; c < 3; ++c)
      if (!normals_.is_smooth(t, i, c)) colours[c] = light_.on(colour_, normals_.of_triangles[i]);
    target.draw_smooth(corners, colours, rows);
  }
}

void Drawable::draw_faceted(TriangleTarget& target, const Rows& rows) const {
  // Lines around faces a few pixels wide would hide the faces.
  const double alpha = std::clamp((typical_edge() - 3) / 14, 0.0, 1.0);
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    const Triangle& t = triangles_[i];
    const std::array<ScreenPoint, 3> corners{seen_[t[0]], seen_[t[1]], seen_[t[2]]};
    if (!std::all_of(corners.begin(), corners.end(), is_visible) || target.misses(corners, rows)) continue;
    const Rgb face = light_.on(colour_, normals_.of_triangles[i]);
    const EdgeStyle edge{mix(face, palette::kInk, 0.6F), 0.9, static_cast<float>(0.7 * alpha)};
    target.draw(corners, face, edge, rows);
  }
}

void Drawable::draw_shadow(std::size_t ground, TriangleTarget& target, const Rows& rows) const {
  const std::vector<ScreenPoint>& shadow = shadows_[ground];
  if (!meets(shadow, rows)) return;
  for (const Triangle& t : triangles_) target.cover({shadow[t[0]], shadow[t[1]], shadow[t[2]]}, rows);
}

// Median length in pixels.
double Drawable::typical_edge() const {
  std::vector<double> lengths;
  for (const Triangle& t : triangles_)
    lengths.push_back(std::hypot(seen_[t[0]].x - seen_[t[1]].x, seen_[t[0]].y - seen_[t[1]].y));
  if (lengths.empty()) return 0;
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  return *middle / TriangleTarget::kSupersampling;
}

}  // namespace tetsoup::animation
