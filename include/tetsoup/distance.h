// tetsoup, stage 2: the unsigned distance to the soup on a regular grid.
#pragma once

#include <cstddef>
#include <optional>

#include "tetsoup/progress.h"
#include "tetsoup/soup.h"
#include "tetsoup/types.h"

namespace tetsoup {

enum class DistanceMode {
  Band,  ///< Exact below `band_voxels`, infinity beyond: all that meshing needs. Beyond 10 voxels as Full, cut off.
  Full,  ///< Every voxel, for export and viewing: exact below 4 voxels, beyond at most 0.05 voxels too far.
};

struct DistanceOptions {
  std::optional<int> voxels;         ///< Along the longest axis of the box, 1..4096. Neither given: 128.
  std::optional<double> voxel_size;  ///< Edge of a voxel; instead of `voxels`.
  double band_voxels = 3.25;         ///< Half width of the exact band, in voxels, >= 3; what a sound surface needs.
  DistanceMode mode = DistanceMode::Band;
  /// The space to cover, in the input's place; default the soup's own box. It must hold the soup.
  std::optional<Box3> box;
  bool operator==(const DistanceOptions&) const = default;
};

struct DistanceField {
  /// Unsigned distance, in the soup's unit; infinity where it is `band` or more.
  BlockGrid distance;
  double d_max = 0;  ///< Largest distance over the voxels of the unpadded box [Spillmann06 §3: c = 1 / d_max].
  double band = 0;   ///< Values below this are known; infinity if all are.
};

/// The grid that `options` ask for over a soup: cubic voxels over its box, two voxels of padding on every side.
///
/// Where single precision cannot tell neighbouring voxels apart (a small soup far from the origin, or one with no
/// extent at all) the voxel edge is raised to 2^-17 of the largest coordinate: compare `voxel_size` with what was
/// asked.
/// @throws InvalidInput  if an option is out of range, the soup is empty, or the grid would have more than 2^40 voxels.
GridFrame make_grid(const CleanSoup& soup, const DistanceOptions& options);

/// Distance from every voxel centre to the nearest point of the soup, whatever its connectivity or winding.
///
/// Exact in the band: the error is float rounding, below 1e-3 voxels against a double-precision brute force (tested).
/// So is d_max in either mode. A band wider than 10 voxels has the bits of the full field.
/// @throws InvalidInput  as make_grid; Cancelled if `progress` says so.
/// Cost: Band: O(triangles + voxels in the band) time and memory, 1/16 byte for any other voxel; Full: 4 bytes per
/// voxel, O(voxels x log triangles) time.
DistanceField unsigned_distance(const CleanSoup& soup, const DistanceOptions& options = {},
                                const Progress& progress = {});

/// The same on a grid that was made before, with the distance known up to `band_voxels`, >= 3.
inline constexpr double kLeastBandVoxels = 3.25;
DistanceField unsigned_distance(const CleanSoup& soup, const GridFrame& frame, double band_voxels,
                                const Progress& progress = {});

/// All values side by side: (nz, ny, nx), 4 bytes per voxel.
Grid<float> dense(const BlockGrid& blocks);

/// Widens the band of a field to `band_voxels` (infinity: everywhere). Same bits as unsigned_distance() with that band.
/// `soup` must be the one the field was made from.
/// @throws Cancelled  if `progress` says so; the field is then unchanged.
void widen_distance(DistanceField& field, const CleanSoup& soup, double band_voxels, const Progress& progress = {});

}  // namespace tetsoup
