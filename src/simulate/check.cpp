#include "simulate/check.h"

#include <sstream>
#include <utility>

#include "base/require.h"

namespace tetsoup::simulate {
namespace {

constexpr double kMaxDensity = 1e6, kMinDensity = 1e-3;  ///< kg/m^3
constexpr double kMaxYoung = 1e13, kMinYoung = 1e-3;     ///< Pa: ten times diamond's, a puff of foam's.
constexpr double kMaxPoisson = 0.4999;
constexpr double kMaxDampingTime = 10;  ///< s
constexpr double kMaxScale = 1e6, kMinScale = 1e-6;
constexpr double kMaxGravity = 1e4;     ///< m/s^2
constexpr double kMaxSpin = 1e4;        ///< rad/s
constexpr double kMaxStiffness = 1e12;  ///< J

bool within(double v, double lo, double hi) {
  return v >= lo && v <= hi;
}

}  // namespace

void check_point(const Vec3d& p, std::string_view name, double limit) {
  for (const double v : {p.x, p.y, p.z}) {
    std::ostringstream range;
    range << "finite and within -" << limit << " and " << limit;
    require(within(v, -limit, limit), name, v, range.str());
  }
}

void check(const SimulationOptions& options) {
  check_point(options.gravity, "gravity", kMaxGravity);
  require(options.substeps >= 1 && options.substeps <= kMaxSubsteps, "substeps", options.substeps, "1 to 10000");
  require(options.max_substeps >= 1 && options.max_substeps <= kMaxSubsteps, "max_substeps", options.max_substeps,
          "1 to 10000");
  require(options.contact_interval >= 1, "contact_interval", options.contact_interval, "at least 1");
  const PotentialOptions& p = options.potentials;
  for (const auto& [name, stiffness] :
       {std::pair("distance", p.distance), std::pair("area", p.area), std::pair("volume", p.volume)})
    if (stiffness) require(within(*stiffness, 0, kMaxStiffness), name, *stiffness, "0 to 1e12 J");
}

void check(const SimMaterial& m) {
  require(within(m.elastic.density, kMinDensity, kMaxDensity), "density", m.elastic.density, "0.001 to 1e6 kg/m^3");
  require(within(m.elastic.young, kMinYoung, kMaxYoung), "young", m.elastic.young, "0.001 to 1e13 Pa");
  require(within(m.elastic.poisson, 0, kMaxPoisson), "poisson", m.elastic.poisson, "0 to 0.4999");
  require(within(m.elastic.metres_per_unit, kMinScale, kMaxScale), "metres_per_unit", m.elastic.metres_per_unit,
          "1e-6 to 1e6");
  require(within(m.damping_time, 0, kMaxDampingTime), "damping_time", m.damping_time, "0 to 10 s");
  check_friction(m.friction);
}

void check_friction(double friction) {
  require(within(friction, 0, 100), "friction", friction, "0 to 100");
}

void check(const Pose& pose) {
  check_point(pose.translate, "translate", kMaxCoordinate);
  check_point(pose.rotate, "rotate", 1e6);
  require(within(pose.scale, kMinScale, kMaxScale), "scale", pose.scale, "1e-6 to 1e6");
  check_point(pose.velocity, "velocity", kMaxSpeed);
  check_point(pose.spin, "spin", kMaxSpin);
}

}  // namespace tetsoup::simulate
