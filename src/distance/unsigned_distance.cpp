#include <cmath>
#include <limits>

#include "distance/far_field.h"
#include "distance/farthest_voxel.h"
#include "distance/scan_conversion.h"
#include "distance/triangle_tree.h"
#include "tetsoup/distance.h"

namespace tetsoup {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
/// Voxels; the band that is scan-converted. In a wider one the regions of a soup's features overlap so much that the
/// full field would be cheaper.
constexpr double kScanBand = 10;

/// The largest value over the unpadded box; searched by the tree unless an exact band holds all of the box.
float farthest_distance(const BlockGrid& distance, double band, const TriangleTree& tree, StageWatch& watch) {
  const GridFrame& frame = distance.frame;
  if (band <= kScanBand) {
    float largest = 0;
    for (int z = frame.pad; z < frame.size[2] - frame.pad && largest < kInfinity; ++z)
      for (int y = frame.pad; y < frame.size[1] - frame.pad && largest < kInfinity; ++y)
        for (int x = frame.pad; x < frame.size[0] - frame.pad && largest < kInfinity; ++x)
          largest = std::max(largest, distance.at(x, y, z));
    if (largest < kInfinity) return largest;
  }
  return std::sqrt(farthest_voxel_squared(tree, frame, watch)) * static_cast<float>(frame.voxel_size);
}

/// Distances up to `band` voxels, by the way that suits the band.
BlockGrid measure(const SoupFeatures& features, const GridFrame& frame, double band, StageWatch& watch) {
  if (band <= kScanBand) {
    watch.enter_part(0.1, 0.8);
    return scan_convert(features, frame, static_cast<float>(band), watch);
  }
  watch.enter_part(0.1, 0.2);
  const BlockGrid near = scan_convert(features, frame, static_cast<float>(kFarField), watch);
  watch.enter_part(0.2, 1);
  return fill_far_field(near, features, band, watch);
}

}  // namespace

DistanceField unsigned_distance(const CleanSoup& soup, const DistanceOptions& options, const Progress& progress) {
  const double band =
      options.mode == DistanceMode::Full ? std::numeric_limits<double>::infinity() : options.band_voxels;
  return unsigned_distance(soup, make_grid(soup, options), band, progress);
}

DistanceField unsigned_distance(const CleanSoup& soup, const GridFrame& frame, double band, const Progress& progress) {
  StageWatch watch(progress, "distance");
  watch.enter_part(0, 0.1);
  const SoupFeatures features = find_features(soup, frame, watch);
  const TriangleTree tree(features, watch);
  DistanceField field;
  field.distance = measure(features, frame, band, watch);
  field.d_max = static_cast<double>(farthest_distance(field.distance, band, tree, watch));
  field.band = band * frame.voxel_size;
  return field;
}

void widen_distance(DistanceField& field, const CleanSoup& soup, double band_voxels, const Progress& progress) {
  const GridFrame frame = field.distance.frame;
  if (band_voxels * frame.voxel_size <= field.band) return;
  StageWatch watch(progress, "distance");
  watch.enter_part(0, 0.1);
  const SoupFeatures features = find_features(soup, frame, watch);
  field.distance = measure(features, frame, band_voxels, watch);
  field.band = band_voxels * frame.voxel_size;
}

}  // namespace tetsoup
