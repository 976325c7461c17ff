#include "io/animation/ground.h"

#include <algorithm>
#include <cmath>

#include "base/vec.h"
#include "io/animation/tones.h"
#include "io/pictures/preview_panels.h"

namespace tetsoup::animation {
namespace {

constexpr double kFadeFrom = 0.9, kFadeTo = 3.2;  // Radii of what is shown.
constexpr double kShadowReach = 2.0;              // Likewise: half a side of the target of shadows.
constexpr float kDarkness = 0.42F;                // Of a full shadow.

/// 1, 2 or 5 times a power of ten, the nearest below.
double round_length(double length) {
  const double power = std::pow(10.0, std::floor(std::log10(length)));
  const double lead = length / power;
  return power * (lead < 2 ? 1 : lead < 5 ? 2 : 5);
}

/// How much of a pixel that is `footprint` cells wide a line of the grid covers.
double line_share(double cells, double footprint) {
  constexpr double kWidth = 1.2;  // Pixels.
  const double distance = std::abs(cells - std::round(cells));
  const double share = std::clamp((kWidth + 1) / 2 - distance / std::max(footprint, 1e-12), 0.0, 1.0);
  return share * std::clamp((0.5 - footprint) / 0.3, 0.0, 1.0);  // Lines too close to tell are not drawn.
}

double smooth_step(double from, double to, double value) {
  const double t = std::clamp((value - from) / (to - from), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

}  // namespace

Ground::Ground(const AnimationPlane& plane, const Box3& box, const Vec3d& light)
    : axes_(axes_of(plane)), light_(light) {
  const Vec3d middle = (box.lo + box.hi) * 0.5;
  origin_ = axes_.normal * axes_.offset;  // Lines of the grid go through the foot of the world's origin.
  radius_ = std::max(length(box.hi - box.lo) / 2, 1e-9);
  cell_ = round_length(radius_ / 2.4);
  const std::array<double, 2> shift = on_plane(middle);
  // The origin moves by whole cells to below the middle of what is shown.
  origin_ += axes_.u * (std::round(shift[0] / cell_) * cell_) + axes_.v * (std::round(shift[1] / cell_) * cell_);
}

void Ground::draw(Image& image, const PreviewView& view, std::vector<double>& depths) {
  const double height = dot(axes_.normal, view.eye()) - axes_.offset;
  if (!(height > 0)) return;  // Seen from behind.
  const auto hit = [&](double x, double y, double& depth) {
    constexpr double kMiddle = TriangleTarget::kSupersampling;
    const Vec3d ray = view.ray(kMiddle * (x + 0.5), kMiddle * (y + 0.5));
    depth = -height / dot(axes_.normal, ray);
    return on_plane(view.eye() + ray * depth);
  };
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      double depth = 0, ignored = 0;
      const auto at = hit(x, y, depth);
      double& nearest =
          depths[static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x)];
      if (!(depth > 0) || depth >= nearest) continue;
      const double strength = 1 - smooth_step(kFadeFrom * radius_, kFadeTo * radius_, std::hypot(at[0], at[1]));
      if (strength <= 0) continue;
      nearest = depth;
      const auto right = hit(x + 1, y, ignored), below = hit(x, y + 1, ignored);
      double line = 0;
      for (std::size_t i = 0; i < 2; ++i) {
        const double footprint = std::hypot(right[i] - at[i], below[i] - at[i]) / cell_;
        line = std::max(line, line_share(at[i] / cell_, footprint));
      }
      const Rgb colour = mix(tones::kGround, tones::kGroundLine, static_cast<float>(line));
      image.blend(x, y, colour, static_cast<float>(strength));
      const double to_texel = kShadowSize / (2 * kShadowReach * radius_);
      pixels_.push_back({x, y, static_cast<float>(at[0] * to_texel + kShadowSize / 2.0),
                         static_cast<float>(at[1] * to_texel + kShadowSize / 2.0), static_cast<float>(strength)});
    }
  }
}

ScreenPoint Ground::shadow_of(const Vec3d& p) const {
  const double slant = dot(axes_.normal, light_);
  if (!(slant > 0.05)) return {};  // The light does not reach this side, or grazes it.
  const auto at = on_plane(p - light_ * ((dot(axes_.normal, p) - axes_.offset) / slant));
  const double scale = TriangleTarget::kSupersampling * kShadowSize / (2 * kShadowReach * radius_);
  constexpr double kMiddle = TriangleTarget::kSupersampling * kShadowSize / 2.0;
  return {at[0] * scale + kMiddle, at[1] * scale + kMiddle, 1};
}

void Ground::draw_shadows(Image& image, const TriangleTarget& shadows) const {
  constexpr int kBlur = 2, kBlurPasses = 3;  // Three box filters look like a Gaussian.
  std::vector<float> dark = shadows.coverage();
  blur(dark, kShadowSize, kShadowSize, kBlur, kBlurPasses);
  const auto texel = [&](int x, int y) {
    if (x < 0 || y < 0 || x >= kShadowSize || y >= kShadowSize) return 0.0F;
    return dark[static_cast<std::size_t>(y * kShadowSize + x)];
  };
  for (const Pixel& pixel : pixels_) {
    const float u = pixel.u - 0.5F, v = pixel.v - 0.5F;
    if (!(u > -1 && v > -1 && u < kShadowSize && v < kShadowSize)) continue;
    const int x = static_cast<int>(std::floor(u)), y = static_cast<int>(std::floor(v));
    const float fu = u - static_cast<float>(x), fv = v - static_cast<float>(y);
    const float low = texel(x, y) + (texel(x + 1, y) - texel(x, y)) * fu;
    const float high = texel(x, y + 1) + (texel(x + 1, y + 1) - texel(x, y + 1)) * fu;
    image.blend(pixel.x, pixel.y, palette::kInk, kDarkness * pixel.strength * (low + (high - low) * fv));
  }
}

}  // namespace tetsoup::animation
