// Where the lattice's cells lie in space.
#pragma once

#include <array>
#include <cstdint>

#include "base/vec.h"
#include "tetsoup/types.h"

namespace tetsoup {

using Cell = std::array<int, 3>;

inline bool is_odd(const Cell& cell) {
  return ((cell[0] + cell[1] + cell[2]) & 1) != 0;
}

/// How a lattice lies over the grid.
struct LatticePose {
  double cell_size = 1;
  Vec3d translate_cells;   ///< Of a cell.
  Vec3d rotate;            ///< Radians about x, then y, then z, around the centre of the soup's box.
  Vec3d stretch{1, 1, 1};  ///< Edges of a cell along the lattice's axes, in cell sizes.
  bool operator==(const LatticePose&) const = default;
};

/// Cell coordinates of a point are three numbers; their whole parts name the cell. Without translation, cells [0,
/// count) lie centred over the soup's box.
struct LatticeFrame {
  double cell_size = 1;
  Vec3d stretch{1, 1, 1};     ///< Edges of a cell along the axes, in cell sizes.
  std::array<Vec3d, 3> axes;  ///< Unit vectors along the lattice's axes.
  Vec3d centre;               ///< Of the soup's box.
  Vec3d centre_cell;          ///< Cell coordinates of the centre.
  Cell count{};               ///< Cells over the box.
  Cell begin{}, end{};        ///< Cells whose tets cover the whole grid, padding included.

  Vec3d to_cell(const Vec3d& point) const {
    const Vec3d p = (point - centre) * (1 / cell_size);
    return Vec3d{dot(p, axes[0]) / stretch.x, dot(p, axes[1]) / stretch.y, dot(p, axes[2]) / stretch.z} + centre_cell;
  }
  Vec3d to_point(const Vec3d& cell) const {
    const Vec3d c = (cell - centre_cell) * cell_size;
    return centre + axes[0] * (c.x * stretch.x) + axes[1] * (c.y * stretch.y) + axes[2] * (c.z * stretch.z);
  }
};

/// The box of the grid's voxels without padding: the soup's own box, or a voxel where that has no extent.
Box3 grid_box(const GridFrame& grid);

/// `overhang`: how far a cell's tets reach beyond its upper faces, in cells.
LatticeFrame make_lattice_frame(const GridFrame& grid, const LatticePose& pose, double overhang = 0);

/// Smallest cell edge at which single-precision vertices of this grid's space still make well-shaped tets.
double finest_cell_size(const GridFrame& grid);

}  // namespace tetsoup
