#include "samples/formula.h"

#include <array>
#include <vector>

namespace tetsoup::samples {

namespace {

constexpr double kTwoPi = 6.283185307179586;

std::uint32_t add_vertex(TriangleSoup& soup, const Vec3d& p) {
  soup.vertices.push_back(to_float(p));
  return static_cast<std::uint32_t>(soup.vertices.size() - 1);
}

}  // namespace

std::uint64_t Random::next() {
  std::uint64_t z = (state_ += 0x9e3779b97f4a7c15U);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
  return z ^ (z >> 31);
}

Vec3d Random::direction() {
  const double z = between(-1, 1);
  const double turns = uniform();
  const double r = std::sqrt(1 - z * z);
  return {r * cosine(turns), r * sine(turns), z};
}

double sine(double turns) {
  double t = turns - std::floor(turns + 0.5);
  if (t > 0.25) t = 0.5 - t;
  if (t < -0.25) t = -0.5 - t;
  const double x = kTwoPi * t;
  double sum = 1;
  // Taylor series; 21 is the last power above rounding for a quarter turn.
  for (int power = 21; power >= 3; power -= 2) sum = 1 - sum * x * x / (power * (power - 1));
  return sum * x;
}

double cosine(double turns) {
  return sine(turns + 0.25);
}

Vec3d normalized(const Vec3d& v) {
  return v * (1 / length(v));
}

Frame frame_along(const Vec3d& from, const Vec3d& to) {
  const Vec3d z = normalized(to - from);
  const Vec3d helper = std::abs(z.y) < 0.9 ? Vec3d{0, 1, 0} : Vec3d{1, 0, 0};
  const Vec3d x = normalized(cross(helper, z));
  return {from, x, cross(z, x), z};
}

void add_loose_triangle(TriangleSoup& soup, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const std::uint32_t first = add_vertex(soup, a);
  add_vertex(soup, b);
  add_vertex(soup, c);
  soup.triangles.push_back({first, first + 1, first + 2});
}

void add_cube_shell(TriangleSoup& soup, int n, const std::function<Vec3d(const Vec3d&)>& shape) {
  constexpr std::uint32_t kUnset = ~0U;
  const auto side = static_cast<std::size_t>(n + 1);
  std::vector<std::uint32_t> index(side * side * side, kUnset);
  const auto vertex = [&](const std::array<int, 3>& g) {
    auto& i = index[static_cast<std::size_t>(g[0]) +
                    side * (static_cast<std::size_t>(g[1]) + side * static_cast<std::size_t>(g[2]))];
    if (i == kUnset) i = add_vertex(soup, shape({2.0 * g[0] / n - 1, 2.0 * g[1] / n - 1, 2.0 * g[2] / n - 1}));
    return i;
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const int level : {0, n}) {
      for (int v = 0; v < n; ++v) {
        for (int u = 0; u < n; ++u) {
          const auto corner = [&](int du, int dv) {
            std::array<int, 3> g{};
            g[axis] = level;
            g[(axis + 1) % 3] = u + du;
            g[(axis + 2) % 3] = v + dv;
            return vertex(g);
          };
          std::array<std::uint32_t, 4> q{corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)};
          if (level == 0) std::swap(q[1], q[3]);
          // Diagonals mirror-symmetric about the middle of the face.
          const std::size_t s = (2 * u < n) == (2 * v < n) ? 0 : 1;
          soup.triangles.push_back({q[s], q[s + 1], q[s + 2]});
          soup.triangles.push_back({q[s], q[s + 2], q[(s + 3) % 4]});
        }
      }
    }
  }
}

void add_rounded_box(TriangleSoup& soup, const Frame& frame, const Vec3d& half, double rounding, int n) {
  const Vec3d core = half - Vec3d{rounding, rounding, rounding};
  add_cube_shell(soup, n, [&](const Vec3d& c) {
    // The sine gathers grid lines at the edges, where the box bends.
    const Vec3d p{half.x * sine(c.x / 4), half.y * sine(c.y / 4), half.z * sine(c.z / 4)};
    const Vec3d inner = max(min(p, core), core * -1);
    return frame.at(inner + rounding * normalized(p - inner));
  });
}

void add_lathe(TriangleSoup& soup, const Frame& frame, std::span<const ProfilePoint> profile, int segments) {
  const auto count = static_cast<std::uint32_t>(segments);
  const std::uint32_t bottom = add_vertex(soup, frame.at({0, 0, profile.front().height}));
  const std::uint32_t rings = bottom + 1;
  for (const ProfilePoint& p : profile.subspan(1, profile.size() - 2)) {
    for (int s = 0; s < segments; ++s) {
      const double turns = static_cast<double>(s) / segments;
      add_vertex(soup, frame.at({p.radius * cosine(turns), p.radius * sine(turns), p.height}));
    }
  }
  const std::uint32_t top = add_vertex(soup, frame.at({0, 0, profile.back().height}));
  const std::uint32_t last = top - count;
  for (std::uint32_t s = 0; s < count; ++s) {
    const std::uint32_t t = (s + 1) % count;
    soup.triangles.push_back({bottom, rings + t, rings + s});
    for (std::uint32_t ring = rings; ring < last; ring += count) {
      soup.triangles.push_back({ring + s, ring + t, ring + count + t});
      soup.triangles.push_back({ring + s, ring + count + t, ring + count + s});
    }
    soup.triangles.push_back({last + s, last + t, top});
  }
}

