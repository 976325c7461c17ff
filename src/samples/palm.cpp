// The palm: a leaning ringed trunk of loose bark under a crown of fronds, each frond two rows of loose leaflets.
#include "samples/formula.h"
#include "samples/shapes.h"

namespace tetsoup::samples {

namespace {

constexpr double kHeight = 2.6;
constexpr double kTrunkRings = 9;

Vec3d trunk_centre(double t) {
  return {0.75 * t * t, 0.10 * t * (1 - t), kHeight * t};
}

double trunk_radius(double t) {
  const double foot = std::max(0.0, 1 - 5 * t);
  const double since_ring = kTrunkRings * t - std::floor(kTrunkRings * t);
  return 0.15 - 0.045 * t + 0.09 * foot * foot + 0.018 * since_ring;
}

/// A frond rises from the trunk's top, bends over and hangs.
struct Frond {
  Vec3d root;
  Vec3d outwards, sideways;  ///< Level.
  double length, rise, fall;
  Vec3d rib(double t) const {
    return root + outwards * (length * t * (1 - 0.15 * t * t)) + Vec3d{0, 0, rise * t - fall * t * t};
  }
};

/// Leaflets lean forward and hang on both sides of the rib; widest a third of the way out.
void add_frond(TriangleSoup& soup, const Frond& frond, Random& random) {
  constexpr int kLeaflets = 30;
  constexpr double kHang = 0.55;
  constexpr double kReach = 0.62;
  for (int i = 0; i < kLeaflets; ++i) {
    const double t = (i + 0.6) / kLeaflets;
    const Vec3d base = frond.rib(t), ahead = normalized(frond.rib(t + 0.02) - frond.rib(t - 0.02));
    const double reach = kReach * std::sqrt(std::sqrt(t)) * (1.12 - t);
    for (const double side : {-1.0, 1.0}) {
      const Vec3d out = normalized(side * frond.sideways + 0.45 * ahead + Vec3d{0, 0, -kHang});
      const double share = random.between(0.9, 1.05);  // first: compilers evaluate operands in different orders
      const Vec3d along = (out + 0.08 * random.direction()) * (reach * share);
      add_leaf(soup, base + out * 0.012, along, cross(ahead, out) + 0.1 * random.direction(), 0.085);
    }
    // The rib itself, as flakes end to end.
    add_leaf(soup, frond.rib(t - 0.015), frond.rib(t + 0.015) - frond.rib(t - 0.015), {0, 0, 1}, 0.05);
  }
}

/// A coconut of loose triangles.
void add_nut(TriangleSoup& soup, const Vec3d& centre, double radius) {
  constexpr double kShrink = 0.95;
  TriangleSoup ball;
  add_ball(ball, centre, radius, 10);
  for (const Triangle& t : ball.triangles) {
    const Vec3d a = to_double(ball.vertices[t[0]]), b = to_double(ball.vertices[t[1]]),
                c = to_double(ball.vertices[t[2]]);
    const Vec3d middle = (a + b + c) * (1.0 / 3);
    const auto shrunk = [&](const Vec3d& p) { return middle + (p - middle) * kShrink; };
    add_loose_triangle(soup, shrunk(a), shrunk(b), shrunk(c));
  }
}

void add_fronds(TriangleSoup& soup, const Vec3d& top, Random& random) {
  struct Whorl {
    int count;
    double start, length, rise, fall;
  };
  // From the hanging old fronds to the upright young ones.
  for (const Whorl& whorl :
       {Whorl{7, 0.00, 1.25, 0.55, 1.45}, Whorl{6, 0.07, 1.20, 1.00, 1.35}, Whorl{4, 0.03, 0.75, 1.35, 0.95}}) {
    for (int i = 0; i < whorl.count; ++i) {
      const double turns = whorl.start + (i + random.between(-0.12, 0.12)) / whorl.count;
      const Vec3d outwards{cosine(turns), sine(turns), 0};
      const double size = random.between(0.92, 1.08);
      add_frond(soup,
                {top + outwards * 0.05,
                 outwards,
                 {-outwards.y, outwards.x, 0},
                 whorl.length * size,
                 whorl.rise * size,
                 whorl.fall * size},
                random);
    }
  }
}

}  // namespace

TriangleSoup make_palm(std::uint64_t seed) {
  Random random(seed);
  TriangleSoup soup;
  add_bark(soup, {trunk_centre, trunk_radius, 18, 45}, random);
  const Vec3d top = trunk_centre(1);
  add_fronds(soup, top, random);
  for (const double turns : {0.05, 0.38, 0.72})
    add_nut(soup, top + Vec3d{0.15 * cosine(turns), 0.15 * sine(turns), -0.13}, 0.11);
  return soup;
}

}  // namespace tetsoup::samples
