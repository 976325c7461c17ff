// Edges that cross the border between labels, removed where that leaves less on the wrong side.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "tetsoup/regions.h"
#include "tetsoup/smooth.h"
#include "tetsoup/types.h"

namespace tetsoup {

/// The labels of a tet that may not be in the mesh yet.
using AskTet = std::function<std::vector<LabelShare>(const Tet& tet)>;

/// Replaces the tets around inner edges by such as do without the edge, if those keep the limits and less of their
/// volume is of other labels than most of it: a tet with one corner on either side of the border and two on it cannot
/// be moved to one side. Vertices stay; new tets stand where the first of those stood that they replace.
/// @return  How many edges were removed.
std::size_t remove_crossing_edges(TetMesh& mesh, const TetLabels& labels, const SmoothOptions& limits,
                                  const AskTet& ask);

}  // namespace tetsoup
