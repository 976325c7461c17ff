#include "io/pictures/text.h"

#include <array>
#include <string>

namespace tetsoup {

namespace {

// A glyph is strokes separated by blanks. A point is two characters: x counted from '0', y from 'e' (baseline; 'm' is
// the height of an x, 'q' of a capital, 'a' the deepest descender). '~' bends a stroke into a smooth curve, '@' into a
// closed one; a point written twice is a corner, a stroke of one point written twice is a dot.
constexpr char kFirstGlyph = '!', kLastGlyph = '~';
constexpr std::array<std::string_view, kLastGlyph - kFirstGlyph + 1> kGlyphs{
    "0q0i 0e0e",                                   // !
    "0q0n 3q3n",                                   // "
    "2q1e 6q5e 0m7m 0i7i",                         // #
    "~6n5p3p1p0n1l5j6h5f3f1f0h 3r3d",              // $
    "0e8q @3o2q1q0o1m2m @8g7i6i5g6e7e",            // %
    "~8e8e2m2m1o2q4q5o4m1j0h1f3e5f7i",             // &
    "0q0n",                                        // '
    "~2r0n0h2c",                                   // (
    "~0r2n2h0c",                                   // )
    "2q2k 0p4l 4p0l",                              // *
    "0j6j 3m3g",                                   // +
    "1e0c",                                        // ,
    "0j4j",                                        // -
    "0e0e",                                        // .
    "0d5q",                                        // /
    "@6k5o3q1o0k1g3e5g",                           // 0
    "0n3q3e",                                      // 1
    "~0n1p3q5p6n5k0e0e6e",                         // 2
    "~0o1p3q5p6n5l3k3k ~3k3k5j6h5f3e1f0g",         // 3
    "5e5q0h7h",                                    // 4
    "~6q6q1q1q0k0k3l5k6i5f3e1e0g",                 // 5
    "~5p3q1o0k0h0h @6h5k3l1k0h1f3e5f",             // 6
    "0q6q2e",                                      // 7
    "@5n4p3q2p1n2l3k4l @6h5j3k1j0h1f3e5f",         // 8
    "@6n5p3q1p0n1k3j5k ~6n6n6k5g3e1f",             // 9
    "0e0e 0l0l",                                   // :
    "1e0c 1l1l",                                   // ;
    "6m0j6g",                                      // <
    "0l6l 0h6h",                                   // =
    "0m6j0g",                                      // >
    "~0n1p3q5p6n5k3i3i3h 3e3e",                    // ?
    "~6h5k3k2i3g5g6h6h6k4m2l0i1f4e6e",             // @
    "0e4q8e 1i7i",                                 // A
    "0e0q ~0q0q4q6p7n6l4k4k0k ~4k4k7j8h7f4e4e0e",  // B
    "~8n7p4q1o0k1g4e7f8h",                         // C
    "0e0q ~0q0q3q7o8k7g3e3e0e",                    // D
    "7q0q0e7e 0k6k",                               // E
    "7q0q0e 0k6k",                                 // F
    "~8n7p4q1o0k1g4e7f8h8h8k8k5k",                 // G
    "0q0e 8q8e 0k8k",                              // H
    "0q0e",                                        // I
    "~5q5q5h4f2e0g",                               // J
    "0q0e 7q0i 2k7e",                              // K
    "0q0e6e",                                      // L
    "0e0q5g:q:e",                                  // M
    "0e0q8e8q",                                    // N
    "@8k7o4q1o0k1g4e7g",                           // O
    "0e0q ~0q0q4q6p7n6k4j4j0j",                    // P
    "@8k7o4q1o0k1g4e7g 5h8d",                      // Q
    "0e0q ~0q0q4q6p7n6k4j4j0j 4j7e",               // R
    "~7o5q2q0o1l6j7h5e2e0g",                       // S
    "0q8q 4q4e",                                   // T
    "~0q0q0i1f4e7f8i8i8q",                         // U
    "0q4e8q",                                      // V
    "0q3e6q9e<q",                                  // W
    "0q8e 8q0e",                                   // X
    "0q4k8q 4k4e",                                 // Y
    "0q7q0e7e",                                    // Z
    "2r0r0c2c",                                    // [
    "0q5d",                                        // backslash
    "0r2r2c0c",                                    // ]
    "0n3q6n",                                      // ^
    "0d7d",                                        // _
    "0q2o",                                        // `
    "@6i5l3m1l0i1f3e5f 6m6e",                      // a
    "0q0e @6i5l3m1l0i1f3e5f",                      // b
    "~6k5l3m1l0i1f3e5f6g",                         // c
    "6q6e @6i5l3m1l0i1f3e5f",                      // d
    "~0i0i6i6i5l3m1l0i1f3e5f6g",                   // e
    "~4q3q2o2o2e 0m4m",                            // f
    "@6i5l3m1l0i1f3e5f ~6m6m6d5b3a1b",             // g
    "0q0e ~0i1l3m5l6i6i6e",                        // h
    "0m0e 0p0p",                                   // i
    "~2m2m2c1a0a 2p2p",                            // j
    "0q0e 5m0h 2j5e",                              // k
    "0q0e",                                        // l
    "0m0e ~0i1l3m4l5i5i5e ~5i6l8m9l:i:i:e",        // m
    "0m0e ~0i1l3m5l6i6i6e",                        // n
    "@6i5l3m1l0i1f3e5f",                           // o
    "0m0a @6i5l3m1l0i1f3e5f",                      // p
    "6m6a @6i5l3m1l0i1f3e5f",                      // q
    "0m0e ~0i1l3m4m",                              // r
    "~5k4m2m0k1j4i5g4e2e0f",                       // s
    "~2p2p2g3e4e 0m4m",                            // t
    "~0m0m0i1f3e5f6i 6m6e",                        // u
    "0m3e6m",                                      // v
    "0m2e5m8e:m",                                  // w
    "0m5e 5m0e",                                   // x
    "0m3e 6m2b1a0a",                               // y
    "0m5m0e5e",                                    // z
    "~3r2r1p1l0j0j1i1e2c3c",                       // {
    "0r0c",                                        // |
    "~0r1r2p2l3j3j2i2e1c0c",                       // }
    "~0i1k2k4i5i6k",                               // ~
};
constexpr std::string_view kMissing = "0e0o5o5e0e";

constexpr double kUnits = 12;     // Per height of a capital.
constexpr double kSpacing = 2.9;  // Units between two glyphs.
constexpr double kBlank = 3.4;    // Units of a blank, on top of the spacing.
constexpr int kCurveSteps = 6;    // Segments between two points of a curve.

/// Byte count of the UTF-8 character at the start of `text`, at least 1.
std::size_t character_bytes(std::string_view text) {
  std::size_t count = 1;
  while (count < text.size() && (static_cast<unsigned char>(text[count]) & 0xC0U) == 0x80U) ++count;
  return count;
}

std::string_view glyph_of(char c) {
  return c >= kFirstGlyph && c <= kLastGlyph ? kGlyphs[static_cast<std::size_t>(c - kFirstGlyph)] : kMissing;
}

double glyph_width(char c) {
  if (c == ' ') return kBlank;
  double width = 0;
  const std::string_view glyph = glyph_of(c);
  for (std::size_t i = 0; i + 1 < glyph.size(); ++i) {
    if (glyph[i] == ' ' || glyph[i] == '~' || glyph[i] == '@') continue;
    width = std::max(width, static_cast<double>(glyph[i] - '0'));
    ++i;
  }
  return width;
}

/// Catmull-Rom between b and c.
Point on_curve(const Point& a, const Point& b, const Point& c, const Point& d, double t) {
  const auto blend = [t](double p, double q, double r, double s) {
    return q + 0.5 * t * (r - p + t * (2 * p - 5 * q + 4 * r - s + t * (3 * (q - r) + s - p)));
  };
  return {blend(a.x, b.x, c.x, d.x), blend(a.y, b.y, c.y, d.y)};
}

std::vector<Point> flattened(const std::vector<Point>& points, bool closed) {
  const std::size_t n = points.size();
  const auto at = [&](std::ptrdiff_t i) {
    const auto count = static_cast<std::ptrdiff_t>(n);
    return points[static_cast<std::size_t>(closed ? (i + count) % count : std::clamp<std::ptrdiff_t>(i, 0, count - 1))];
  };
  std::vector<Point> curve{points[0]};
  const auto spans = static_cast<std::ptrdiff_t>(closed ? n : n - 1);
  for (std::ptrdiff_t i = 0; i < spans; ++i) {
    for (int s = 1; s <= kCurveSteps; ++s)
      curve.push_back(on_curve(at(i - 1), at(i), at(i + 1), at(i + 2), static_cast<double>(s) / kCurveSteps));
  }
  return curve;
}

/// Appends the strokes of one glyph, its origin at `origin`.
void add_glyph(std::string_view glyph, const Point& origin, double scale, std::vector<std::array<Point, 2>>& segments) {
  while (!glyph.empty()) {
    std::string_view stroke = glyph.substr(0, glyph.find(' '));
    glyph.remove_prefix(std::min(glyph.size(), stroke.size() + 1));
    const char kind = stroke[0];
    if (kind == '~' || kind == '@') stroke.remove_prefix(1);
    std::vector<Point> points;
    for (std::size_t i = 0; i + 1 < stroke.size(); i += 2)
      points.push_back({origin.x + scale * (stroke[i] - '0'), origin.y - scale * (stroke[i + 1] - 'e')});
    if (kind == '~' || kind == '@') points = flattened(points, kind == '@');
    for (std::size_t i = 0; i + 1 < points.size(); ++i) segments.push_back({points[i], points[i + 1]});
  }
}

}  // namespace

double text_width(std::string_view text, const TextStyle& style) {
  double width = -kSpacing;
  for (; !text.empty(); text.remove_prefix(character_bytes(text))) width += glyph_width(text[0]) + kSpacing;
  return std::max(0.0, width) * style.size / kUnits;
}

void draw_text(Image& image, double x, double y, std::string_view text, const TextStyle& style, double max_width) {
  std::string line(text);
  if (text_width(line, style) > max_width) {
    const auto drop_last = [&] {
      while (!line.empty() && (static_cast<unsigned char>(line.back()) & 0xC0U) == 0x80U) line.pop_back();
      if (!line.empty()) line.pop_back();
    };
    while (!line.empty() && text_width(line + "...", style) > max_width) drop_last();
    line += "...";
  }
  const double scale = style.size / kUnits;
  std::vector<std::array<Point, 2>> segments;
  for (std::string_view rest = line; !rest.empty(); rest.remove_prefix(character_bytes(rest))) {
    if (rest[0] != ' ') add_glyph(glyph_of(rest[0]), {x, y}, scale, segments);
    x += (glyph_width(rest[0]) + kSpacing) * scale;
  }
  draw_strokes(image, segments, style.weight * style.size, style.colour);
}

}  // namespace tetsoup
