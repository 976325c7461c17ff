// One lattice, laid over the volume in a given pose: from frame to mended candidates.
#pragma once

#include <optional>

#include "lattice/candidates.h"
#include "lattice/densities.h"
#include "lattice/inside_blocks.h"
#include "lattice/voxel_parts.h"
#include "tetsoup/lattice.h"

namespace tetsoup {

struct Fill {
  LatticePose pose;
  LatticeFrame frame;
  Candidates candidates;
  bool by_soup = false;        ///< The tets that the soup passes through were kept.
  std::size_t dense_tets = 0;  ///< Those that density alone would keep, or of the cover of a sheet.
  std::size_t sampled_tets = 0;
  LatticeReport mended;  ///< What the steps after density did; the other fields are not filled.

  std::size_t kept_tets() const;
  std::size_t kept_vertices() const;
};

/// Volume shared by the kept tets and the inside voxels, and what is only in one of them; by counting voxels.
struct Shares {
  double both = 0, only_mesh = 0, only_volume = 0;
  double overlap() const { return both == 0 ? 0 : both / (both + only_mesh + only_volume); }
};

class Filler {
 public:
  /// All must outlive this.
  Filler(const PseudoVolume& volume, const CleanSoup& soup, const LatticeOptions& options, StageWatch& watch);

  enum class Cells { Cut, WholeWhereFlat };
  /// The cover of the body, or what the soup passes through if that is a sheet; carved, then cover and clean-up.
  Fill fill(const LatticePose& pose, Cells cells = Cells::Cut);

  Shares shares(const TetMesh& mesh) const;
  int fills() const { return fills_; }
  const GridFrame& grid() const { return grid_; }
  bool has_volume() const { return has_volume_; }
  const LatticeTable& table() const { return table_; }
  double longest_edge() const;
  /// Range of cell edges that make a lattice which single precision and indices of tets can hold.
  double smallest_cell() const;
  void check_cell(double cell_size) const;

 private:
  bool find_volume() const;
  BitGrid find_body() const;
  void carve_cover(Fill& fill);
  void mend(Fill& fill);

  const PseudoVolume& volume_;
  const CleanSoup& soup_;
  const LatticeOptions& options_;
  StageWatch& watch_;
  const GridFrame& grid_;
  const LatticeTable& table_;
  bool has_volume_;
  BitGrid body_;  ///< What is to be covered.
  InsideBlocks blocks_;
  std::optional<VoxelParts> parts_;  ///< Of the body, where parts are kept apart.
  int fills_ = 0;
};

}  // namespace tetsoup
