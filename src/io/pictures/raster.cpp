#include "io/pictures/raster.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"

namespace tetsoup {

namespace {

std::uint8_t to_byte(float value) {
  return static_cast<std::uint8_t>(std::clamp(value, 0.0F, 1.0F) * 255 + 0.5F);
}

double distance_to_segment(const Point& p, const Point& a, const Point& b) {
  const double dx = b.x - a.x, dy = b.y - a.y;
  const double squared = dx * dx + dy * dy;
  const double t = squared > 0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / squared, 0.0, 1.0) : 0.0;
  const double ex = p.x - a.x - t * dx, ey = p.y - a.y - t * dy;
  return std::sqrt(ex * ex + ey * ey);
}

/// First and last pixel of [low, high] within [0, count); safe for any finite or infinite bounds.
std::array<int, 2> clipped(double low, double high, int count) {
  return {static_cast<int>(std::floor(std::clamp(low, 0.0, static_cast<double>(count)))),
          static_cast<int>(std::ceil(std::clamp(high, -1.0, count - 1.0)))};
}

/// First and last sample, which lie at 0.5, 1.5, ..., between two places and in [begin, end).
std::array<int, 2> samples_within(double low, double high, int begin, int end) {
  return {static_cast<int>(std::ceil(std::clamp(low - 0.5, begin + 0.0, end + 0.0))),
          static_cast<int>(std::floor(std::clamp(high - 0.5, begin - 1.0, end - 1.0)))};
}

template <class Body>
void for_each_row(int count, const Body& body) {
  constexpr std::int64_t kGrain = 32;
  const Progress nobody;
  StageWatch watch(nobody, "draw");
  parallel_for(count, kGrain, watch, [&](std::int64_t begin, std::int64_t end) {
    for (auto row = begin; row < end; ++row) body(static_cast<int>(row));
  });
}

double doubled_area(const std::array<ScreenPoint, 3>& p) {
  return (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[1].y - p[0].y) * (p[2].x - p[0].x);
}

}  // namespace

void Image::blend(int x, int y, const Rgb& colour, float alpha) {
  if (x < 0 || y < 0 || x >= width || y >= height || alpha <= 0) return;
  Rgb& pixel = at(x, y);
  pixel = mix(pixel, colour, std::min(alpha, 1.0F));
}

std::vector<std::uint8_t> rgb_bytes(const Image& image) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(image.pixels.size() * 3);
  for (const Rgb& c : image.pixels)
    for (const float value : {c.r, c.g, c.b}) bytes.push_back(to_byte(value));
  return bytes;
}

void fill_rect(Image& image, const Rect& rect, const Rgb& colour) {
  for (int y = rect.y; y < rect.y + rect.height; ++y)
    for (int x = rect.x; x < rect.x + rect.width; ++x) image.blend(x, y, colour, 1);
}

void draw_strokes(Image& image, const std::vector<std::array<Point, 2>>& segments, double width, const Rgb& colour) {
  if (segments.empty()) return;
  const double reach = width / 2 + 1;
  Point lo = segments[0][0], hi = lo;
  for (const auto& segment : segments) {
    for (const Point& p : segment) {
      lo = {std::min(lo.x, p.x - reach), std::min(lo.y, p.y - reach)};
      hi = {std::max(hi.x, p.x + reach), std::max(hi.y, p.y + reach)};
    }
  }
  const auto columns = clipped(lo.x, hi.x, image.width), rows = clipped(lo.y, hi.y, image.height);
  if (columns[0] > columns[1] || rows[0] > rows[1]) return;
  const auto stride = static_cast<std::size_t>(columns[1] - columns[0] + 1);
  std::vector<float> coverage(stride * static_cast<std::size_t>(rows[1] - rows[0] + 1));
  const auto cell = [&](int x, int y) -> float& {
    return coverage[static_cast<std::size_t>(y - rows[0]) * stride + static_cast<std::size_t>(x - columns[0])];
  };
  for (const auto& [a, b] : segments) {
    const auto xs = clipped(std::min(a.x, b.x) - reach, std::max(a.x, b.x) + reach, image.width);
    const auto ys = clipped(std::min(a.y, b.y) - reach, std::max(a.y, b.y) + reach, image.height);
    for (int y = ys[0]; y <= ys[1]; ++y) {
      for (int x = xs[0]; x <= xs[1]; ++x) {
        const double d = distance_to_segment({x + 0.5, y + 0.5}, a, b);
        cell(x, y) = std::max(cell(x, y), static_cast<float>(std::clamp(width / 2 + 0.5 - d, 0.0, 1.0)));
      }
    }
  }
  for (int y = rows[0]; y <= rows[1]; ++y)
    for (int x = columns[0]; x <= columns[1]; ++x) image.blend(x, y, colour, cell(x, y));
}

