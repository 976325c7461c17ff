// What the caller may ask for.
#pragma once

#include <string_view>

#include "tetsoup/simulate.h"

namespace tetsoup::simulate {

inline constexpr double kMaxCoordinate = 1e5;  ///< m; where single precision is 8 mm coarse.
inline constexpr double kMinEdge = 1e-6;       ///< m
inline constexpr double kMaxSpring = 1e12;     ///< N/m
inline constexpr double kMaxSpeed = 1e4;       ///< m/s
/// More substeps than this no step takes; where the potentials' bound asks for more, moves are clamped.
inline constexpr int kMaxSubsteps = 10000;

// Each throws InvalidInput with what is out of range.
void check(const SimulationOptions& options);
void check(const SimMaterial& material);
void check(const Pose& pose);
void check_friction(double friction);
/// Each coordinate within [-limit, limit].
void check_point(const Vec3d& p, std::string_view name, double limit);

}  // namespace tetsoup::simulate
