// Which tets lie near what a tet holds.
#pragma once

#include <vector>

#include "base/groups.h"
#include "base/parallel.h"
#include "lattice/tet_complex.h"

namespace tetsoup {

/// For the kept tets that may go: the kept tets around that lie near the middle of what they hold. What is dropped is
/// covered as long as one of those stays.
struct Reach {
  std::vector<std::uint32_t> count;  ///< Of every tet: those near what it holds.
  Groups<std::uint32_t> served;      ///< Of every tet: the tets in whose lists it is.
};

struct ReachLimits {
  double going = 1;    ///< Tets that hold less, but something, may go,
  double serving = 0;  ///< and are served by tets that hold at least that much.
};

/// Cost: O(tets x tets around a vertex), all threads.
Reach find_reach(const TetComplex& complex, const ReachLimits& limits, const BitGrid& body, StageWatch& watch);

}  // namespace tetsoup