void round_corners(Image& image, const Rect& rect, double radius, const Rgb& outline, const Rgb& outside) {
  const double half_width = rect.width / 2.0, half_height = rect.height / 2.0;
  for (int y = rect.y; y < rect.y + rect.height; ++y) {
    for (int x = rect.x; x < rect.x + rect.width; ++x) {
      const double dx = std::abs(x + 0.5 - rect.x - half_width) - (half_width - radius);
      const double dy = std::abs(y + 0.5 - rect.y - half_height) - (half_height - radius);
      const double beyond = std::hypot(std::max(dx, 0.0), std::max(dy, 0.0)) + std::min(std::max(dx, dy), 0.0) - radius;
      image.blend(x, y, outline, static_cast<float>(std::clamp(1.5 - std::abs(beyond + 0.5), 0.0, 1.0)));
      image.blend(x, y, outside, static_cast<float>(std::clamp(beyond + 0.5, 0.0, 1.0)));
    }
  }
}

void blur(std::vector<float>& values, int width, int height, int radius, int passes) {
  const auto blur_lines = [&](int lines, int line_step, int count, int step) {
    std::vector<float> line(static_cast<std::size_t>(count));
    for (int l = 0; l < lines; ++l) {
      const auto cell = [&](int i) -> float& { return values[static_cast<std::size_t>(l * line_step + i * step)]; };
      for (int i = 0; i < count; ++i) line[static_cast<std::size_t>(i)] = cell(i);
      for (int i = 0; i < count; ++i) {
        float sum = 0;
        for (int j = std::max(0, i - radius); j <= std::min(count - 1, i + radius); ++j)
          sum += line[static_cast<std::size_t>(j)];
        cell(i) = sum / static_cast<float>(2 * radius + 1);
      }
    }
  };
  for (int pass = 0; pass < passes; ++pass) {
    blur_lines(height, width, width, 1);
    blur_lines(width, 1, height, width);
  }
}

TriangleTarget::TriangleTarget(int width, int height)
    : width_(width),
      height_(height),
      columns_(width * kSupersampling),
      rows_(height * kSupersampling),
      nearness_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)),
      colour_(nearness_.size()) {}

std::array<int, 2> TriangleTarget::columns_of(const std::array<ScreenPoint, 3>& p) const {
  return samples_within(std::min({p[0].x, p[1].x, p[2].x}), std::max({p[0].x, p[1].x, p[2].x}), 0, columns_);
}

std::array<int, 2> TriangleTarget::rows_of(const std::array<ScreenPoint, 3>& p, const Rows& rows) const {
  return samples_within(std::min({p[0].y, p[1].y, p[2].y}), std::max({p[0].y, p[1].y, p[2].y}), std::max(rows.begin, 0),
                        std::min(rows.end, rows_));
}

bool TriangleTarget::misses(const std::array<ScreenPoint, 3>& p, const Rows& rows) const {
  const auto ys = rows_of(p, rows);
  if (ys[0] > ys[1]) return true;
  const auto xs = columns_of(p);
  return xs[0] > xs[1];
}

