// The obvious twins of everything that is fast elsewhere: the oracle that tests compare with, bit for bit. Never called
// by the library itself.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/vec.h"
#include "kernel/event_masks.h"
#include "kernel/relax_tets.h"
#include "tetsoup/types.h"

namespace tetsoup::reference {

/// The 13 axes of the 26 neighbour directions.
inline std::vector<std::array<int, 3>> ray_axes() {
  std::vector<std::array<int, 3>> axes;
  for (int dz = -1; dz <= 1; ++dz)
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx)
        if (dz > 0 || (dz == 0 && (dy > 0 || (dy == 0 && dx > 0)))) axes.push_back({dx, dy, dz});
  return axes;
}

/// Walks one ray from voxel to voxel through the grid and counts the voxels it calls inside [Spillmann06 §3].
inline void walk_ray(const Grid<float>& distance, float band, bool at_entry, std::array<int, 3> at,
                     const std::array<int, 3>& step, Grid<std::uint8_t>& votes) {
  const auto value = [&](int sign) {
    const int x = at[0] + sign * step[0], y = at[1] + sign * step[1], z = at[2] + sign * step[2];
    return distance.frame.contains(x, y, z) ? distance.at(x, y, z) : std::numeric_limits<float>::infinity();
  };
  bool inside = false, fired = false;
  for (; distance.frame.contains(at[0], at[1], at[2]); at = {at[0] + step[0], at[1] + step[1], at[2] + step[2]}) {
    const float here = value(0), next = value(1), previous = value(-1);
    bool flip_after = false;
    if (!(here < band)) {
      fired = false;
    } else if (!fired && (at_entry || next >= here)) {
      fired = true;
      flip_after = !at_entry && next < previous;
      if (!flip_after) inside = !inside;
    }
    votes.values[votes.index(at[0], at[1], at[2])] =
        static_cast<std::uint8_t>(votes.at(at[0], at[1], at[2]) + (inside ? 1 : 0));
    if (flip_after) inside = !inside;
  }
}

/// Votes of 26 rays (or 13) through every voxel: a ray starts wherever its predecessor lies beyond the grid.
inline Grid<std::uint8_t> count_votes(const Grid<float>& distance, float band, int rays, bool at_entry) {
  Grid<std::uint8_t> votes{distance.frame, std::vector<std::uint8_t>(distance.values.size())};
  const auto [nx, ny, nz] = distance.frame.size;
  for (const auto& axis : ray_axes()) {
    for (const int sign : {1, -1}) {
      if (sign < 0 && rays == 13) continue;
      const std::array<int, 3> step{sign * axis[0], sign * axis[1], sign * axis[2]};
      for (int z = 0; z < nz; ++z)
        for (int y = 0; y < ny; ++y)
          for (int x = 0; x < nx; ++x)
            if (!distance.frame.contains(x - step[0], y - step[1], z - step[2]))
              walk_ray(distance, band, at_entry, {x, y, z}, step, votes);
    }
  }
  return votes;
}

/// Bits of 64 voxels about one axis: those ahead begin at `next`, those behind at `previous`.
template <class Value>
kernel::AxisEvents find_axis_events(const Value& here, const Value& next, const Value& previous) {
  kernel::AxisEvents events;
  for (int x = 0; x < 64; ++x) {
    const auto mark = [&](std::uint64_t& bits, bool set) { bits |= static_cast<std::uint64_t>(set) << x; };
    mark(events.ahead, next(x) >= here(x) && next(x) >= previous(x));
    mark(events.behind, previous(x) >= here(x) && previous(x) >= next(x));
    mark(events.lowest, next(x) >= here(x) && previous(x) >= here(x));
  }
  return events;
}

inline kernel::WordEvents find_events(const kernel::BlockNeighbours& around) {
  const auto values = [&](int dx, int dy, int dz) {
    const auto row = static_cast<std::size_t>(3 * (dz + 1) + dy + 1);
    return [&around, row, dx](int x) {
      return x + dx < 0 ? around.before[row] : x + dx > 63 ? around.after[row] : around.rows[row][x + dx];
    };
  };
  const auto about = [&](int dx, int dy, int dz) {
    return find_axis_events(values(0, 0, 0), values(dx, dy, dz), values(-dx, -dy, -dz));
  };
  kernel::WordEvents events;
  for (std::size_t kind = 0; kind < kernel::kSheetKinds; ++kind) {
    const auto [dy, dz] = kernel::kSheetSteps[kind];
    for (int dx = -1; dx <= 1; ++dx) events.sheets[kind][static_cast<std::size_t>(dx + 1)] = about(dx, dy, dz);
  }
  events.along_x = about(1, 0, 0);
  return events;
}

/// One tet of a batch, in double: moves its corners as kernel::relax_tets() does without damping, for a rotation that
/// is known to be the identity.
inline std::array<Vec3d, 4> relax_unturned_tet(const kernel::TetBatch& batch, std::size_t lane, std::array<Vec3d, 4> p,
                                               const std::array<double, 4>& inverse_masses) {
  const auto vector = [&](const kernel::TetLanes* from) {
    return Vec3d{static_cast<double>(from[0][lane]), static_cast<double>(from[1][lane]),
                 static_cast<double>(from[2][lane])};
  };
  std::array<Vec3d, 4> g;
  for (std::size_t i = 1; i < 4; ++i) {
    g[i] = vector(batch.gradients + 3 * (i - 1));
    g[0] -= g[i];
  }
  const auto deformation = [&] {  // rows
    std::array<Vec3d, 3> f;
    for (std::size_t i = 0; i < 4; ++i) {
      f[0] += g[i] * p[i].x;
      f[1] += g[i] * p[i].y;
      f[2] += g[i] * p[i].z;
    }
    return f;
  };
  std::array<Vec3d, 3> f = deformation();
  const std::array<Vec3d, 3> strain{f[0] - Vec3d{1, 0, 0}, f[1] - Vec3d{0, 1, 0}, f[2] - Vec3d{0, 0, 1}};
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3d b = vector(batch.responses + 3 * i);
    p[i] -= Vec3d{dot(strain[0], b), dot(strain[1], b), dot(strain[2], b)};
  }
  f = deformation();
  const std::array<Vec3d, 3> cofactor{cross(f[1], f[2]), cross(f[2], f[0]), cross(f[0], f[1])};
  std::array<Vec3d, 4> a;
  double denominator = static_cast<double>(batch.volume_compliance[lane]);
  for (std::size_t i = 0; i < 4; ++i) {
    a[i] = {dot(cofactor[0], g[i]), dot(cofactor[1], g[i]), dot(cofactor[2], g[i])};
    denominator += inverse_masses[i] * squared_length(a[i]);
  }
  const double lambda = (1 - dot(f[0], cofactor[0])) / denominator;
  for (std::size_t i = 0; i < 4; ++i) p[i] += a[i] * (lambda * inverse_masses[i]);
  return p;
}

}  // namespace tetsoup::reference
