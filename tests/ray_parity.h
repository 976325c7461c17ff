// Parity counting by true ray-triangle intersections, the method of [NT03]; shares nothing with the volume events.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "base/bits.h"
#include "kernel/reference.h"
#include "shapes.h"

namespace tetsoup::test {

/// Crossings of the rays of one axis with the triangles of a soup, each noted at the first voxel beyond it. Rays are
/// moved off the voxel centres by some 1e-4 voxels so that none meets an edge.
class AxisCrossings {
 public:
  AxisCrossings(const TriangleSoup& soup, const GridFrame& frame, const std::array<int, 3>& axis)
      : crossings{frame, std::vector<std::uint8_t>(frame.voxel_count())},
        entries{frame, std::vector<std::int8_t>(frame.voxel_count())} {
    main_ = axis[2] != 0 ? 2 : axis[1] != 0 ? 1 : 0;  // the coordinate that every step moves by one
    a_ = (main_ + 1) % 3;
    b_ = (main_ + 2) % 3;
    slope_a_ = axis[a_];
    slope_b_ = axis[b_];
    for (const Triangle& t : soup.triangles) {
      std::array<std::array<double, 3>, 3> corners{};
      for (std::size_t i = 0; i < 3; ++i) {
        const Vec3d p = (to_double(soup.vertices[t[i]]) - frame.origin) * (1 / frame.voxel_size);
        corners[i] = {p.x, p.y, p.z};
      }
      add(corners);
    }
  }

  Grid<std::uint8_t> crossings;
  Grid<std::int8_t> entries;  ///< Crossings through a front less those through a back, by the triangles' winding.

 private:
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
        note(iu, iv, w0 * corners[0][main_] + w1 * corners[1][main_] + w2 * corners[2][main_], area < 0 ? 1 : -1);
      }
    }
  }

  void note(int iu, int iv, double crossing, int entry) {
    std::array<int, 3> at{};
    at[main_] = static_cast<int>(std::ceil(crossing));
    at[a_] = iu + slope_a_ * at[main_];
    at[b_] = iv + slope_b_ * at[main_];
    if (!crossings.frame.contains(at[0], at[1], at[2])) return;
    const std::size_t voxel = crossings.index(at[0], at[1], at[2]);
    ++crossings.values[voxel];
    entries.values[voxel] = static_cast<std::int8_t>(entries.values[voxel] + entry);
  }

  std::size_t main_, a_, b_;
  int slope_a_, slope_b_;
};

/// Where the winding number, taken as the mean over the 26 rays through a voxel, is above a half. True for unions of
/// closed parts wound outwards, and close to the generalised winding number where a few holes are left.
inline BitGrid winding_solid(const TriangleSoup& soup, const GridFrame& frame) {
  std::vector<int> twice(frame.voxel_count());  // both ways along 13 axes
  for (const auto& axis : reference::ray_axes()) {
    const Grid<std::int8_t> entries = AxisCrossings(soup, frame, axis).entries;
    const auto step = static_cast<std::ptrdiff_t>(entries.index(1, 0, 0)) * axis[0] +
                      static_cast<std::ptrdiff_t>(entries.index(0, 1, 0)) * axis[1] +
                      static_cast<std::ptrdiff_t>(entries.index(0, 0, 1)) * axis[2];
    const auto walk_line = [&](std::array<int, 3> at) {
      int ahead = 0;
      auto voxel = static_cast<std::ptrdiff_t>(entries.index(at[0], at[1], at[2]));
      const auto first = voxel;
      std::ptrdiff_t count = 0;
      for (; frame.contains(at[0], at[1], at[2]); at = {at[0] + axis[0], at[1] + axis[1], at[2] + axis[2]}) {
        ahead += entries.values[static_cast<std::size_t>(voxel)];
        twice[static_cast<std::size_t>(voxel)] += 2 * ahead;
        voxel += step;
        ++count;
      }
      if (ahead == 0) return;  // what came in went out: the way back says the same
      for (voxel = first; count-- > 0; voxel += step) twice[static_cast<std::size_t>(voxel)] -= ahead;
    };
    for (int z = 0; z < frame.size[2]; ++z)
      for (int y = 0; y < frame.size[1]; ++y)
        for (int x = 0; x < frame.size[0]; ++x)
          if (!frame.contains(x - axis[0], y - axis[1], z - axis[2])) walk_line({x, y, z});
  }
  BitGrid solid = make_bit_grid(frame);
  const Grid<int> index{frame, {}};
  for (int z = 0; z < frame.size[2]; ++z)
    for (int y = 0; y < frame.size[1]; ++y)
      for (int x = 0; x < frame.size[0]; ++x)
        if (std::abs(twice[index.index(x, y, z)]) > 13)
          solid.words[solid.row(y, z) + static_cast<std::size_t>(x >> 6)] |= std::uint64_t{1} << (x & 63);
  return solid;
}

