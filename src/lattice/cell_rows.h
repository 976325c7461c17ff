// The voxels of a cell's five tets, counted by runs along the rows of the grid instead of one by one.
#pragma once

#include <array>

#include "lattice/five_tets.h"
#include "lattice/inside_blocks.h"
#include "lattice/lattice_frame.h"

namespace tetsoup {

struct TetCounts {
  std::array<std::size_t, kTetsPerCell> total{}, inside{};
};

class CellRows {
 public:
  CellRows(const InsideBlocks& inside, const LatticeFrame& frame);

  /// Counts the voxels whose centres the tets of the cell own, all within `range`. The same as asking owner_tet() for
  /// each, which is done only where a voxel lies so near a face that rounding decides.
  TetCounts count(const Cell& cell, const VoxelRange& range) const;

 private:
  static constexpr std::size_t kCorners = kTetsPerCell - 1;

  /// Of p, relative to the cell: dot(normal, p) + offset > 0.
  struct HalfSpace {
    Vec3d normal;
    double offset = 0;
    double slope = 0, inverse = 0;  ///< Change of the sum from voxel to voxel along x.
    double reach = 0;               ///< Voxels about its zero where rounding may decide.
  };
  /// The half spaces that cut the corner tets from a cell, once as they are and once by their members.
  struct CornerTets {
    std::array<HalfSpace, kCorners> half;
    std::array<double, kCorners> x, y, z, offset, inverse, reach;
  };
  struct Row {
    Vec3d at_zero;  ///< Cell coordinates of voxel 0.
    int y, z;
  };
  struct Run {
    int begin, end;
  };
  using CornerRuns = std::array<Run, kCorners>;

  HalfSpace half_space(const Vec3d& normal, double offset) const;
  CornerTets corner_tets(const std::array<HalfSpace, kCorners>& half) const;
  template <class Holds>
  static bool narrow(const HalfSpace& half, const Vec3d& at_zero, Run& run, const Holds& holds);
  template <class Holds>
  static bool narrow_to_corners(const CornerTets& tets, const Vec3d& at_zero, const Run& run, CornerRuns& runs,
                                const Holds& holds);
  bool narrow_to_cell(const Cell& cell, const Vec3d& at_zero, std::size_t axis, Run& run) const;
  bool count_row(const Cell& cell, const Row& row, const Run& run, TetCounts& counts) const;
  void count_runs(const Row& row, const Run& run, const CornerRuns& runs, TetCounts& counts) const;
  void count_one_by_one(const Cell& cell, const Row& row, const VoxelRange& range, TetCounts& counts) const;
  Vec3d point(const Vec3d& at_zero, int x) const { return at_zero + step_[0] * x; }

  const InsideBlocks& inside_;
  Vec3d first_;                ///< Cell coordinates of voxel (0, 0, 0)
  std::array<Vec3d, 3> step_;  ///< and their change from voxel to voxel.
  bool aligned_;               ///< Along x only the first of them changes, and it along x only.
  std::array<std::array<HalfSpace, 2>, 3> cell_faces_;  ///< Lower and upper, along x, y, z.
  std::array<CornerTets, 2> corner_tets_;               ///< Of even and of odd cells.
};

}  // namespace tetsoup