void TriangleTarget::cover(const std::array<ScreenPoint, 3>& corners, const Rows& rows) {
  if (misses(corners, rows)) return;
  std::array<ScreenPoint, 3> p = corners;
  if (doubled_area(p) < 0) std::swap(p[1], p[2]);
  paint(p, rows, [](const std::array<double, 3>&) { return Rgb{}; });
}

// Side i lies opposite corner i: its value, which colour_at() takes, is twice the area between it and the place.
template <class ColourAt>
void TriangleTarget::paint(const std::array<ScreenPoint, 3>& p, const Rows& rows, const ColourAt& colour_at) {
  const auto xs = columns_of(p), ys = rows_of(p, rows);
  if (ys[0] > ys[1] || xs[0] > xs[1]) return;
  const double area = doubled_area(p);
  if (!(area > 0)) return;
  std::array<double, 3> step{};
  for (std::size_t i = 0; i < 3; ++i) step[i] = -(p[(i + 2) % 3].y - p[(i + 1) % 3].y);
  for (int y = ys[0]; y <= ys[1]; ++y) {
    std::array<double, 3> side{};
    for (std::size_t i = 0; i < 3; ++i) {
      const ScreenPoint &a = p[(i + 1) % 3], &b = p[(i + 2) % 3];
      side[i] = (b.x - a.x) * (y + 0.5 - a.y) - (b.y - a.y) * (xs[0] + 0.5 - a.x);
    }
    std::size_t at = static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(xs[0]);
    for (int x = xs[0]; x <= xs[1]; ++x, ++at) {
      if (side[0] >= 0 && side[1] >= 0 && side[2] >= 0) {
        const auto near =
            static_cast<float>((side[0] * p[0].nearness + side[1] * p[1].nearness + side[2] * p[2].nearness) / area);
        if (near > nearness_[at]) {
          nearness_[at] = near;
          const Rgb c = colour_at(side);
          colour_[at] = {to_byte(c.r), to_byte(c.g), to_byte(c.b), 255};
        }
      }
      for (std::size_t i = 0; i < 3; ++i) side[i] += step[i];
    }
  }
}

void TriangleTarget::draw(const std::array<ScreenPoint, 3>& corners, const Rgb& fill, const EdgeStyle& edge,
                          const Rows& rows) {
  std::array<ScreenPoint, 3> p = corners;
  if (doubled_area(p) < 0) std::swap(p[1], p[2]);
  std::array<double, 3> inverse_length{};
  for (std::size_t i = 0; i < 3; ++i) {
    const ScreenPoint &a = p[(i + 1) % 3], &b = p[(i + 2) % 3];
    inverse_length[i] = 1 / std::max(1e-9, std::hypot(b.x - a.x, b.y - a.y));
  }
  const double reach = edge.width * kSupersampling / 2 + 0.5;
  paint(p, rows, [&](const std::array<double, 3>& side) {
    // A side's value is the distance from it, times its length.
    const double d = std::min({side[0] * inverse_length[0], side[1] * inverse_length[1], side[2] * inverse_length[2]});
    return mix(fill, edge.colour, edge.alpha * static_cast<float>(std::clamp(reach - d, 0.0, 1.0)));
  });
}

void TriangleTarget::draw_smooth(const std::array<ScreenPoint, 3>& corners, const std::array<Rgb, 3>& colours,
                                 const Rows& rows) {
  std::array<ScreenPoint, 3> p = corners;
  std::array<Rgb, 3> c = colours;
  if (doubled_area(p) < 0) {
    std::swap(p[1], p[2]);
    std::swap(c[1], c[2]);
  }
  const double to_share = 1 / doubled_area(p);
  paint(p, rows, [&](const std::array<double, 3>& side) {
    const auto s0 = static_cast<float>(side[0] * to_share), s1 = static_cast<float>(side[1] * to_share);
    const float s2 = 1 - s0 - s1;
    return Rgb{c[0].r * s0 + c[1].r * s1 + c[2].r * s2, c[0].g * s0 + c[1].g * s1 + c[2].g * s2,
               c[0].b * s0 + c[1].b * s1 + c[2].b * s2};
  });
}

