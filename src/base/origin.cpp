#include "base/origin.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace tetsoup {
namespace {

/// Sizes that points may lie away from zero: floats there still step by a millionth of the size.
constexpr double kFar = 16;
constexpr std::size_t kMostSamples = 4096;  ///< Points that decide; more would say the same.
constexpr std::size_t kTrim = 8;            ///< One of so many samples at either end has no say.

float narrow(double value) {
  constexpr double kLargest = std::numeric_limits<float>::max();
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  if (std::abs(value) > kLargest) return value < 0 ? -kInfinity : kInfinity;
  return static_cast<float>(value);
}

bool is_usable(const Vec3d& p) {
  constexpr double kLargest = std::numeric_limits<float>::max();
  return std::abs(p.x) <= kLargest && std::abs(p.y) <= kLargest && std::abs(p.z) <= kLargest;  // false for NaN
}

std::vector<Vec3d> samples_of(std::span<const Vec3d> points, std::span<const std::uint32_t> corners) {
  std::vector<bool> used(points.size(), false);
  for (const std::uint32_t corner : corners)
    if (corner < points.size()) used[corner] = true;
  std::size_t count = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    used[i] = used[i] && is_usable(points[i]);
    count += used[i];
  }
  const std::size_t step = count / kMostSamples + 1;
  std::vector<Vec3d> samples;
  for (std::size_t i = 0, number = 0; i < points.size(); ++i)
    if (used[i] && number++ % step == 0) samples.push_back(points[i]);
  return samples;
}

struct Reach {
  double middle = 0, size = 0;
};

/// Of most samples along an axis, or of all where most are alike.
Reach reach_of(const std::vector<Vec3d>& samples, double Vec3d::*axis, std::size_t trim) {
  std::vector<double> along;
  along.reserve(samples.size());
  for (const Vec3d& p : samples) along.push_back(p.*axis);
  std::sort(along.begin(), along.end());
  const double low = along[trim], high = along[along.size() - 1 - trim];
  return {low / 2 + high / 2, high - low};
}

/// The least power of two that is not below a size.
double power_of_two(double size) {
  int exponent = 0;
  const double mantissa = std::frexp(size, &exponent);
  return std::ldexp(1, mantissa > 0.5 ? exponent : exponent - 1);
}

}  // namespace

Vec3d origin_of(std::span<const Vec3d> points, std::span<const std::uint32_t> corners) {
  const std::vector<Vec3d> samples = samples_of(points, corners);
  if (samples.empty()) return {};
  std::array<Reach, 3> reach;
  double size = 0;
  for (const std::size_t trim : {samples.size() / kTrim, std::size_t{0}}) {
    reach = {reach_of(samples, &Vec3d::x, trim), reach_of(samples, &Vec3d::y, trim),
             reach_of(samples, &Vec3d::z, trim)};
    size = std::max({reach[0].size, reach[1].size, reach[2].size});
    if (size > 0) break;
  }
  const double far = std::max({std::abs(reach[0].middle), std::abs(reach[1].middle), std::abs(reach[2].middle)});
  if (!(size > 0) || far <= kFar * size) return {};
  const double step = power_of_two(size);
  const auto rounded = [&](double middle) { return std::floor(middle / step + 0.5) * step; };
  return {rounded(reach[0].middle), rounded(reach[1].middle), rounded(reach[2].middle)};
}

std::vector<Vec3> counted_from(const Vec3d& origin, std::span<const Vec3d> points) {
  std::vector<Vec3> counted;
  counted.reserve(points.size());
  const bool moved = !(origin == Vec3d{});
  for (const Vec3d& p : points) {
    if (moved)
      counted.push_back({narrow(p.x - origin.x), narrow(p.y - origin.y), narrow(p.z - origin.z)});
    else
      counted.push_back({narrow(p.x), narrow(p.y), narrow(p.z)});
  }
  return counted;
}

std::vector<Vec3d> placed_points(std::span<const Vec3> points, const Vec3d& origin) {
  std::vector<Vec3d> result;
  result.reserve(points.size());
  for (const Vec3& p : points) result.push_back(placed(p, origin));
  return result;
}

std::vector<Vec3> recounted(std::span<const Vec3> points, const Vec3d& from, const Vec3d& to) {
  std::vector<Vec3> result(points.begin(), points.end());
  if (from == to) return result;
  const Vec3d shift{from.x - to.x, from.y - to.y, from.z - to.z};
  for (Vec3& p : result) p = {narrow(p.x + shift.x), narrow(p.y + shift.y), narrow(p.z + shift.z)};
  return result;
}

}  // namespace tetsoup
