// What the samples are made of: random numbers and sines that have the same bits everywhere, and a few kinds of parts.
//
// The standard library's sin, cos and distributions differ from one platform to the next; +, -, *, / and sqrt do not.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

#include "base/vec.h"

namespace tetsoup::samples {

/// splitmix64 (Steele, Lea, Flood 2014).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next();
  double uniform() { return static_cast<double>(next() >> 11) * 0x1p-53; }  ///< [0, 1)
  std::size_t below(std::size_t count) { return static_cast<std::size_t>(next() % count); }
  double between(double low, double high) { return low + (high - low) * uniform(); }
  Vec3d direction();  ///< Unit length, all directions alike.

 private:
  std::uint64_t state_;
};

/// Sine and cosine of an angle in turns, to a few units of the last place.
double sine(double turns);
double cosine(double turns);

Vec3d normalized(const Vec3d& v);

/// Where a part stands: an origin and three orthonormal axes.
struct Frame {
  Vec3d origin;
  Vec3d x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  Vec3d at(const Vec3d& p) const { return origin + p.x * x + p.y * y + p.z * z; }
};

/// Stands at `from` and looks along z to `to`.
Frame frame_along(const Vec3d& from, const Vec3d& to);

/// A triangle with three vertices of its own.
void add_loose_triangle(TriangleSoup& soup, const Vec3d& a, const Vec3d& b, const Vec3d& c);

/// The surface of the cube [-1, 1]^3 cut into 12 n^2 triangles, every vertex moved by `shape`; closed, looks outwards.
void add_cube_shell(TriangleSoup& soup, int n, const std::function<Vec3d(const Vec3d&)>& shape);

/// A box with rounded edges, half sizes `half`, 12 n^2 triangles.
void add_rounded_box(TriangleSoup& soup, const Frame& frame, const Vec3d& half, double rounding, int n);

struct ProfilePoint {
  double radius = 0, height = 0;
};

/// Turns a profile, which begins and ends on the axis, about the frame's z axis; closed, looks outwards.
void add_lathe(TriangleSoup& soup, const Frame& frame, std::span<const ProfilePoint> profile, int segments);

void add_ball(TriangleSoup& soup, const Vec3d& centre, double radius, int segments);

/// A limb with round ends whose radius goes from r0 at `from` to r1 at `to`.
void add_capsule(TriangleSoup& soup, const Vec3d& from, const Vec3d& to, double r0, double r1, int segments);

/// A disc with rounded rim between `from` and `to`.
void add_disc(TriangleSoup& soup, const Vec3d& from, const Vec3d& to, double radius, double rounding, int segments);

struct Tube {
  std::function<Vec3d(double)> centre;   ///< Over t in [0, 1].
  std::function<double(double)> radius;  ///< Over t in [0, 1].
  int around = 0, along = 0;             ///< Quads, two triangles each.
};

/// The side of a tube as bark: loose triangles, each a little smaller than its place and pushed in or out at random.
void add_bark(TriangleSoup& soup, const Tube& tube, Random& random);

/// A pointed loose triangle from `base` along `along`, its flat side towards `normal`.
void add_leaf(TriangleSoup& soup, const Vec3d& base, const Vec3d& along, const Vec3d& normal, double width);

}  // namespace tetsoup::samples
