// The voxels of a tet of any lattice, counted by runs along the rows of the grid, in whole numbers.
#pragma once

#include <array>
#include <cstdint>

#include "lattice/inside_blocks.h"
#include "lattice/lattice_frame.h"
#include "lattice/lattice_table.h"

namespace tetsoup {

struct VoxelCount {
  std::size_t total = 0, inside = 0;
};

/// Voxel centres in cell coordinates are rounded to 2^-40 once; from there on everything is exact, so every centre
/// belongs to exactly one tet. One on a face belongs to the tet that it gets into when it moves a little along x, if
/// that stays in the face along y, and else along z.
class TetRows {
 public:
  TetRows(const InsideBlocks& inside, const LatticeFrame& frame, const LatticeTable& table);

  /// Counts the voxels whose centres a tet of the cell owns, all within `range`.
  VoxelCount count(const Cell& cell, std::size_t tet, const VoxelRange& range) const;

 private:
  using Fixed = std::array<std::int64_t, 3>;  ///< In cells / 2^40.

  /// Of points relative to the cell: dot(normal, point) + offset >= 0, one for each face.
  struct HalfSpaces {
    std::array<std::array<std::int64_t, 3>, 4> normal{};
    std::array<std::int64_t, 4> offset{};
    std::array<std::array<std::int64_t, 4>, 3> step{};  ///< Change of the sums from voxel to voxel along x, y, z,
    std::array<double, 4> inverse{};                    ///< and one over that along x, or zero.
  };
  using Sums = std::array<std::int64_t, 4>;
  struct Run {
    int begin, end;
  };

  HalfSpaces half_spaces(const LatticeTet& tet, const LatticeTable& table) const;
  static Run narrowed(const HalfSpaces& halves, const Sums& at_zero, const Run& run);
  TetCorners corners_in_voxels(const Cell& cell, std::size_t tet) const;
  static Run slice(const TetCorners& corners, int z);
  std::size_t count_inside(const Run& run, int y, int z) const;

  const InsideBlocks& inside_;
  const LatticeFrame& frame_;
  const LatticeTable& table_;
  Fixed first_{};                ///< Cell coordinates of voxel (0, 0, 0)
  std::array<Fixed, 3> step_{};  ///< and their change from voxel to voxel.
  std::array<std::array<HalfSpaces, kMostTetsPerCell>, 2> half_spaces_{};
};

}  // namespace tetsoup
