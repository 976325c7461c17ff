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

  /// Of a point relative to the cell: dot(normal, point) + offset >= 0.
  struct HalfSpace {
    std::array<std::int64_t, 3> normal{};
    std::int64_t offset = 0;
    std::array<std::int64_t, 3> step{};  ///< Change of the sum from voxel to voxel along x, y, z,
    double inverse = 0;                  ///< and one over that along x.
  };
  using HalfSpaces = std::array<HalfSpace, 4>;
  struct Run {
    int begin, end;
  };

  HalfSpaces half_spaces(const LatticeTet& tet, const LatticeTable& table) const;
  static bool narrow(const HalfSpace& half, std::int64_t at_zero, Run& run);
  std::size_t count_inside(const Run& run, int y, int z) const;

  const InsideBlocks& inside_;
  Fixed first_{};                ///< Cell coordinates of voxel (0, 0, 0)
  std::array<Fixed, 3> step_{};  ///< and their change from voxel to voxel.
  std::array<std::array<HalfSpaces, kMostTetsPerCell>, 2> half_spaces_{};
};

}  // namespace tetsoup
