#include "io/animation/painter.h"

#include <algorithm>
#include <cstdio>
#include <limits>

#include "base/parallel.h"
#include "base/vec.h"
#include "io/animation/tones.h"
#include "io/pictures/preview_panels.h"
#include "io/pictures/text.h"

namespace tetsoup::animation {
namespace {

constexpr std::size_t kBatch = 16;  // Bodies whose corners are held at a time.
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

}  // namespace

Box3 default_view(const Cast& cast, FrameView& first, UpAxis up) {
  constexpr double kSpread = 0.18;  // Of the way down, that what falls may roll aside.
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
      backdrop_(options.width, options.height, kSkyTop) {
  // From above, the viewer's left and the front.
  const Vec3d vertical = axis_of(options.up);
  const Vec3d light = vertical - view_.level_axes()[0] * 0.42 + view_.level_axes()[1] * 0.30;
  light_ = {vertical, light * (1 / length(light)), view_.towards_eye()};
  for (int y = 0; y < options.height; ++y) {
    const float t = static_cast<float>(y) / static_cast<float>(options.height);
    fill_rect(backdrop_, {0, y, options.width, 1}, mix(kSkyTop, kSkyBottom, t));
  }
  std::vector<double> depths(backdrop_.pixels.size(), std::numeric_limits<double>::infinity());
  Layers layers{{options.width, options.height}, {}};
  for (const AnimationPlane& plane : cast.scene.planes) {
    Ground& ground = grounds_.emplace_back(plane, box, light_.towards_light);
    ground.draw(backdrop_, view_, depths);
    layers.shadows.push_back(ground.shadow_target());
  }
  std::vector<Drawable> obstacles;
  for (const TriangleSoup& obstacle : cast.obstacles)
    obstacles.emplace_back(obstacle.vertices, obstacle.triangles, tones::kObstacle, Look::Smooth, light_, view_,
                           grounds_);
  add(layers, obstacles);
  static_ = std::move(layers);
}

std::vector<Drawable> Painter::drawables(FrameView& view, std::size_t begin, std::size_t end) const {
  std::vector<std::optional<Drawable>> made(end - begin);
  for (std::size_t b = begin; b < end; ++b) view.points(b);  // Which is parallel itself.
  const Progress nobody;
  StageWatch watch(nobody, "draw");
  parallel_for(static_cast<std::int64_t>(end - begin), 1, watch, [&](std::int64_t at, std::int64_t) {
    const std::size_t b = begin + static_cast<std::size_t>(at);
    const Make& make = view.make(b);
    made[static_cast<std::size_t>(at)].emplace(view.points(b), make.triangles, tones::of_body(b),
                                               make.surface != nullptr ? Look::Smooth : Look::Faceted, light_, view_,
                                               grounds_);
  });
  std::vector<Drawable> drawables;
  for (std::optional<Drawable>& drawable : made) drawables.push_back(*std::move(drawable));
  return drawables;
}

Image Painter::draw(FrameView& view) const {
  Layers layers = *static_;
  for (std::size_t first = 0; first < view.body_count(); first += kBatch)
    add(layers, drawables(view, first, std::min(view.body_count(), first + kBatch)));
  Image image = backdrop_;
  for (std::size_t g = 0; g < grounds_.size(); ++g) grounds_[g].draw_shadows(image, layers.shadows[g]);
  layers.seen.resolve(image, 0, 0);
  char time[32];
  std::snprintf(time, sizeof time, "%.2f s", view.frame().time);
  const double unit = image.height / 540.0;
  draw_text(image, 20 * unit, image.height - 20 * unit, time, {13 * unit, 0.13, palette::kFaint}, image.width / 3.0);
  return image;
}

// Rows are shared out between threads; within each of them the order is that of the drawables.
void Painter::add(Layers& layers, const std::vector<Drawable>& drawables) const {
  constexpr int kBands = 8;  // A layer.
  const Progress nobody;
  StageWatch watch(nobody, "draw");
  const auto layer_count = static_cast<std::int64_t>(1 + grounds_.size());
  parallel_for(layer_count * kBands, 1, watch, [&](std::int64_t begin, std::int64_t) {
    const auto layer = static_cast<std::size_t>(begin / kBands);
    const int band = static_cast<int>(begin % kBands);
    TriangleTarget& target = layer == 0 ? layers.seen : layers.shadows[layer - 1];
    const Rows rows{target.row_count() * band / kBands, target.row_count() * (band + 1) / kBands};
    for (const Drawable& drawable : drawables) {
      if (layer == 0)
        drawable.draw(target, rows);
      else
        drawable.draw_shadow(layer - 1, target, rows);
    }
  });
}

}  // namespace tetsoup::animation
