// One lattice, laid over the volume in a given pose: from frame to mended candidates.
#pragma once

#include <optional>

#include "lattice/candidates.h"
#include "lattice/densities.h"
#include "lattice/inside_blocks.h"
#include "tetsoup/lattice.h"

namespace tetsoup {

struct Fill {
  Pose pose;
  LatticeFrame frame;
  Candidates candidates;
  bool by_soup = false;        ///< The tets that the soup passes through were kept.
  bool crumbs = false;         ///< What density left does not hold together, and nothing was kept instead yet.
  std::size_t dense_tets = 0;  ///< Kept by density or by the soup, before anything was mended.
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

  enum class Crumbs { BySoup, Report };
  /// What is dense enough, or what the soup passes through if that is a sheet or crumbs; then cover, separation and
  /// clean-up.
  Fill fill(const Pose& pose, Crumbs crumbs = Crumbs::BySoup);
  /// From now on the tets that the soup passes through, whatever the densities: a search must not jump back and forth.
  void stay_with_soup() { has_volume_ = false; }

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
  void mend(Fill& fill);

  const PseudoVolume& volume_;
  const CleanSoup& soup_;
  const LatticeOptions& options_;
  StageWatch& watch_;
  const GridFrame& grid_;
  const LatticeTable& table_;
  InsideBlocks inside_;
  std::optional<BitGrid> passed_;  ///< Voxels that the soup passes through as well, if anything asks for them.
  std::optional<InsideBlocks> passed_blocks_;
  bool has_volume_ = true;
  int fills_ = 0;
};

}  // namespace tetsoup
