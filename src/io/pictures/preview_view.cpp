#include "io/pictures/preview_view.h"

#include <algorithm>
#include <cmath>

namespace tetsoup {

namespace {

constexpr double kEyeDistance = 4.0;  // In diagonals of the box: a long lens.
constexpr double kLargest = 1e30;     // As clean_soup(): beyond it squares overflow.

double component(const Vec3d& v, int axis) {
  return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

Vec3d axis_vector(int axis) {
  return {axis == 0 ? 1.0 : 0.0, axis == 1 ? 1.0 : 0.0, axis == 2 ? 1.0 : 0.0};
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

  vertical_ = axis_vector(up_axis);
  level_ = {axis_vector(up_axis == 0 ? 1 : 0), up_axis == 1 ? Vec3d{0, 0, 1} : Vec3d{0, 0, -1}};
  if (up_axis == 2) level_[1] = {0, -1, 0};
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

Vec3d PreviewView::eye() const {
  return centre_ + towards_eye_ * (kEyeDistance * size_);
}

Vec3d PreviewView::ray(double x, double y) const {
  // At the depth of the centre, where nearness is 1 / kEyeDistance.
  const double a = (x - shift_x_) / scale_ * kEyeDistance, b = (y - shift_y_) / scale_ * kEyeDistance;
  return (right_ * a - up_ * b - towards_eye_ * kEyeDistance) * size_;
}

Vec3d PreviewView::on_floor(const Vec3d& p) const {
  return p + vertical_ * (floor_ - dot(p - centre_, vertical_));
}

namespace {

using Corners = std::array<Vec3d, 3>;

std::vector<Corners> drawable_triangles(const TriangleSoup& soup) {
  std::vector<Corners> triangles;
  for (const Triangle& t : soup.triangles) {
    if (is_drawable(soup, t))
      triangles.push_back(
          {to_double(soup.vertices[t[0]]), to_double(soup.vertices[t[1]]), to_double(soup.vertices[t[2]])});
  }
  return triangles;
}

/// How unlike itself the soup is upside down: area over the height along an axis; 0..2.
double one_sidedness(const std::vector<Corners>& triangles, const Box3& box, int axis) {
  constexpr std::size_t kBins = 8;
  const double low = component(box.lo, axis), extent = component(box.hi, axis) - low;
  if (!(extent > 0)) return 0;
  std::array<double, kBins> area{};
  double total = 0;
  for (const Corners& corners : triangles) {
    const double part = length(cross(corners[1] - corners[0], corners[2] - corners[0]));
    for (const Vec3d& p : corners) {
      const double bin = std::clamp((component(p, axis) - low) / extent * kBins, 0.0, kBins - 1.0);
      area[static_cast<std::size_t>(bin)] += part;
      total += part;
    }
  }
  double difference = 0;
  for (std::size_t i = 0; i < kBins; ++i) difference += std::abs(area[i] - area[kBins - 1 - i]);
  return total > 0 ? difference / total : 0;
}

/// How firmly the soup stands: the box of what touches the floor, as a share of the floor plan; 0..1.
double footing(const std::vector<Corners>& triangles, const Box3& box, int axis) {
  constexpr double kTouching = 0.03;  // Of the height.
  const double reach = component(box.lo, axis) + kTouching * (component(box.hi, axis) - component(box.lo, axis));
  Vec3d lo = box.hi, hi = box.lo;
  for (const Corners& corners : triangles)
    for (const Vec3d& p : corners)
      if (component(p, axis) <= reach) lo = min(lo, p), hi = max(hi, p);
  double share = 1;
  for (const int other : {(axis + 1) % 3, (axis + 2) % 3}) {
    const double extent = component(box.hi, other) - component(box.lo, other);
    if (extent > 0) share *= (component(hi, other) - component(lo, other)) / extent;
  }
  return share;
}

}  // namespace

int guess_up_axis(const TriangleSoup& soup) {
  // Tried on 36 models and samples of both kinds: none that is z up falls within it.
  constexpr double kClearly = 0.1;
  const std::vector<Corners> triangles = drawable_triangles(soup);
  if (triangles.empty()) return 2;
  Box3 box{triangles[0][0], triangles[0][0]};
  for (const Corners& corners : triangles)
    for (const Vec3d& p : corners) box.lo = min(box.lo, p), box.hi = max(box.hi, p);
  const auto score = [&](int axis) { return one_sidedness(triangles, box, axis) + footing(triangles, box, axis); };
  return score(2) > score(1) + kClearly ? 2 : 1;
}

}  // namespace tetsoup
