// tetsoup, stage 4: a lattice of tets laid over the pseudo volume, cut by density.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "tetsoup/progress.h"
#include "tetsoup/pseudo_volume.h"
#include "tetsoup/soup.h"
#include "tetsoup/types.h"

namespace tetsoup {

/// At most one of `cells` and `cell_size`; neither: an edge that gives about 2,000 tets,
/// with a whole number of cells along the longest axis where that keeps the volume much better.
struct LatticeOptions {
  std::optional<int> cells;         ///< Cubic cells along the longest axis of the soup's box, 1..1024.
  std::optional<double> cell_size;  ///< Edge of a cell.
  Vec3d translate_cells;            ///< Shift of the lattice, in fractions of a cell.
  Vec3d rotate;                     ///< Radians about x, then y, then z, around the centre of the soup's box.
  double rho_min = 0.5;             ///< A tet stays if at least this share of its voxels is inside, (0, 1].
  bool operator==(const LatticeOptions&) const = default;
};

struct LatticeReport {
  std::array<int, 3> cells{0, 0, 0};  ///< Cells along the lattice's axes over the soup's box.
  double cell_size = 0;
  std::size_t used_cells = 0;  ///< Cells with at least one kept tet.
  std::size_t tet_count = 0;
  std::size_t sampled_tets = 0;  ///< Tets that held no voxel centre and were judged by sampling.
  double kept_volume = 0;        ///< Of the kept tets.
  double pseudo_volume = 0;      ///< Of the inside voxels.
  bool kept_by_soup = false;     ///< Density left nothing: the tets the soup passes through were kept instead.
};

struct LatticeMesh {
  TetMesh mesh;
  LatticeReport report;
};

/// Lays a lattice of cubes, five tets each, over the pseudo volume and keeps the tets that are dense enough.
///
/// A tet's density is the share of inside voxels among all voxels whose centre it holds [Spillmann06 §4], counted
/// exactly: every voxel centre belongs to exactly one tet. A tet too small to hold one is judged at 35 sample points
/// instead. If nothing is dense enough (a lone sheet, a needle), the tets that the soup passes through are kept.
///
/// @return  Positive tets, faces matching, never empty if the soup is not; vertices and tets in lattice order.
/// @throws InvalidInput  if an option is out of range or the lattice would have more than 2^31 tets; Cancelled.
/// Cost: O(cells + voxels near the boundary of the pseudo volume).
LatticeMesh fill_lattice(const PseudoVolume& volume, const CleanSoup& soup, const LatticeOptions& options = {},
                         const Progress& progress = {});

}  // namespace tetsoup
