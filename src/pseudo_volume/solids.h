// The inside of closed surfaces, from what the rows of voxels cross: exact however close two walls are.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "tetsoup/pseudo_volume.h"
#include "tetsoup/soup.h"

namespace tetsoup {

/// Sound parts that are counted together. Inside is where the windings of a nest's parts do not add up to zero, or,
/// where windings say nothing, where the number of crossings is odd; the solids are the union of all nests.
struct Nests {
  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;
  std::vector<std::uint32_t> of_part;  ///< kNone: not sound, or not to be counted.
  std::vector<std::uint8_t> by_winding;
  std::vector<SoupCavity> cavities;  ///< Shells that turn their outside to what they hold.
};

/// @param around  Of every part the innermost sound part that contains it, or kNone.
Nests make_nests(const SoupParts& parts, std::span<const std::uint32_t> around, Cavities cavities);

/// Voxels whose centres lie inside.
BitGrid fill_solids(const CleanSoup& soup, const Nests& nests, const GridFrame& frame, StageWatch& watch);

/// What the soup bounds, if it is one closed, oriented surface and hollow spaces right in it; none where the voxels say
/// otherwise by more than half a voxel all over it, as where the surface passes through itself.
std::optional<double> bounded_volume(const CleanSoup& soup, const Nests& nests, double of_voxels,
                                     const GridFrame& frame);

/// Fills what lies between two inside voxels of a row along x, y or z with at most `most` voxels between them.
void close_hairlines(BitGrid& inside, int most);

}  // namespace tetsoup
