// Affine maps as the readers of scenes multiply them: rotation, scale and shear in the first three columns, the
// translation in the fourth.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "base/vec.h"

namespace tetsoup::readers {

/// Rows of a 3x4 matrix.
struct Affine {
  std::array<std::array<double, 4>, 3> rows{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};

  Vec3d apply(const Vec3d& p) const {
    const auto row = [&](std::size_t r) { return rows[r][0] * p.x + rows[r][1] * p.y + rows[r][2] * p.z + rows[r][3]; };
    return {row(0), row(1), row(2)};
  }

  /// The unit normal of what the map makes of a plane with this normal; zero if there is none.
  Vec3 apply_to_normal(const Vec3d& normal) const {
    const auto row = [&](std::size_t r) { return Vec3d{rows[r][0], rows[r][1], rows[r][2]}; };
    const std::array<Vec3d, 3> cofactors{cross(row(1), row(2)), cross(row(2), row(0)), cross(row(0), row(1))};
    const double sign = dot(row(0), cofactors[0]) < 0 ? -1 : 1;
    const Vec3d moved{dot(cofactors[0], normal), dot(cofactors[1], normal), dot(cofactors[2], normal)};
    const double size = length(moved);
    return size > 0 && std::isfinite(size) ? to_float(moved * (sign / size)) : Vec3{};
  }

  /// Adds a share of another map to this one.
  void add(const Affine& other, double share) {
    for (std::size_t r = 0; r < 3; ++r) {
      for (std::size_t c = 0; c < 4; ++c) rows[r][c] += share * other.rows[r][c];
    }
  }
};

/// First b, then a.
inline Affine operator*(const Affine& a, const Affine& b) {
  Affine product;
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t c = 0; c < 4; ++c) {
      double sum = c == 3 ? a.rows[r][3] : 0;
      for (std::size_t k = 0; k < 3; ++k) sum += a.rows[r][k] * b.rows[k][c];
      product.rows[r][c] = sum;
    }
  }
  return product;
}

}  // namespace tetsoup::readers
