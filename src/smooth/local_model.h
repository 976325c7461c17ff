// What is wrong around one vertex as a quadratic model, whose least is where it moves.
#pragma once

#include "base/tet_geometry.h"
#include "base/vec.h"
#include "smooth/guard.h"
#include "tetsoup/types.h"

namespace tetsoup {

/// gradient . d + d . hessian d / 2 for a move d of one vertex, in mean edges.
struct LocalModel {
  Vec3d gradient;
  double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;

  /// weight (away + n . d)^2
  void add_plane(const Vec3d& n, double away, double weight) {
    gradient += n * (2 * weight * away);
    add_square(n, 2 * weight);
  }
  void add_square(const Vec3d& v, double w) {
    xx += w * v.x * v.x, xy += w * v.x * v.y, xz += w * v.x * v.z;
    yy += w * v.y * v.y, yz += w * v.y * v.z, zz += w * v.z * v.z;
  }
  void add_isotropic(double w) { xx += w, yy += w, zz += w; }

  /// Where the model is least: - hessian^-1 gradient, by Cholesky's way.
  Vec3d step() const {
    const double l21 = xy / xx, l31 = xz / xx;
    const double d2 = yy - l21 * xy, m = yz - l31 * xy, l32 = m / d2;
    const double d3 = zz - l31 * xz - l32 * m;
    const double y1 = -gradient.x, y2 = -gradient.y - l21 * y1, y3 = -gradient.z - l31 * y1 - l32 * y2;
    const double z = y3 / d3, y = y2 / d2 - l32 * z, x = y1 / xx - l21 * y - l31 * z;
    return {x, y, z};
  }
};

/// The shape of a tet as a vertex of it moves, 1 for a regular one.
///
/// f = 1 / q^3 = S^3 / (15552 V^2) with the mean ratio q and the sum S of the squared edges. With s = grad S / S and
/// u = grad V / V its gradient is f (3 s - 2 u), its second derivative f (6 (s - u)(s - u)' + 18 / S), never negative.
inline void add_shape(std::uint32_t v, const Tet& corners, const GuardedMesh& mesh, double to_edges,
                      LocalModel& model) {
  std::size_t own = 0;
  while (corners[own] != v) ++own;
  const auto& face = kTetFaces[own];
  const Vec3d at = mesh.at(v);
  const auto arm = [&](std::size_t i) { return (mesh.at(corners[static_cast<std::size_t>(face[i])]) - at) * to_edges; };
  const Vec3d a = arm(0), b = arm(1), c = arm(2);
  const Vec3d normal = cross(b - a, c - a);
  const double six_volumes = dot(normal, a);
  const double sum = squared_length(a) + squared_length(b) + squared_length(c) + squared_length(b - a) +
                     squared_length(c - a) + squared_length(c - b);
  const double f = sum * sum * sum / (432 * six_volumes * six_volumes);
  const Vec3d s = (a + b + c) * (-2 / sum), u = normal * (-1 / six_volumes);
  model.gradient += (s * 3 - u * 2) * f;
  model.add_square(s - u, 6 * f);
  model.add_isotropic(18 * f / sum);
}

}  // namespace tetsoup
