// The search for the place of a lattice in which its tets meet the volume best.
#pragma once

#include <vector>

#include "base/parallel.h"
#include "lattice/fit_points.h"

namespace tetsoup {

struct FitSearch {
  const BitGrid& inside;
  const LatticeTable& table;
  double rho_min = 0.5;
  enum class Edge { Searched, Given } edge = Edge::Searched;
  double tets = 0;  ///< To be kept by density; where the edge is given, about so many.
};

/// The best places found, best first, at most `most`; the given one counts as found.
std::vector<Place> search_fit(const FitSearch& search, const Place& start, std::size_t most, StageWatch& watch);

}  // namespace tetsoup
