// Which cells of the lattice the pseudo volume reaches into, and how much of each of their tets is inside.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/parallel.h"
#include "lattice/inside_blocks.h"
#include "lattice/lattice_frame.h"
#include "lattice/lattice_table.h"
#include "tetsoup/soup.h"

namespace tetsoup {

struct FilledCell {
  Cell cell{};
  std::uint16_t kept = 0;  ///< Bit t: tet t of the cell is kept.
};

/// Every cell with a tet that holds an inside voxel or is kept, in lattice order, x fastest.
struct FilledCells {
  std::vector<FilledCell> cells;
  std::vector<float> densities;  ///< Of every tet of each of these cells: the share of it that is inside.
  std::size_t kept_tets = 0;
  std::size_t sampled_tets = 0;
};

/// Counts the voxels of the tets and keeps those whose density is at least rho_min [Spillmann06 §4].
FilledCells find_densities(const InsideBlocks& inside, const LatticeFrame& frame, const LatticeTable& table,
                           double rho_min, StageWatch& watch);

/// Keeps the tets that the soup passes through or touches, and no others.
void keep_crossed_tets(const CleanSoup& soup, const LatticeFrame& frame, const LatticeTable& table, FilledCells& filled,
                       StageWatch& watch);

}  // namespace tetsoup
