// The lattice's cells that keep a tet, and which of the five.
#pragma once

#include <cstddef>
#include <vector>

#include "base/parallel.h"
#include "lattice/five_tets.h"
#include "lattice/inside_blocks.h"
#include "lattice/lattice_frame.h"
#include "tetsoup/soup.h"

namespace tetsoup {

struct KeptCell {
  Cell cell{};
  std::uint8_t tets = 0;  ///< Bit t: tet t of the cell is kept.
};

/// Cells in lattice order, x fastest.
struct KeptCells {
  std::vector<KeptCell> cells;
  std::size_t tet_count = 0;
  std::size_t sampled_tets = 0;
};

/// Keeps the tets whose density is at least rho_min [Spillmann06 §4].
KeptCells keep_dense_tets(const InsideBlocks& inside, const LatticeFrame& frame, double rho_min, StageWatch& watch);

/// Keeps the tets that the soup passes through or touches.
KeptCells keep_crossed_tets(const CleanSoup& soup, const LatticeFrame& frame, StageWatch& watch);

}  // namespace tetsoup
