// Vector arithmetic in double precision; float only stores.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "tetsoup/types.h"

namespace tetsoup {

inline Vec3d to_double(const Vec3& v) {
  return {v.x, v.y, v.z};
}
inline Vec3 to_float(const Vec3d& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

inline bool is_finite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

inline Vec3d operator+(const Vec3d& a, const Vec3d& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Vec3d operator-(const Vec3d& a, const Vec3d& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Vec3d operator*(const Vec3d& a, double s) {
  return {a.x * s, a.y * s, a.z * s};
}
inline Vec3d operator*(double s, const Vec3d& a) {
  return a * s;
}
inline Vec3d& operator+=(Vec3d& a, const Vec3d& b) {
  return a = a + b;
}
inline Vec3d& operator-=(Vec3d& a, const Vec3d& b) {
  return a = a - b;
}

inline double dot(const Vec3d& a, const Vec3d& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Vec3d cross(const Vec3d& a, const Vec3d& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double squared_length(const Vec3d& a) {
  return dot(a, a);
}
inline double length(const Vec3d& a) {
  return std::sqrt(squared_length(a));
}

inline Vec3 min(const Vec3& a, const Vec3& b) {
  return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}
inline Vec3 max(const Vec3& a, const Vec3& b) {
  return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}
inline Vec3d min(const Vec3d& a, const Vec3d& b) {
  return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}
inline Vec3d max(const Vec3d& a, const Vec3d& b) {
  return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}

/// Around points; at the origin where there are none.
inline Box3 box_of(std::span<const Vec3> points) {
  if (points.empty()) return {};
  Box3 box{to_double(points[0]), to_double(points[0])};
  for (const Vec3& p : points) box = {min(box.lo, to_double(p)), max(box.hi, to_double(p))};
  return box;
}

}  // namespace tetsoup
