// How good is a choice of the band? Judged from votes and solid alone, without knowing the true solid.
#pragma once

#include "base/parallel.h"
#include "pseudo_volume/votes.h"
#include "tetsoup/pseudo_volume.h"

namespace tetsoup {

/// What the score and the cavities need of the soup, the same for all candidates. Without the padding, which must not
/// change the choice.
struct SoupMarks {
  BitGrid sealed;   ///< Within 0.9 voxels: no path of face neighbours leads through a closed surface past these.
  BitGrid touched;  ///< Within 0.6 voxels.
};
SoupMarks mark_soup(const BlockGrid& distance, StageWatch& watch);

/// Over the voxels of the soup's box, without the padding.
struct VoteStatistics {
  std::size_t inside = 0;
  double consensus_inside = 0, consensus_outside = 0;  ///< Mean of |2 votes / rays - 1|.
  double consensus = 0;
};

/// Ends a vote: the inside bits, by a strict majority of the rays.
/// @param inside  On the votes' grid; every word is written.
VoteStatistics count_votes(const VoteGrid& votes, int rays, BitGrid& inside, StageWatch& watch);

/// Share of the touched voxels that have an inside voxel among their 27 neighbours.
double covered_share(const BitGrid& inside, const BitGrid& touched, StageWatch& watch);

/// Share of the touched voxels that have an inside and an outside voxel among their 27 neighbours: how much of the soup
/// lies on the surface of the solid, and not lost outside or buried inside.
double surface_share(const BitGrid& inside, const BitGrid& touched, StageWatch& watch);

/// Inside voxels for every face between an inside and an outside voxel: large for one body, small for speckle.
double voxels_per_face(const BitGrid& inside, StageWatch& watch);

/// The score of docs/METHOD.md: a body without crumbs, the soup on its surface, nothing but agreement outside.
/// @param surface  surface_share() of what the rays call inside.
/// @param solid    The inside with its cavities filled.
double score_solid(double surface, const BitGrid& solid, const VoteStatistics& statistics, StageWatch& watch);

}  // namespace tetsoup
