// The library speaks radians, people and reports speak degrees.
#pragma once

#include <numbers>

namespace tetsoup::cli {

inline constexpr double kDegree = std::numbers::pi / 180;  // radians

inline double to_degrees(double radians) {
  return radians / kDegree;
}

inline double to_radians(double degrees) {
  return degrees * kDegree;
}

}  // namespace tetsoup::cli
