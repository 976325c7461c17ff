#include "simulate/rigid_fit.h"

#include <cmath>

#include "base/vec.h"

namespace tetsoup::simulate {
namespace {

using kernel::MotionSums;

/// A tensor of inertia that is this much flatter than a ball's has no inverse worth having.
constexpr double kFlattest = 1e-12;

struct Inertia {
  Vec3d r0, r1, r2;  ///< Rows.

  Vec3d spin(const Vec3d& momentum) const {
    const Vec3d c0 = cross(r1, r2), c1 = cross(r2, r0), c2 = cross(r0, r1);
    const double determinant = dot(r0, c0), trace = r0.x + r1.y + r2.z;
    if (!(determinant > kFlattest * trace * trace * trace)) return {};
    return (c0 * momentum.x + c1 * momentum.y + c2 * momentum.z) * (1 / determinant);
  }
};

}  // namespace

RigidFit fit_rigid_motion(const MotionSums& sums) {
  const auto& s = sums.values;
  const auto vector = [&](std::size_t i) { return Vec3d{s[i], s[i + 1], s[i + 2]}; };
  const double mass = s[MotionSums::Mass];
  RigidFit fit;
  if (!(mass > 0)) return fit;
  const Vec3d c = fit.centre = vector(MotionSums::X) * (1 / mass);
  const double xx = s[MotionSums::Xx] - mass * c.x * c.x, yy = s[MotionSums::Yy] - mass * c.y * c.y,
               zz = s[MotionSums::Zz] - mass * c.z * c.z;
  const double xy = s[MotionSums::Xy] - mass * c.x * c.y, xz = s[MotionSums::Xz] - mass * c.x * c.z,
               yz = s[MotionSums::Yz] - mass * c.y * c.z;
  const Inertia inertia{{yy + zz, -xy, -xz}, {-xy, xx + zz, -yz}, {-xz, -yz, xx + yy}};
  const Vec3d linear = vector(MotionSums::Dx), angular = vector(MotionSums::Rdx);
  fit.displacement = {to_float(linear * (1 / mass)), to_float(inertia.spin(angular - cross(c, linear)))};
  return fit;
}

}  // namespace tetsoup::simulate
