// Votes of rays with what else is known of the soup.
#pragma once

#include "pseudo_volume/exact_crossings.h"
#include "tetsoup/pseudo_volume.h"

namespace tetsoup {

/// What a soup tells beyond its distance.
struct Evidence {
  const CrossingPlanes* planes = nullptr;  ///< Crossings of what the field is the distance of,
  const DistanceField* rims = nullptr;     ///< and the distance to its rims, known as far as the field; or neither.
  /// Wider bands are not tried: half the width of the widest hole there can be.
  double widest_band_voxels = 1e9;
  /// A wider band must be better by this factor: where most crossings are exact it can only blur.
  double least_gain = 1;
  const BitGrid* solids = nullptr;  ///< Inside in any case.
};

PseudoVolume classify_volume(const DistanceField& field, const PseudoVolumeOptions& options, const Evidence& evidence,
                             const Progress& progress);

/// @throws InvalidInput  if an option is out of range.
void check_options(const PseudoVolumeOptions& options);
std::size_t count_voxels(const BitGrid& bits);
void add_bits(BitGrid& to, const BitGrid& from);

}  // namespace tetsoup
