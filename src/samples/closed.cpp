// Heart and sphere: closed surfaces, each point found along a ray from the middle.
#include "samples/formula.h"
#include "samples/shapes.h"

namespace tetsoup::samples {

namespace {

/// Direction through a point of the cube [-1, 1]^3, bent so that the cube's grid gives triangles of like size.
Vec3d direction_of(const Vec3d& on_cube) {
  const auto bend = [](double s) { return sine(s / 8) / cosine(s / 8); };
  return normalized({bend(on_cube.x), bend(on_cube.y), bend(on_cube.z)});
}

/// (x^2 + 9/4 y^2 + z^2 - 1)^3 = x^2 z^3 + 9/80 y^2 z^3, Taubin's heart; a ray from the middle meets it once.
double heart_radius(const Vec3d& d) {
  constexpr int kHalvings = 60;
  const double a = d.x * d.x + 2.25 * d.y * d.y + d.z * d.z;
  const double b = d.z * d.z * d.z * (d.x * d.x + 9.0 / 80 * d.y * d.y);
  double inside = 0, outside = 2;
  for (int i = 0; i < kHalvings; ++i) {
    const double r = (inside + outside) / 2;
    const double shell = a * r * r - 1;
    (shell * shell * shell < b * r * r * r * r * r ? inside : outside) = r;
  }
  return (inside + outside) / 2;
}

}  // namespace

TriangleSoup make_heart() {
  constexpr int kGrid = 20;  // Even, so that a row of vertices runs along the notch.
  TriangleSoup soup;
  add_cube_shell(soup, kGrid, [](const Vec3d& c) {
    const Vec3d d = direction_of(c);
    return d * heart_radius(d);
  });
  return soup;
}

TriangleSoup make_sphere() {
  constexpr int kGrid = 15;
  TriangleSoup soup;
  add_cube_shell(soup, kGrid, direction_of);
  return soup;
}

}  // namespace tetsoup::samples
