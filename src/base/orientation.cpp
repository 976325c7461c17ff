#include "base/orientation.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace tetsoup {
namespace {

constexpr double kUnit = std::numeric_limits<double>::epsilon() / 2;
/// Relative to the sum of the products' sizes: what rounding can do at most [Shewchuk97 §4.3, §4.4].
constexpr double kSpaceError = (7 + 56 * kUnit) * kUnit, kPlaneError = (3 + 16 * kUnit) * kUnit;

int sign_of(double value) {
  return value > 0 ? 1 : value < 0 ? -1 : 0;
}

/// A sum of doubles without any rounding: parts that do not overlap, the smallest first [Shewchuk97 §2].
class ExactSum {
 public:
  void add(double value) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      const double part = parts_[i], sum = value + part, taken = sum - value;
      const double rest = (value - (sum - taken)) + (part - taken);
      if (rest != 0) parts_[kept++] = rest;
      value = sum;
    }
    if (value != 0) parts_[kept++] = value;
    count_ = kept;
  }
  /// `product` of two floats, times a third.
  void add_product(double product, double third) {
    const double shifted = product * 0x8000001p0, high = shifted - (shifted - product);  // of 26 bits
    add((product - high) * third);
    add(high * third);
  }
  int sign() const { return count_ == 0 ? 0 : sign_of(parts_[count_ - 1]); }

 private:
  std::array<double, 49> parts_;  // 48 products at most are added
  std::size_t count_ = 0;
};

/// Adds or takes away the determinant of three points.
void add_determinant(ExactSum& sum, const Vec3& u, const Vec3& v, const Vec3& w, double factor) {
  const auto product = [factor](float p, float q) { return factor * p * static_cast<double>(q); };
  sum.add_product(product(u.y, v.z), w.x), sum.add_product(-product(u.z, v.y), w.x);
  sum.add_product(product(u.z, v.x), w.y), sum.add_product(-product(u.x, v.z), w.y);
  sum.add_product(product(u.x, v.y), w.z), sum.add_product(-product(u.y, v.x), w.z);
}

int exact_orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  ExactSum sum;
  add_determinant(sum, b, c, d, 1);
  add_determinant(sum, a, c, d, -1);
  add_determinant(sum, a, b, d, 1);
  add_determinant(sum, a, b, c, -1);
  return sum.sign();
}

int exact_orientation(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c) {
  ExactSum sum;
  const auto add_cross = [&sum](const PlanePoint& u, const PlanePoint& v) {
    sum.add(static_cast<double>(u.x) * v.y);
    sum.add(-static_cast<double>(u.y) * v.x);
  };
  add_cross(a, b), add_cross(b, c), add_cross(c, a);
  return sum.sign();
}

}  // namespace

int orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const auto apart = [](float p, float q) { return static_cast<double>(p) - static_cast<double>(q); };
  const double bx = apart(b.x, a.x), by = apart(b.y, a.y), bz = apart(b.z, a.z);
  const double cx = apart(c.x, a.x), cy = apart(c.y, a.y), cz = apart(c.z, a.z);
  const double dx = apart(d.x, a.x), dy = apart(d.y, a.y), dz = apart(d.z, a.z);
  const double by_cz = by * cz, bz_cy = bz * cy, bz_cx = bz * cx, bx_cz = bx * cz, bx_cy = bx * cy, by_cx = by * cx;
  const double value = (by_cz - bz_cy) * dx + (bz_cx - bx_cz) * dy + (bx_cy - by_cx) * dz;
  const double size = (std::abs(by_cz) + std::abs(bz_cy)) * std::abs(dx) +
                      (std::abs(bz_cx) + std::abs(bx_cz)) * std::abs(dy) +
                      (std::abs(bx_cy) + std::abs(by_cx)) * std::abs(dz);
  if (std::abs(value) > kSpaceError * size || size == 0) return sign_of(value);
  return exact_orientation(a, b, c, d);
}

int orientation(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c) {
  const auto apart = [](float p, float q) { return static_cast<double>(p) - static_cast<double>(q); };
  const double left = apart(b.x, a.x) * apart(c.y, a.y), right = apart(b.y, a.y) * apart(c.x, a.x);
  const double value = left - right, size = std::abs(left) + std::abs(right);
  if (std::abs(value) > kPlaneError * size || size == 0) return sign_of(value);
  return exact_orientation(a, b, c);
}

}  // namespace tetsoup
