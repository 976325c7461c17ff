// The edge of the cells, and a small shift of the frame, that give a wanted number of tets or vertices.
#pragma once

#include <cstddef>

#include "lattice/filler.h"

namespace tetsoup {

struct Budget {
  enum class Counts { Tets, Vertices };
  Counts counts = Counts::Tets;
  std::size_t wanted = 2000;

  std::size_t count(const Fill& fill) const { return counts == Counts::Tets ? fill.kept_tets() : fill.kept_vertices(); }
  double tolerance() const;  ///< Relative.
};

inline constexpr int kMostFills = 8;

/// Looks for the fill that comes closest to the budget, from the pose's shift and rotation and, if it has none that is
/// positive, an edge that follows from the volume; ends once it is well within the tolerance, or after `most_fills`.
Fill search_budget(Filler& filler, const Budget& budget, const Pose& start, int most_fills);

/// Cell edge at which tets that fill the volume and no more would meet the budget.
double expected_cell(const LatticeTable& table, const Budget& budget, double volume);

}  // namespace tetsoup
