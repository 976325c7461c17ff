// The connected pieces of the inside voxels within each tet.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "base/tet_geometry.h"
#include "lattice/candidates.h"
#include "lattice/voxel_parts.h"

namespace tetsoup {

/// A tet's piece is a set of inside voxels whose cubes reach into the tet, connected there through faces, edges and
/// corners: so a sheet one voxel thick holds together in any direction, and what counts as apart has a voxel between.
class TetPieces {
 public:
  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;

  /// The candidates' densities are the shares that `inside` fills, whose parts these are. O(tets + rows of voxels in
  /// mixed tets), all threads.
  TetPieces(const Candidates& candidates, const BitGrid& inside, const VoxelParts& parts, StageWatch& watch);

  /// The pieces of tet t are first(t), ..., first(t) + count(t) - 1. A kept tet without any voxel has one piece all
  /// the same.
  std::uint32_t first(std::size_t tet) const { return first_[tet]; }
  std::uint32_t count(std::size_t tet) const { return first_[tet + 1] - first_[tet]; }
  std::size_t size() const { return first_.back(); }
  std::uint32_t tet_of(std::uint32_t piece) const { return tet_of_[piece]; }
  /// Voxels of the piece whose centres the tet holds; 0 where nobody had to count.
  std::uint32_t voxels(std::uint32_t piece) const { return voxels_[piece]; }
  /// The part of all the voxels that the piece belongs to, or kNone if it has no voxel.
  std::uint32_t part(std::uint32_t piece) const { return parts_[piece]; }
  /// The piece of the tet that has this inside voxel, or kNone.
  std::uint32_t piece_at(std::size_t tet, int x, int y, int z) const;

 private:
  struct Run {
    int z, y, begin, end;
    std::uint32_t piece;  ///< Of the tet's.
  };
  struct Found {
    std::vector<Run> runs;
    std::vector<std::uint32_t> voxels;  ///< Of every piece.
    std::vector<std::uint32_t> parts;   ///< Likewise: which part of all voxels it belongs to.
  };
  class Finder;

  std::vector<std::uint32_t> first_, tet_of_, voxels_, parts_;
  std::vector<std::size_t> runs_begin_;  ///< Of every tet; none where there is one piece at most.
  std::vector<Run> runs_;                ///< By z, y, x.
};

}  // namespace tetsoup