void add_ball(TriangleSoup& soup, const Vec3d& centre, double radius, int segments) {
  std::vector<ProfilePoint> profile;
  const int rings = segments / 2;
  for (int i = 0; i <= rings; ++i) {
    const double turns = 0.5 * i / rings - 0.25;
    profile.push_back({radius * cosine(turns), radius * sine(turns)});
  }
  add_lathe(soup, {centre}, profile, segments);
}

void add_capsule(TriangleSoup& soup, const Vec3d& from, const Vec3d& to, double r0, double r1, int segments) {
  constexpr int kBodyRings = 4;
  const double reach = length(to - from);
  const int cap_rings = segments / 4;
  std::vector<ProfilePoint> profile;
  for (int i = 0; i <= cap_rings; ++i) {
    const double turns = 0.25 * i / cap_rings - 0.25;
    profile.push_back({r0 * cosine(turns), r0 * sine(turns)});
  }
  for (int i = 1; i < kBodyRings; ++i) {
    const double t = static_cast<double>(i) / kBodyRings;
    profile.push_back({r0 + (r1 - r0) * t, reach * t});
  }
  for (int i = 0; i <= cap_rings; ++i) {
    const double turns = 0.25 * i / cap_rings;
    profile.push_back({r1 * cosine(turns), reach + r1 * sine(turns)});
  }
  add_lathe(soup, frame_along(from, to), profile, segments);
}

void add_disc(TriangleSoup& soup, const Vec3d& from, const Vec3d& to, double radius, double rounding, int segments) {
  constexpr int kRimRings = 4;
  const double thickness = length(to - from);
  std::vector<ProfilePoint> profile{{0, 0}, {(radius - rounding) / 2, 0}};
  for (int i = 0; i <= kRimRings; ++i) {
    const double turns = 0.25 * i / kRimRings - 0.25;
    profile.push_back({radius - rounding + rounding * cosine(turns), rounding + rounding * sine(turns)});
  }
  for (int i = 0; i <= kRimRings; ++i) {
    const double turns = 0.25 * i / kRimRings;
    profile.push_back({radius - rounding + rounding * cosine(turns), thickness - rounding + rounding * sine(turns)});
  }
  profile.push_back({(radius - rounding) / 2, thickness});
  profile.push_back({0, thickness});
  add_lathe(soup, frame_along(from, to), profile, segments);
}

void add_bark(TriangleSoup& soup, const Tube& tube, Random& random) {
  constexpr double kShrink = 0.95;      // Of a triangle about its centre, so that no two touch.
  constexpr double kRoughness = 0.04;   // In radii.
  constexpr double kDifference = 1e-3;  // In t, for the direction of the axis.
  const auto point = [&](double turns, double t) {
    const Vec3d ahead = tube.centre(t + kDifference), behind = tube.centre(t - kDifference);
    Frame frame = frame_along(behind, ahead);
    frame.origin = tube.centre(t);
    return frame.at(tube.radius(t) * Vec3d{cosine(turns), sine(turns), 0});
  };
  const auto add = [&](std::array<Vec3d, 3> p, double t) {
    const Vec3d middle = (p[0] + p[1] + p[2]) * (1.0 / 3);
    const Vec3d push = normalized(middle - tube.centre(t)) * (kRoughness * tube.radius(t) * random.between(-1, 1));
    for (Vec3d& q : p) q = middle + (q - middle) * kShrink + push;
    add_loose_triangle(soup, p[0], p[1], p[2]);
  };
  for (int row = 0; row < tube.along; ++row) {
    const double t0 = static_cast<double>(row) / tube.along, t1 = (row + 1.0) / tube.along;
    for (int column = 0; column < tube.around; ++column) {
      const double u0 = (column + 0.5 * row) / tube.around, step = 1.0 / tube.around;
      add({point(u0, t0), point(u0 + step, t0), point(u0 + step / 2, t1)}, (t0 + t1) / 2);
      add({point(u0 + step, t0), point(u0 + 1.5 * step, t1), point(u0 + step / 2, t1)}, (t0 + t1) / 2);
    }
  }
}

void add_leaf(TriangleSoup& soup, const Vec3d& base, const Vec3d& along, const Vec3d& normal, double width) {
  const Vec3d side = normalized(cross(normal, along)) * (width / 2);
  add_loose_triangle(soup, base + side, base - side, base + along);
}

}  // namespace tetsoup::samples
