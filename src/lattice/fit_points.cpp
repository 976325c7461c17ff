#include "lattice/fit_points.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "base/bits.h"
#include "base/whole.h"
#include "lattice/five_tets.h"

namespace tetsoup {
namespace {

Vec3d centre_of(const GridFrame& grid) {
  const Box3 box = grid_box(grid);
  return (box.lo + box.hi) * 0.5;
}

/// A cell and one of its tets.
struct Owner {
  Cell cell;
  std::size_t tet;
};

struct FiveOwner {
  Owner operator()(const Vec3& p) const {
    const Cell cell{floor_to_int(p.x), floor_to_int(p.y), floor_to_int(p.z)};
    const Vec3d at = to_double(p);
    return {cell, owner_tet({at.x - cell[0], at.y - cell[1], at.z - cell[2]}, is_odd(cell))};
  }
};

/// The cube's six faces are the bases of pyramids with their tips at its centre; each pyramid is halves of four tets.
struct BccOwner {
  Owner operator()(const Vec3& p) const {
    Cell cell{floor_to_int(p.x), floor_to_int(p.y), floor_to_int(p.z)};
    const std::array<float, 3> local{p.x - static_cast<float>(cell[0]) - 0.5F, p.y - static_cast<float>(cell[1]) - 0.5F,
                                     p.z - static_cast<float>(cell[2]) - 0.5F};
    const std::array<float, 3> size{std::abs(local[0]), std::abs(local[1]), std::abs(local[2])};
    const std::size_t axis = size[0] >= size[1] ? (size[0] >= size[2] ? 0 : 2) : (size[1] >= size[2] ? 1 : 2);
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    if (local[axis] < 0) --cell[axis];
    // Sides of the face as in the table: below, right, above, left.
    const std::size_t side = size[v] >= size[u] ? (local[v] < 0 ? 0 : 2) : (local[u] < 0 ? 3 : 1);
    return {cell, 4 * axis + side};
  }
};

using Matrix = std::array<std::array<double, 3>, 3>;

/// Eigenvectors of a symmetric matrix, as columns, by Jacobi's rotations.
Matrix eigenvectors(Matrix a) {
  Matrix v{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  constexpr int kSweeps = 12;  // the error is squared by each
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (const auto& [p, q] : {std::array<std::size_t, 2>{0, 1}, {0, 2}, {1, 2}}) {
      if (a[p][q] == 0) continue;
      const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
      const double t = (theta < 0 ? -1 : 1) / (std::abs(theta) + std::sqrt(theta * theta + 1));
      const double c = 1 / std::sqrt(t * t + 1), s = t * c;
      const auto turn = [&](double& x, double& y) {
        const double x0 = x;
        x = c * x0 - s * y;
        y = s * x0 + c * y;
      };
      for (std::size_t k = 0; k < 3; ++k) turn(a[k][p], a[k][q]);
      for (std::size_t k = 0; k < 3; ++k) turn(a[p][k], a[q][k]);
      for (std::size_t k = 0; k < 3; ++k) turn(v[k][p], v[k][q]);
    }
  }
  return v;
}

}  // namespace

Pose pose_of(const Place& place, const GridFrame& grid) {
  Pose pose{place.cell_size, {}, place.rotate};
  const Vec3d shift = make_lattice_frame(grid, pose).centre_cell - place.centre_cell;
  // Lattices repeat after two cells.
  const auto least = [](double s) { return s - 2 * std::round(s / 2); };
  pose.translate_cells = {least(shift.x), least(shift.y), least(shift.z)};
  return pose;
}

Place place_of(const Pose& pose, const GridFrame& grid) {
  return {pose.cell_size, pose.rotate, make_lattice_frame(grid, pose).centre_cell};
}

FitPoints::FitPoints(const BitGrid& inside, std::size_t wanted, const LatticeTable& table, double rho_min)
    : grid_(inside.frame), table_(table), rho_min_(rho_min) {
  std::size_t all = 0;
  for (const std::uint64_t word : inside.words) all += bit_count(word);
  // Every so many voxels along a line that winds through the grid evenly: x + a y + b z is a multiple of `every`.
  const int every = std::max(1, static_cast<int>(std::lround(static_cast<double>(all) / static_cast<double>(wanted))));
  const int a = static_cast<int>(std::lround(std::cbrt(every))), b = std::max(1, a * a - 1);
  const Vec3d centre = centre_of(grid_);
  const auto [nx, ny, nz] = grid_.size;
  for (int z = 0; z < nz; ++z) {
    for (int y = 0; y < ny; ++y) {
      for (int x = (every - (a * y + b * z) % every) % every; x < nx; x += every) {
        if (!inside.test(x, y, z)) continue;
        const Vec3d at{static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)};
        points_.push_back(to_float(grid_.origin + at * grid_.voxel_size - centre));
      }
    }
  }
  if (!points_.empty())
    volume_ = std::pow(grid_.voxel_size, 3) * static_cast<double>(all) / static_cast<double>(points_.size());
}