std::vector<float> TriangleTarget::coverage() const {
  std::vector<float> share(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
  for (int y = 0; y < rows_; ++y) {
    for (int x = 0; x < columns_; ++x) {
      if (nearness_[static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(x)] >
          0) {
        share[static_cast<std::size_t>(y / kSupersampling) * static_cast<std::size_t>(width_) +
              static_cast<std::size_t>(x / kSupersampling)] += 1.0F / (kSupersampling * kSupersampling);
      }
    }
  }
  return share;
}

float TriangleTarget::nearness_at(int x, int y) const {
  if (x < 0 || y < 0 || x >= width_ || y >= height_) return 0;
  constexpr int kMiddle = kSupersampling / 2;
  return nearness_[static_cast<std::size_t>(y * kSupersampling + kMiddle) * static_cast<std::size_t>(columns_) +
                   static_cast<std::size_t>(x * kSupersampling + kMiddle)];
}

std::vector<float> TriangleTarget::ambient() const {
  // Opposite neighbours in pairs: their mean equals the middle on a plane and is nearer in a hollow.
  struct Pair {
    int dx, dy;
  };
  constexpr std::array<Pair, 12> kPairs{
      {{3, 1}, {1, 3}, {-1, 3}, {-3, 1}, {9, 0}, {6, 6}, {0, 9}, {-6, 6}, {20, 8}, {8, 20}, {-8, 20}, {-20, 8}}};
  constexpr float kReach = 0.06F;    // Relative depth beyond which a neighbour has nothing to do with this place.
  constexpr float kStrength = 1.5F;  // Chosen by eye.
  std::vector<float> light(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), 1.0F);
  for_each_row(height_, [&](int y) {
    for (int x = 0; x < width_; ++x) {
      const float middle = nearness_at(x, y);
      if (middle <= 0) continue;
      float hollow = 0;
      for (const Pair& pair : kPairs) {
        const float a = nearness_at(x + pair.dx, y + pair.dy) / middle - 1;
        const float b = nearness_at(x - pair.dx, y - pair.dy) / middle - 1;
        hollow += std::max(0.0F, std::clamp(a, -kReach, kReach) + std::clamp(b, -kReach, kReach));
      }
      hollow /= 2 * kReach * static_cast<float>(kPairs.size());
      light[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)] =
          1 / (1 + kStrength * hollow);
    }
  });
  return light;
}

void TriangleTarget::resolve(Image& image, int x0, int y0) const {
  const std::vector<float> light = ambient();
  constexpr int kSamples = kSupersampling * kSupersampling;
  for_each_row(height_, [&](int y) {
    for (int x = 0; x < width_; ++x) {
      std::array<int, 4> sum{};
      for (int sy = 0; sy < kSupersampling; ++sy) {
        const std::size_t row = static_cast<std::size_t>(y * kSupersampling + sy) * static_cast<std::size_t>(columns_);
        for (int sx = 0; sx < kSupersampling; ++sx) {
          const auto& c = colour_[row + static_cast<std::size_t>(x * kSupersampling + sx)];
          for (std::size_t i = 0; i < 4; ++i) sum[i] += c[i];
        }
      }
      if (sum[3] == 0) continue;
      const float to_unit = 1 / static_cast<float>(sum[3]);
      const float l =
          light[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)];
      const Rgb colour{static_cast<float>(sum[0]) * to_unit, static_cast<float>(sum[1]) * to_unit,
                       static_cast<float>(sum[2]) * to_unit};
      image.blend(x0 + x, y0 + y, scaled(colour, l), static_cast<float>(sum[3]) / (255.0F * kSamples));
    }
  });
}

}  // namespace tetsoup
