#include "io/preview_view.h"

#include <algorithm>
#include <cmath>

namespace tetsoup {

namespace {

constexpr double kEyeDistance = 4.0;  // In diagonals of the box: a long lens.
constexpr double kLargest = 1e30;     // As clean_soup(): beyond it squares overflow.

double component(const Vec3d& v, int axis) {
  return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

Vec3d unit(const Vec3d& v) {
  return v * (1 / length(v));
}

}  // namespace

bool is_drawable(const Vec3& v) {
  const auto fits = [](float f) { return std::abs(f) <= kLargest; };
  return fits(v.x) && fits(v.y) && fits(v.z);
}

bool is_drawable(const TriangleSoup& soup, const Triangle& triangle) {
  return std::all_of(triangle.begin(), triangle.end(),
                     [&](std::uint32_t i) { return i < soup.vertices.size() && is_drawable(soup.vertices[i]); });
}

bool is_drawable(const TetMesh& mesh, const Tet& tet) {
  return std::all_of(tet.begin(), tet.end(),
                     [&](std::uint32_t i) { return i < mesh.vertices.size() && is_drawable(mesh.vertices[i]); });
}

PreviewView::PreviewView(const std::vector<Vec3d>& points, int up_axis, int width, int height) {
  constexpr double kMargin = 0.09;  // Of the panel, on each side.
  Vec3d lo = points[0], hi = lo;
  for (const Vec3d& p : points) lo = min(lo, p), hi = max(hi, p);
  centre_ = (lo + hi) * 0.5;
  size_ = length(hi - lo);
  if (!(size_ > 0)) size_ = 1;

  vertical_ = up_axis == 2 ? Vec3d{0, 0, 1} : Vec3d{0, 1, 0};
  level_ = {Vec3d{1, 0, 0}, up_axis == 2 ? Vec3d{0, -1, 0} : Vec3d{0, 0, 1}};
  towards_eye_ = unit(level_[0] * 0.52 + level_[1] + vertical_ * 0.50);
  right_ = unit(cross(vertical_, towards_eye_));
  up_ = cross(towards_eye_, right_);
  floor_ = component(lo - centre_, up_axis);

  ScreenPoint low = project_unscaled(points[0]), high = low;
  for (const Vec3d& p : points) {
    const ScreenPoint q = project_unscaled(p);
    low = {std::min(low.x, q.x), std::min(low.y, q.y), 0};
    high = {std::max(high.x, q.x), std::max(high.y, q.y), 0};
  }
  const double samples = TriangleTarget::kSupersampling;
  const double tiny = 1e-6;  // A point has no extent.
  scale_ = samples * (1 - 2 * kMargin) *
           std::min(width / std::max(tiny, high.x - low.x), height / std::max(tiny, high.y - low.y));
  shift_x_ = samples * width / 2 - scale_ * (low.x + high.x) / 2;
  shift_y_ = samples * height / 2 - scale_ * (low.y + high.y) / 2;
}

ScreenPoint PreviewView::project_unscaled(const Vec3d& p) const {
  const Vec3d q = (p - centre_) * (1 / size_);
  const double nearness = 1 / (kEyeDistance - dot(q, towards_eye_));
  return {dot(q, right_) * nearness, -dot(q, up_) * nearness, nearness};
}

ScreenPoint PreviewView::project(const Vec3d& p) const {
  const ScreenPoint q = project_unscaled(p);
  return {q.x * scale_ + shift_x_, q.y * scale_ + shift_y_, q.nearness};
}

Vec3d PreviewView::on_floor(const Vec3d& p) const {
  return p + vertical_ * (floor_ - dot(p - centre_, vertical_));
}

int guess_up_axis(const TriangleSoup& soup) {
  constexpr std::size_t kBins = 8;
  constexpr double kClearly = 0.10;  // Of the area; less is no reason to leave the default, z.
  Vec3d lo{kLargest, kLargest, kLargest}, hi = lo * -1;
  for (const Triangle& t : soup.triangles) {
    if (!is_drawable(soup, t)) continue;
    for (const std::uint32_t i : t)
      lo = min(lo, to_double(soup.vertices[i])), hi = max(hi, to_double(soup.vertices[i]));
  }
  // Area over the height along an axis, against the same upside down.
  const auto one_sidedness = [&](int axis) {
    const double low = component(lo, axis), extent = component(hi, axis) - low;
    if (!(extent > 0)) return 0.0;
    std::array<double, kBins> area{};
    double total = 0;
    for (const Triangle& t : soup.triangles) {
      if (!is_drawable(soup, t)) continue;
      const Vec3d a = to_double(soup.vertices[t[0]]), b = to_double(soup.vertices[t[1]]),
                  c = to_double(soup.vertices[t[2]]);
      const double part = length(cross(b - a, c - a));
      for (const Vec3d& p : {a, b, c}) {
        const double bin = std::clamp((component(p, axis) - low) / extent * kBins, 0.0, kBins - 1.0);
        area[static_cast<std::size_t>(bin)] += part;
        total += part;
      }
    }
    double difference = 0;
    for (std::size_t i = 0; i < kBins; ++i) difference += std::abs(area[i] - area[kBins - 1 - i]);
    return total > 0 ? difference / total : 0.0;
  };
  return one_sidedness(1) > one_sidedness(2) + kClearly ? 1 : 2;
}

}  // namespace tetsoup