Vec3d FitPoints::principal_rotation() const {
  Vec3d mean;
  for (const Vec3& p : points_) mean += to_double(p) * (1 / static_cast<double>(points_.size()));
  Matrix spread{};
  for (const Vec3& point : points_) {
    const Vec3d d = to_double(point) - mean;
    const std::array<double, 3> p{d.x, d.y, d.z};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) spread[i][j] += p[i] * p[j];
  }
  Matrix r = eigenvectors(spread);
  const double turn = r[0][0] * (r[1][1] * r[2][2] - r[1][2] * r[2][1]) -
                      r[0][1] * (r[1][0] * r[2][2] - r[1][2] * r[2][0]) +
                      r[0][2] * (r[1][0] * r[2][1] - r[1][1] * r[2][0]);
  if (turn < 0)
    for (std::size_t i = 0; i < 3; ++i) r[i][2] = -r[i][2];
  return {std::atan2(r[2][1], r[2][2]), std::asin(std::clamp(-r[2][0], -1.0, 1.0)), std::atan2(r[1][0], r[0][0])};
}

Guess FitPoints::guess(const Place& place) const {
  Pose pose{place.cell_size, {}, place.rotate};
  LatticeFrame frame = make_lattice_frame(grid_, pose, 1);
  const Vec3d shift = place.centre_cell - frame.centre_cell;
  const std::array<int, 3> whole{floor_to_int(shift.x), floor_to_int(shift.y), floor_to_int(shift.z)};
  for (std::size_t i = 0; i < 3; ++i) {
    frame.begin[i] += whole[i];
    frame.end[i] += whole[i] + 1;
  }
  frame.centre_cell = place.centre_cell;
  return table_.point_count == 1 ? count_points(frame, FiveOwner()) : count_points(frame, BccOwner());
}

template <class FindOwner>
Guess FitPoints::count_points(const LatticeFrame& frame, const FindOwner& find_owner) const {
  const auto cells = [&](std::size_t i) { return static_cast<std::size_t>(frame.end[i] - frame.begin[i]); };
  const std::size_t tets = table_.tet_count;
  std::vector<std::uint16_t> counts(cells(0) * cells(1) * cells(2) * tets);
  const auto row = [&](const Vec3d& axis) { return to_float(axis * (1 / frame.cell_size)); };
  const Vec3 ax = row(frame.axes[0]), ay = row(frame.axes[1]), az = row(frame.axes[2]);
  const Vec3 c = to_float(frame.centre_cell);
  for (const Vec3& p : points_) {
    const auto [cell, tet] =
        find_owner({p.x * ax.x + p.y * ax.y + p.z * ax.z + c.x, p.x * ay.x + p.y * ay.y + p.z * ay.z + c.y,
                    p.x * az.x + p.y * az.y + p.z * az.z + c.z});
    const auto at = [&](std::size_t i) { return static_cast<std::size_t>(cell[i] - frame.begin[i]); };
    ++counts[((at(2) * cells(1) + at(1)) * cells(0) + at(0)) * tets + tet];
  }
  std::array<double, kMostTetsPerCell> full{};  // points in a tet that is inside
  for (std::size_t t = 0; t < tets; ++t) full[t] = table_.volume[t] * std::pow(frame.cell_size, 3) / volume_;
  Guess guess;
  double both = 0, mesh = 0;
  for (std::size_t i = 0; i < counts.size(); i += tets) {
    for (std::size_t t = 0; t < tets; ++t) {
      if (counts[i + t] == 0 || counts[i + t] < rho_min_ * full[t]) continue;
      guess.tets += 1;
      both += counts[i + t];
      mesh += full[t];
    }
  }
  guess.overlap = both / (mesh + static_cast<double>(points_.size()) - both);
  return guess;
}

}  // namespace tetsoup
