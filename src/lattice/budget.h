// The edge of the cells, and a small shift of the frame, that give a wanted number of tets or vertices.
#pragma once

#include <cmath>
#include <cstddef>

#include "lattice/filler.h"

namespace tetsoup {

struct Budget {
  enum class Counts { Tets, Vertices };
  Counts counts = Counts::Tets;
  std::size_t wanted = 2000;

  std::size_t count(const Fill& fill) const { return counts == Counts::Tets ? fill.kept_tets() : fill.kept_vertices(); }
  /// Relative.
  double miss(const Fill& fill) const {
    return std::abs(static_cast<double>(count(fill)) / static_cast<double>(wanted) - 1);
  }
  double tolerance() const;
};

inline constexpr int kMostFills = 16;

/// What the search may change besides the edge.
enum class FineTuning {
  Frame,  ///< It shifts the frame where the edge alone does not hit the count, and turns it a little as the last
          ///< resort.
  None,   ///< The frame has been fitted: it stays in its place.
};

/// Looks for the fill that comes closest to the budget from the given pose on; ends once it is well within the
/// tolerance, or after `most_fills`.
Fill search_budget(Filler& filler, const Budget& budget, const LatticePose& start, FineTuning tuning, int most_fills);

/// Cell edge at which tets that fill the volume and no more would meet the budget.
double expected_cell(const LatticeTable& table, const Budget& budget, double volume);

}  // namespace tetsoup
