// Which parts of a large piece threads can solve side by side.
#pragma once

#include <cstdint>
#include <vector>

#include "simulate/rest.h"

namespace tetsoup::simulate {

using TetRun = std::vector<std::uint32_t>;

/// All tets of a piece, in rounds: one round after the other, the runs of a round at once, since no two of them share a
/// vertex; within a run, tets are in their order.
///
/// The piece is halved across its longest side. Of one half, what touches the other is a thin layer; without it the
/// halves are apart and are halved on, and the layer comes after both, by the same rule [nested dissection, George73].
/// This depends on the piece alone, never on the number of threads, and a run is near in space, so it stays in the
/// cache.
std::vector<std::vector<TetRun>> split_rounds(const Piece& piece);

}  // namespace tetsoup::simulate
