// A small software rasteriser: pictures, anti-aliased strokes, and a supersampled depth-buffered triangle target.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/vec.h"

namespace tetsoup {

/// sRGB, each 0..1.
struct Rgb {
  float r = 0, g = 0, b = 0;
};

constexpr Rgb rgb(std::uint32_t hex) {
  return {static_cast<float>((hex >> 16) & 255U) / 255, static_cast<float>((hex >> 8) & 255U) / 255,
          static_cast<float>(hex & 255U) / 255};
}
inline Rgb mix(const Rgb& a, const Rgb& b, float t) {
  return {a.r + (b.r - a.r) * t, a.g + (b.g - a.g) * t, a.b + (b.b - a.b) * t};
}
inline Rgb scaled(const Rgb& c, float s) {
  return {std::min(1.0F, c.r * s), std::min(1.0F, c.g * s), std::min(1.0F, c.b * s)};
}

struct Rect {
  int x = 0, y = 0, width = 0, height = 0;
};

struct Image {
  int width = 0, height = 0;
  std::vector<Rgb> pixels;

  Image(int w, int h, const Rgb& fill)
      : width(w), height(h), pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), fill) {}
  Rgb& at(int x, int y) {
    return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
  }
  /// Mixes a colour in; pixels beyond the picture are ignored.
  void blend(int x, int y, const Rgb& colour, float alpha);
};

/// Three bytes a pixel, row after row.
std::vector<std::uint8_t> rgb_bytes(const Image& image);

/// A point in pixels, y down.
struct Point {
  double x = 0, y = 0;
};

void fill_rect(Image& image, const Rect& rect, const Rgb& colour);

/// Round-ended line segments of one width, drawn as one shape: where they overlap nothing gets darker.
void draw_strokes(Image& image, const std::vector<std::array<Point, 2>>& segments, double width, const Rgb& colour);

/// A rounded rectangle's outline one pixel wide, and `outside` colour in the four corners beyond it.
void round_corners(Image& image, const Rect& rect, double radius, const Rgb& outline, const Rgb& outside);

/// Rows of numbers smoothed by box filters of 2 `radius` + 1, run `passes` times along rows and columns; zero beyond
/// the edges.
void blur(std::vector<float>& values, int width, int height, int radius, int passes);

/// A corner on the screen: supersampled pixels, y down, and one over the distance from the eye, so that planes are
/// linear.
struct ScreenPoint {
  double x = 0, y = 0, nearness = 0;
};

/// How the edges of a triangle are drawn.
struct EdgeStyle {
  Rgb colour;
  double width = 1;  ///< Pixels of the final picture.
  float alpha = 1;
};

/// Rows of samples; of those that a target has.
struct Rows {
  int begin = 0, end = 1 << 30;
};

/// Depth-buffered triangles at kSupersampling times the resolution.
class TriangleTarget {
 public:
  static constexpr int kSupersampling = 3;

  TriangleTarget(int width, int height);

  /// Only rows in `rows` are touched: threads may draw different ones at a time.
  void draw(const std::array<ScreenPoint, 3>& corners, const Rgb& fill, const EdgeStyle& edge, const Rows& rows = {});
  /// A colour for every corner, blended between them.
  void draw_smooth(const std::array<ScreenPoint, 3>& corners, const std::array<Rgb, 3>& colours, const Rows& rows = {});
  /// No colour, for coverage() alone.
  void cover(const std::array<ScreenPoint, 3>& corners, const Rows& rows = {});
  /// True of a triangle that lies between the samples of these rows, as most of a fine surface do.
  bool misses(const std::array<ScreenPoint, 3>& corners, const Rows& rows = {}) const;
  int row_count() const { return rows_; }

  /// Share of every pixel that triangles cover.
  std::vector<float> coverage() const;

  /// Lays the triangles over `image` at (x, y), corners darkened as ambient light would leave them.
  void resolve(Image& image, int x, int y) const;

 private:
  template <class ColourAt>
  void paint(const std::array<ScreenPoint, 3>& p, const Rows& rows, const ColourAt& colour_at);
  std::array<int, 2> columns_of(const std::array<ScreenPoint, 3>& p) const;
  std::array<int, 2> rows_of(const std::array<ScreenPoint, 3>& p, const Rows& rows) const;
  float nearness_at(int x, int y) const;
  std::vector<float> ambient() const;

  int width_, height_;           ///< Of the final picture.
  int columns_, rows_;           ///< Samples.
  std::vector<float> nearness_;  ///< 0 = nothing drawn.
  std::vector<std::array<std::uint8_t, 4>> colour_;
};

}  // namespace tetsoup
