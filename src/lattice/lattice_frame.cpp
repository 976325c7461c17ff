#include "lattice/lattice_frame.h"

#include <cmath>

#include "base/elementary.h"

namespace tetsoup {
namespace {

constexpr double kFinestRelativeCell = 0x1p-14;  ///< Of the largest coordinate: 512 steps of single precision.

/// Columns of Rz Ry Rx: the images of the axes.
std::array<Vec3d, 3> rotated_axes(const Vec3d& angle) {
  const auto rotate = [&](Vec3d v) {
    const auto turn = [](double& a, double& b, double by) {
      const double c = elementary::cos(by), s = elementary::sin(by);
      const double a0 = a;
      a = c * a0 - s * b;
      b = s * a0 + c * b;
    };
    if (angle.x != 0) turn(v.y, v.z, angle.x);
    if (angle.y != 0) turn(v.z, v.x, angle.y);
    if (angle.z != 0) turn(v.x, v.y, angle.z);
    return v;
  };
  return {rotate({1, 0, 0}), rotate({0, 1, 0}), rotate({0, 0, 1})};
}

/// Half extent of a box along a direction.
double half_extent(const Vec3d& half, const Vec3d& direction) {
  return std::abs(direction.x) * half.x + std::abs(direction.y) * half.y + std::abs(direction.z) * half.z;
}

}  // namespace

Box3 grid_box(const GridFrame& grid) {
  const double h = grid.voxel_size;
  const Vec3d lo = grid.origin + Vec3d{1, 1, 1} * ((grid.pad - 0.5) * h);
  const auto voxels = [&](std::size_t axis) { return static_cast<double>(grid.size[axis] - 2 * grid.pad); };
  return {lo, lo + Vec3d{voxels(0), voxels(1), voxels(2)} * h};
}

LatticeFrame make_lattice_frame(const GridFrame& grid, const LatticePose& pose, double overhang) {
  LatticeFrame frame;
  frame.cell_size = pose.cell_size;
  frame.stretch = pose.stretch;
  frame.axes = rotated_axes(pose.rotate);
  const Box3 box = grid_box(grid);
  frame.centre = (box.lo + box.hi) * 0.5;
  const Vec3d half = (box.hi - box.lo) * 0.5;
  const Vec3d padded = half + Vec3d{1, 1, 1} * (grid.pad * grid.voxel_size);
  const std::array<double, 3> shift{pose.translate_cells.x, pose.translate_cells.y, pose.translate_cells.z};
  const std::array<double, 3> edges{pose.cell_size * pose.stretch.x, pose.cell_size * pose.stretch.y,
                                    pose.cell_size * pose.stretch.z};
  std::array<double, 3> middle{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double cells = 2 * half_extent(half, frame.axes[i]) / edges[i];
    frame.count[i] = std::max(1, static_cast<int>(std::ceil(cells * (1 - 1e-9))));
    middle[i] = 0.5 * frame.count[i] - shift[i];
    const double reach = half_extent(padded, frame.axes[i]) / edges[i];
    frame.begin[i] = static_cast<int>(std::floor(middle[i] - reach - overhang));
    frame.end[i] = static_cast<int>(std::ceil(middle[i] + reach));
  }
  frame.centre_cell = {middle[0], middle[1], middle[2]};
  return frame;
}

double finest_cell_size(const GridFrame& grid) {
  const Box3 box = grid_box(grid);
  return kFinestRelativeCell * std::max({std::abs(box.lo.x), std::abs(box.lo.y), std::abs(box.lo.z), std::abs(box.hi.x),
                                         std::abs(box.hi.y), std::abs(box.hi.z)});
}

}  // namespace tetsoup
