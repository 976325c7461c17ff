#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include "distance/far_field.h"
#include "distance/farthest_voxel.h"
#include "distance/fine_soups.h"
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
template <class Tree>
double farthest_distance(const BlockGrid& distance, double band, const Tree& tree, StageWatch& watch) {
  const GridFrame& frame = distance.frame;
  if (band <= kScanBand) {
    float largest = 0;
    for (int z = frame.pad; z < frame.size[2] - frame.pad && largest < kInfinity; ++z)
      for (int y = frame.pad; y < frame.size[1] - frame.pad && largest < kInfinity; ++y)
        for (int x = frame.pad; x < frame.size[0] - frame.pad && largest < kInfinity; ++x)
          largest = std::max(largest, distance.at(x, y, z));
    if (largest < kInfinity) return double{largest};
  }
  const auto nearest = [&](float x, float y, float z, float bound) { return tree.nearest_squared(x, y, z, bound); };
  return double{std::sqrt(farthest_voxel_squared(nearest, frame, watch)) * static_cast<float>(frame.voxel_size)};
}

/// Distances up to `band` voxels by way of the soup's features.
BlockGrid measure(const CleanSoup& soup, const GridFrame& frame, double band, StageWatch& watch) {
  const SoupFeatures features = find_features(soup, frame, watch);
  watch.enter_part(0.1, band <= kScanBand ? 0.8 : 0.2);
  const double scanned = band <= kScanBand ? band : kFarField;
  BlockGrid near = scan_convert(features, frame, static_cast<float>(scanned), watch);
  if (band <= kScanBand) return near;
  watch.enter_part(0.2, 1);
  return fill_far_field(near, features, band, watch);
}

/// Voxels to be asked one by one, where that suits band and soup.
std::optional<BitGrid> voxels_to_ask(const CleanSoup& soup, std::span<const Vec3> corners, const GridFrame& frame,
                                     double band, StageWatch& watch) {
  if (band > kScanBand) return std::nullopt;
  return voxels_worth_asking(soup.soup.triangles, corners, frame, band, watch);
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
  const std::vector<Vec3> corners = voxel_vertices(soup, frame);
  DistanceField field;
  field.band = band * frame.voxel_size;
  if (const auto wanted = voxels_to_ask(soup, corners, frame, band, watch)) {
    const CornerTree tree(soup.soup.triangles, corners, watch);
    watch.enter_part(0.5, 1);
    field.distance = ask_voxels(tree, *wanted, band, watch);
    field.d_max = farthest_distance(field.distance, band, tree, watch);
    return field;
  }
  field.distance = measure(soup, frame, band, watch);
  const TriangleTree tree(soup.soup.triangles, corners, watch);
  field.d_max = farthest_distance(field.distance, band, tree, watch);
  return field;
}

void widen_distance(DistanceField& field, const CleanSoup& soup, double band_voxels, const Progress& progress) {
  const GridFrame frame = field.distance.frame;
  if (band_voxels * frame.voxel_size <= field.band) return;
  StageWatch watch(progress, "distance");
  watch.enter_part(0, 0.1);
  const std::vector<Vec3> corners = voxel_vertices(soup, frame);
  if (const auto wanted = voxels_to_ask(soup, corners, frame, band_voxels, watch)) {
    const CornerTree tree(soup.soup.triangles, corners, watch);
    watch.enter_part(0.5, 1);
    field.distance = ask_voxels(tree, *wanted, band_voxels, watch);
  } else {
    field.distance = measure(soup, frame, band_voxels, watch);
  }
  field.band = band_voxels * frame.voxel_size;
}

}  // namespace tetsoup