/// Intersection over union of what volume events and parity counting call inside, voting along the same rays.
struct ParityAgreement {
  double all_rays = 0;
  double clear_rays =
      0;  ///< Without the rays that graze: those with a run of the band that holds not exactly one crossing.
};

inline ParityAgreement compare_with_parity(const TriangleSoup& soup, const Grid<float>& distance, float band) {
  const GridFrame& frame = distance.frame;
  std::vector<std::array<int, 2>> all(frame.voxel_count()), clear(frame.voxel_count());
  std::vector<int> clear_rays(frame.voxel_count());
  const auto [nx, ny, nz] = frame.size;
  for (const auto& axis : reference::ray_axes()) {
    const Grid<std::uint8_t> crossings = AxisCrossings(soup, frame, axis).crossings;
    const std::array<int, 3> back{-axis[0], -axis[1], -axis[2]};
    Grid<std::uint8_t> events{frame, std::vector<std::uint8_t>(frame.voxel_count())};
    const auto walk_line = [&](std::array<int, 3> at) {
      std::vector<std::size_t> line;
      bool graze = false, in_band = false;
      int crossed = 0;  // in the current run of the band, or in the current gap
      reference::walk_ray(distance, band, false, at, axis, events);
      for (; frame.contains(at[0], at[1], at[2]); at = {at[0] + axis[0], at[1] + axis[1], at[2] + axis[2]}) {
        const std::size_t voxel = distance.index(at[0], at[1], at[2]);
        line.push_back(voxel);
        const bool now = distance.values[voxel] < band;
        if (!in_band && now) crossed = 0;
        crossed += crossings.values[voxel];
        graze |= in_band && !now && crossed != 1;
        in_band = now;
      }
      reference::walk_ray(distance, band, false, {at[0] - axis[0], at[1] - axis[1], at[2] - axis[2]}, back, events);
      int parity = 0;
      for (const std::size_t voxel : line) {
        parity ^= crossings.values[voxel] & 1;
        all[voxel][0] += events.values[voxel];
        all[voxel][1] += 2 * parity;
        if (graze) continue;
        clear[voxel][0] += events.values[voxel];
        clear[voxel][1] += 2 * parity;
        clear_rays[voxel] += 2;
      }
    };
    for (int z = 0; z < nz; ++z)
      for (int y = 0; y < ny; ++y)
        for (int x = 0; x < nx; ++x)
          if (!frame.contains(x - axis[0], y - axis[1], z - axis[2])) walk_line({x, y, z});
  }
  std::array<std::size_t, 4> count{};
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool a = all[i][0] > 13, b = all[i][1] > 13;
    const bool c = 2 * clear[i][0] > clear_rays[i], d = 2 * clear[i][1] > clear_rays[i];
    count[0] += a && b;
    count[1] += a || b;
    const bool judged = clear_rays[i] > 0 && distance.values[i] >= band;
    count[2] += judged && c && d;
    count[3] += judged && (c || d);
  }
  return {static_cast<double>(count[0]) / static_cast<double>(count[1]),
          static_cast<double>(count[2]) / static_cast<double>(count[3])};
}

}  // namespace tetsoup::test
