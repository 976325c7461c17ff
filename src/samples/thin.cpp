// Shapes of thin walls and narrow gaps: closed surfaces whose volume is that of their walls.
#include <array>

#include "samples/formula.h"
#include "samples/shapes.h"

namespace tetsoup::samples {

namespace {

constexpr int kSegments = 48;  // Around a cup or a pipe.

/// Rows of columns that close both ways, as on a torus: `at(row, column)` turns outwards where rows, then columns, are
/// counter-clockwise.
template <class At>
void add_wrapped_grid(TriangleSoup& soup, int rows, int columns, const At& at) {
  const auto first = static_cast<std::uint32_t>(soup.vertices.size());
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) soup.vertices.push_back(to_float(at(r, c)));
  const auto vertex = [&](int r, int c) {
    return first + static_cast<std::uint32_t>(r % rows * columns + c % columns);
  };
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      const std::array<std::uint32_t, 4> q{vertex(r, c), vertex(r + 1, c), vertex(r + 1, c + 1), vertex(r, c + 1)};
      soup.triangles.push_back({q[0], q[1], q[2]});
      soup.triangles.push_back({q[0], q[2], q[3]});
    }
  }
}

/// From one height or radius to the next in even steps, the last left to what follows.
void add_steps(std::vector<ProfilePoint>& profile, const ProfilePoint& from, const ProfilePoint& to, int steps) {
  for (int i = 0; i < steps; ++i) {
    const double t = static_cast<double>(i) / steps;
    profile.push_back({from.radius + (to.radius - from.radius) * t, from.height + (to.height - from.height) * t});
  }
}

/// A slab of rectangles of the plane of x and z, given by the lines between which they lie, `depth` thick along y.
/// Inner walls between two rectangles of the slab are left out.
template <class Has>
void add_slab(TriangleSoup& soup, const std::vector<double>& x, const std::vector<double>& z, double depth,
              const Has& has) {
  const auto columns = static_cast<int>(x.size()) - 1, rows = static_cast<int>(z.size()) - 1;
  std::vector<std::uint32_t> index(2 * x.size() * z.size(), ~0U);
  const auto vertex = [&](int i, int k, int side) {
    std::uint32_t& v = index[(static_cast<std::size_t>(k) * x.size() + static_cast<std::size_t>(i)) * 2 +
                             static_cast<std::size_t>(side)];
    if (v == ~0U) {
      v = static_cast<std::uint32_t>(soup.vertices.size());
      soup.vertices.push_back(to_float({x[static_cast<std::size_t>(i)], side * depth, z[static_cast<std::size_t>(k)]}));
    }
    return v;
  };
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    soup.triangles.push_back({a, b, c});
    soup.triangles.push_back({a, c, d});
  };
  const auto filled = [&](int i, int k) { return i >= 0 && k >= 0 && i < columns && k < rows && has(i, k); };
  for (int k = 0; k < rows; ++k) {
    for (int i = 0; i < columns; ++i) {
      if (!filled(i, k)) continue;
      add(vertex(i, k, 0), vertex(i + 1, k, 0), vertex(i + 1, k + 1, 0), vertex(i, k + 1, 0));
      add(vertex(i, k, 1), vertex(i, k + 1, 1), vertex(i + 1, k + 1, 1), vertex(i + 1, k, 1));
      if (!filled(i - 1, k)) add(vertex(i, k, 0), vertex(i, k + 1, 0), vertex(i, k + 1, 1), vertex(i, k, 1));
      if (!filled(i + 1, k))
        add(vertex(i + 1, k, 0), vertex(i + 1, k, 1), vertex(i + 1, k + 1, 1), vertex(i + 1, k + 1, 0));
      if (!filled(i, k - 1)) add(vertex(i, k, 0), vertex(i, k, 1), vertex(i + 1, k, 1), vertex(i + 1, k, 0));
      if (!filled(i, k + 1))
        add(vertex(i, k + 1, 0), vertex(i + 1, k + 1, 0), vertex(i + 1, k + 1, 1), vertex(i, k + 1, 1));
    }
  }
}

}  // namespace

TriangleSoup make_cup(double wall) {
  constexpr double kRadius = 0.5, kHeight = 1;
  std::vector<ProfilePoint> profile;
  add_steps(profile, {0, 0}, {kRadius, 0}, 6);
  add_steps(profile, {kRadius, 0}, {kRadius, kHeight}, 12);
  profile.push_back({kRadius, kHeight});
  add_steps(profile, {kRadius - wall, kHeight}, {kRadius - wall, wall}, 12);
  add_steps(profile, {kRadius - wall, wall}, {0, wall}, 6);
  profile.push_back({0, wall});
  TriangleSoup soup;
  add_lathe(soup, {}, profile, kSegments);
  return soup;
}

