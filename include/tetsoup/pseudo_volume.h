// tetsoup, stage 3: which voxels lie in the pseudo volume, the space the soup intuitively occupies?
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tetsoup/distance.h"
#include "tetsoup/progress.h"
#include "tetsoup/types.h"

namespace tetsoup {

/// Where in a run of voxels with P > k the volume event lies.
enum class Placement {
  Closest,  ///< At the run's first closest approach to the soup, to a fraction of a voxel.
  Entry,    ///< At the run's first voxel, as the paper can also be read; dilates the result by the band.
};

/// What becomes of space that the soup encloses although nothing says that it is solid.
enum class Cavities {
  Auto,  ///< Hollow where evidence says so: bounded by closed, consistently oriented shells that turn their outside to
         ///< it; elsewhere filled.
  Fill,  ///< It is inside: nested shells become solid. Holes up to the band let nothing in.
  Keep,  ///< Hollow wherever the rays find it outside.
};

/// A space inside a solid that was left hollow.
struct SoupCavity {
  double volume = 0;
  std::uint32_t part = 0;  ///< Of the soup's parts, the shell around it.
};

/// At most one of `k`, `band_voxels` and `band`; none: automatic.
struct PseudoVolumeOptions {
  std::optional<double> k;            ///< Event threshold in [0, 1]: event where 1 - d / d_max > k [Spillmann06 §3].
  std::optional<double> band_voxels;  ///< Event where the distance is below so many voxels.
  std::optional<double> band;         ///< Event where the distance is below this length.
  int rays = 26;                      ///< 26: both ways along 13 axes; 13: one way.
  Placement placement = Placement::Closest;
  Cavities cavities = Cavities::Auto;
  std::optional<double> thickness;  ///< Of sheets: what lies within half of it on either side is inside.
  bool operator==(const PseudoVolumeOptions&) const = default;
};

/// One candidate of the automatic choice.
struct BandScore {
  double band_voxels = 0;
  double score = 0;      ///< What the choice maximises (docs/METHOD.md).
  double consensus = 0;  ///< Mean of |2 votes / rays - 1| over all voxels.
};

struct PseudoVolumeReport {
  double k = 0;            ///< Threshold used, after the floor.
  double band = 0;         ///< (1 - k) d_max used; at least 0.9 voxels, below which a ray can miss a crossing.
  double band_voxels = 0;  ///< The same in voxels.
  bool automatic = false;  ///< The band was chosen here.
  bool floored = false;    ///< The band asked for was below the floor.
  std::vector<BandScore> candidates;  ///< What the automatic choice tried.
  /// The automatic choice is not over: wider candidates would need the distance known this far, in voxels.
  std::optional<double> wants_band_voxels;
  std::size_t cavity_voxels = 0;     ///< Voxels that were added because the soup encloses them.
  std::vector<SoupCavity> cavities;  ///< What was left hollow by evidence.
  double sheet_share = 0;            ///< Of the soup's area: open parts that enclose nothing. Known with a thickness.
  double exact_share =
      0;  ///< Of the soup's triangles, those of sound parts: there the sign is that of exact crossings.
  /// Diameter of the largest hole that was closed: twice the largest distance between the soup and the surface of the
  /// inside; 0 where that is nowhere farther than 0.9 voxels. Where it is small beside the model, little was assumed.
  double largest_closure = 0;
  double soup_covered = 1;  ///< Share of the voxels the soup passes through that have an inside voxel beside them.
  std::size_t inside_voxels = 0;
  double volume = 0;  ///< Of the inside voxels.
  /// What the soup bounds, where that is known: one closed and oriented surface, but for hollow spaces in it. Voxels
  /// may make a wall half a voxel thicker or thinner on either side, which for a thin one is much.
  std::optional<double> bounded_volume;
  double consensus = 0;  ///< Mean of |2 votes / rays - 1| over all voxels; 1 = all rays agree everywhere.
  std::vector<std::string>
      notes;  ///< What the user should know, and the option that changes it: one sentence or two each.
};

/// How many rays call each voxel inside, bit-sliced: 64 voxels along x share a word, as they do in a BitGrid.
struct VoteGrid {
  struct Word {
    std::array<std::uint64_t, 5> slices{};  ///< Slice i holds bit i of every count.
    bool operator==(const Word&) const = default;
  };

  GridFrame frame;
  std::size_t words_per_row = 0;
  std::vector<Word> words;  ///< (nz, ny, words_per_row); counts beyond a row's end are zero.

  int at(int x, int y, int z) const {
    const std::size_t row =
        static_cast<std::size_t>(y) + static_cast<std::size_t>(frame.size[1]) * static_cast<std::size_t>(z);
    const Word& word = words[row * words_per_row + static_cast<std::size_t>(x >> 6)];
    int count = 0;
    for (std::size_t i = 0; i < word.slices.size(); ++i)
      count |= static_cast<int>(word.slices[i] >> (x & 63) & 1U) << i;
    return count;
  }
  bool operator==(const VoteGrid&) const = default;
};

struct PseudoVolume {
  BitGrid inside;
  VoteGrid votes;  ///< 0..rays.
  int rays = 26;
  PseudoVolumeReport report;
};

/// Decides which voxels lie in the pseudo volume.
///
/// Every voxel is crossed by 26 rays, one per neighbour direction; along a ray each run of voxels with P > k flips the
/// parity once [Spillmann06 §3]. A voxel with odd parity on more than half of its rays is inside; so are, unless kept,
/// cavities that no path from outside reaches, since parity counts the overlap of two parts as outside.
///
/// @param field  Its band must reach sqrt(3) voxels beyond the event band, so that every comparison sees true
/// distances.
/// @return       Votes and inside bits on the field's grid. Bitwise the same for any thread count.
/// @throws InvalidInput  if an option is out of range or the field's band is too narrow for it; Cancelled.
/// Cost: O(voxels) bit operations, once per candidate of the automatic choice. 6 bits per voxel for the result; while
/// it runs as much again, 6 bits per voxel more, and 5 bytes for every voxel of a word of 64 that has one in the band.
PseudoVolume classify_volume(const DistanceField& field, const PseudoVolumeOptions& options = {},
                             const Progress& progress = {});

/// Half width, in voxels, of the distance band that classify_volume() needs for these options; the automatic choice may
/// ask for more in its report.
double band_needed_voxels(const DistanceField& field, const PseudoVolumeOptions& options);

/// Decides which voxels of a grid lie in the pseudo volume of a soup: all that a mesher needs to know of it.
///
/// Where a part of the soup is sound (closed, every edge has an even number of triangles) rays cross it exactly,
/// however close two walls are, and all agree. The other parts are decided by classify_volume() with the distance to
/// them, but that away from their rims (edges of an odd number of triangles) a run of voxels flips the parity as often
/// as its triangles are crossed: volume events decide where the soup is open, doubled or loose. With Placement::Entry
/// they decide everywhere. Windings are looked at in one place: nested oriented shells, see Cavities.
///
/// @throws InvalidInput  if an option is out of range or the soup is empty; Cancelled.
/// Cost: O(triangles + voxels the soup passes through) where all parts are sound; else as unsigned_distance() and
/// classify_volume().
PseudoVolume find_volume(const CleanSoup& soup, const GridFrame& frame, const PseudoVolumeOptions& options = {},
                         const Progress& progress = {});

}  // namespace tetsoup
