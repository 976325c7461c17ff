// Parity counting by true ray-triangle intersections, the method of [NT03]; shares nothing with the volume events.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "kernel/reference.h"
#include "shapes.h"

namespace tetsoup::test {

/// Flips, along every ray of one axis that crosses a triangle, the voxels beyond the crossing. Rays are moved off the
/// voxel centres by some 1e-4 voxels so that none meets an edge.
class AxisParity {
 public:
  AxisParity(const GridFrame& frame, const std::array<int, 3>& axis) : frame_(frame), odd_(frame.voxel_count()) {
    main_ = axis[2] != 0 ? 2 : axis[1] != 0 ? 1 : 0;  // the coordinate that every step moves by one
    a_ = (main_ + 1) % 3;
    b_ = (main_ + 2) % 3;
    slope_a_ = axis[a_];
    slope_b_ = axis[b_];
  }

  void add(const std::array<std::array<double, 3>, 3>& corners) {
    std::array<double, 3> u{}, v{};
    for (std::size_t i = 0; i < 3; ++i) {
      u[i] = corners[i][a_] - slope_a_ * corners[i][main_] + 1.3e-4;
      v[i] = corners[i][b_] - slope_b_ * corners[i][main_] + 0.7e-4;
    }
    const double area = (u[1] - u[0]) * (v[2] - v[0]) - (u[2] - u[0]) * (v[1] - v[0]);
    if (area == 0) return;
    const auto [u_lo, u_hi] = std::minmax({u[0], u[1], u[2]});
    const auto [v_lo, v_hi] = std::minmax({v[0], v[1], v[2]});
    for (int iu = static_cast<int>(std::ceil(u_lo)); iu <= u_hi; ++iu) {
      for (int iv = static_cast<int>(std::ceil(v_lo)); iv <= v_hi; ++iv) {
        const auto weight = [&](std::size_t i, std::size_t j) {
          return ((u[i] - iu) * (v[j] - iv) - (u[j] - iu) * (v[i] - iv)) / area;
        };
        const double w0 = weight(1, 2), w1 = weight(2, 0), w2 = weight(0, 1);
        if (w0 < 0 || w1 < 0 || w2 < 0) continue;
        flip_beyond(iu, iv, w0 * corners[0][main_] + w1 * corners[1][main_] + w2 * corners[2][main_]);
      }
    }
  }

  bool is_odd(std::size_t voxel) const { return odd_[voxel] != 0; }

 private:
  void flip_beyond(int iu, int iv, double crossing) {
    for (int m = std::max(0, static_cast<int>(std::ceil(crossing))); m < frame_.size[main_]; ++m) {
      std::array<int, 3> at{};
      at[main_] = m;
      at[a_] = iu + slope_a_ * m;
      at[b_] = iv + slope_b_ * m;
      if (!frame_.contains(at[0], at[1], at[2])) continue;
      odd_[Grid<char>{frame_, {}}.index(at[0], at[1], at[2])] ^= 1;
    }
  }

  const GridFrame& frame_;
  std::size_t main_, a_, b_;
  int slope_a_, slope_b_;
  std::vector<char> odd_;
};

/// Voxels that more than half of the 26 rays call inside; both ways along an axis agree for a closed surface.
inline BitGrid classify_by_parity(const TriangleSoup& soup, const GridFrame& frame) {
  std::vector<int> votes(frame.voxel_count());
  for (const auto& axis : reference::ray_axes()) {
    AxisParity parity(frame, axis);
    for (const Triangle& t : soup.triangles) {
      std::array<std::array<double, 3>, 3> corners{};
      for (std::size_t i = 0; i < 3; ++i) {
        const Vec3d p = (to_double(soup.vertices[t[i]]) - frame.origin) * (1 / frame.voxel_size);
        corners[i] = {p.x, p.y, p.z};
      }
      parity.add(corners);
    }
    for (std::size_t i = 0; i < votes.size(); ++i) votes[i] += 2 * parity.is_odd(i);
  }
  BitGrid inside{frame, (static_cast<std::size_t>(frame.size[0]) + 63) / 64, {}};
  inside.words.resize(inside.words_per_row * static_cast<std::size_t>(frame.size[1] * frame.size[2]));
  std::size_t voxel = 0;
  for (int z = 0; z < frame.size[2]; ++z)
    for (int y = 0; y < frame.size[1]; ++y)
      for (int x = 0; x < frame.size[0]; ++x, ++voxel)
        if (votes[voxel] > 13)
          inside.words[inside.row(y, z) + static_cast<std::size_t>(x >> 6)] |= std::uint64_t{1} << (x & 63);
  return inside;
}

}  // namespace tetsoup::test
