// The 26 rays through every voxel, for one band.
#pragma once

#include "base/parallel.h"
#include "pseudo_volume/band_bits.h"
#include "pseudo_volume/event_store.h"
#include "pseudo_volume/exact_crossings.h"
#include "pseudo_volume/votes.h"
#include "tetsoup/pseudo_volume.h"

namespace tetsoup {

/// Counts, for every voxel, the rays that call it inside, with volume events in the band.
/// @param events  Reaches at least as far as the band.
/// @param exact   The soup's own crossings, which count but near its rims; null: none do.
/// @param votes   On the band's grid; all zero before.
/// The watch's current part is covered from `begin` to `end`.
void cast_rays(const BandBits& band, const EventStore& events, const ExactCrossings* exact, int rays, VoteGrid& votes,
               StageWatch& watch, double begin, double end);

}  // namespace tetsoup