TriangleSoup make_pipe(double wall) {
  constexpr double kRadius = 0.25, kLength = 1;
  std::vector<ProfilePoint> ring;
  add_steps(ring, {kRadius, 0}, {kRadius, kLength}, 12);
  ring.push_back({kRadius, kLength});
  add_steps(ring, {kRadius - wall, kLength}, {kRadius - wall, 0}, 12);
  ring.push_back({kRadius - wall, 0});
  TriangleSoup soup;
  add_wrapped_grid(soup, kSegments, static_cast<int>(ring.size()), [&](int segment, int point) {
    const double turns = static_cast<double>(segment) / kSegments;
    const ProfilePoint& p = ring[static_cast<std::size_t>(point)];
    return Vec3d{p.radius * cosine(turns), p.radius * sine(turns), p.height};
  });
  return soup;
}

TriangleSoup make_tray(double wall) {
  constexpr double kWidth = 0.7, kHeight = 0.25;
  TriangleSoup soup;
  const auto ring = [&](double inset, double z) {
    soup.vertices.push_back(to_float({inset, inset, z}));
    soup.vertices.push_back(to_float({1 - inset, inset, z}));
    soup.vertices.push_back(to_float({1 - inset, kWidth - inset, z}));
    soup.vertices.push_back(to_float({inset, kWidth - inset, z}));
  };
  ring(0, 0), ring(0, kHeight), ring(wall, kHeight), ring(wall, wall);
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    soup.triangles.push_back({a, b, c});
    soup.triangles.push_back({a, c, d});
  };
  add(3, 2, 1, 0);
  for (std::uint32_t level = 0; level < 12; level += 4)
    for (std::uint32_t i = 0; i < 4; ++i) add(level + i, level + (i + 1) % 4, level + 4 + (i + 1) % 4, level + 4 + i);
  add(12, 13, 14, 15);
  return soup;
}

TriangleSoup make_comb(double wall) {
  constexpr int kTeeth = 8;
  constexpr double kSpine = 0.2, kHeight = 0.6, kDepth = 0.25;
  const double gap = (1 - kTeeth * wall) / (kTeeth - 1);
  std::vector<double> x;
  for (int tooth = 0; tooth < kTeeth; ++tooth)
    x.push_back(tooth * (wall + gap)), x.push_back(tooth * (wall + gap) + wall);
  x.back() = 1;
  TriangleSoup soup;
  add_slab(soup, x, {0, kSpine, kHeight}, kDepth, [](int i, int k) { return k == 0 || i % 2 == 0; });
  return soup;
}

TriangleSoup make_chain(double wall) {
  constexpr int kLinks = 8, kAround = 12, kAlong = 32, kBend = 12;  // kBend steps a bend, the rest is straight
  const double bend = 1.3 * wall;             // radius of the wire's axis: 1.6 walls of room within
  const double half = 0.5 - wall / 2 - bend;  // of the straight sides
  const double pitch = 1 - 2.1 * wall;        // links hang in each other a tenth of the wire apart
  // Point of the axis and its outward direction, around the link.
  const auto axis = [&](int step) -> std::array<std::array<double, 2>, 2> {
    constexpr int kSide = kAlong / 2 - kBend;
    const int side = step / (kAlong / 2), at = step % (kAlong / 2);
    const double sign = side == 0 ? 1 : -1;
    const double turns = at < kBend ? 0.5 * at / kBend - 0.25 : 0.25;
    const double along = at < kBend ? half : half - 2 * half * (at - kBend) / kSide;
    return {{{sign * (along + bend * cosine(turns)), sign * bend * sine(turns)},
             {sign * cosine(turns), sign * sine(turns)}}};
  };
  TriangleSoup soup;
  for (int link = 0; link < kLinks; ++link) {
    add_wrapped_grid(soup, kAlong, kAround, [&](int along, int around) {
      const auto [at, out] = axis(along);
      const double turns = static_cast<double>(around) / kAround;
      const double radial = wall / 2 * cosine(turns), across = wall / 2 * sine(turns);
      const Vec3d flat{at[0] + out[0] * radial, at[1] + out[1] * radial, across};
      const Vec3d turned = link % 2 == 0 ? flat : Vec3d{flat.x, -flat.z, flat.y};
      return turned + Vec3d{0.5 + link * pitch, 0, 0};
    });
  }
  return soup;
}

}  // namespace tetsoup::samples
