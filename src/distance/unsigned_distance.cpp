#include <cmath>
#include <limits>

#include "base/bits.h"
#include "base/block_grid.h"
#include "distance/far_field.h"
#include "distance/farthest_voxel.h"
#include "distance/scan_conversion.h"
#include "distance/triangle_tree.h"
#include "kernel/voxels_below.h"
#include "tetsoup/distance.h"

namespace tetsoup {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
/// Voxels; the band that is scan-converted. Beyond it the regions of a soup's features overlap so much that asking the
/// tree is cheaper.
constexpr double kScanBand = 10;

float squared_band(double band_voxels) {
  const auto band = static_cast<float>(std::min(band_voxels, 1e6));  // beyond any grid
  return band * band;
}

/// Squared voxels to lengths; infinity where the band ends.
float to_length(float square, float band_squared, float voxel_size) {
  return square < band_squared ? std::sqrt(square) * voxel_size : kInfinity;
}

/// The largest value over the unpadded box; searched by the tree unless the band holds all of the box.
float farthest_distance(const BlockGrid& distance, double band, const TriangleTree& tree, StageWatch& watch) {
  const GridFrame& frame = distance.frame;
  if (!std::isinf(band)) {
    float largest = 0;
    for (int z = frame.pad; z < frame.size[2] - frame.pad && largest < kInfinity; ++z)
      for (int y = frame.pad; y < frame.size[1] - frame.pad && largest < kInfinity; ++y)
        for (int x = frame.pad; x < frame.size[0] - frame.pad && largest < kInfinity; ++x)
          largest = std::max(largest, distance.at(x, y, z));
    if (largest < kInfinity) return largest;
  }
  return std::sqrt(farthest_voxel_squared(tree, frame, watch)) * static_cast<float>(frame.voxel_size);
}

/// Voxels that a band of `to` voxels can reach if all distances below `from` are known: on the way to its nearest point
/// such a voxel meets the known ones after to - from voxels, give or take half a voxel's diagonal twice.
BitGrid reachable(const BlockGrid& distance, double from, double to, StageWatch& watch) {
  constexpr double kDiagonal = 1.74;
  const BitGrid known = std::move(kernel::voxels_below(distance, {&kInfinity, 1}, watch).front());
  return dilated(known, static_cast<int>(std::ceil(to - from + kDiagonal)));
}

/// Asks the tree for every unknown voxel of a row that the band can reach. Along the row the last answer plus one step
/// bounds the next.
class RowFiller {
 public:
  RowFiller(const TriangleTree& tree, const BitGrid& wanted, double band_voxels, double voxel_size)
      : tree_(tree),
        wanted_(wanted),
        band_squared_(squared_band(band_voxels)),
        voxel_size_(static_cast<float>(voxel_size)) {}

  void fill(float* values, int nx, int y, int z) const {
    const auto fy = static_cast<float>(y), fz = static_cast<float>(z);
    float bound = band_squared_;
    for (int x = 0; x < nx; ++x) {
      if (!wanted_.test(x, y, z)) {
        bound = band_squared_;
        continue;
      }
      if (!(values[x] < kInfinity))
        values[x] = to_length(tree_.nearest_squared(static_cast<float>(x), fy, fz, bound), band_squared_, voxel_size_);
      const float next = (values[x] / voxel_size_ + 1.001F) * 1.001F;
      bound = std::min(band_squared_, next * next);
    }
  }

 private:
  const TriangleTree& tree_;
  const BitGrid& wanted_;
  float band_squared_, voxel_size_;
};

/// The field with its unknown voxels within the band asked from the tree.
BlockGrid filled(const BlockGrid& distance, const TriangleTree& tree, double known_voxels, double band_voxels,
                 StageWatch& watch) {
  const GridFrame& frame = distance.frame;
  const BitGrid wanted = reachable(distance, known_voxels, band_voxels, watch);
  const RowFiller filler(tree, wanted, band_voxels, frame.voxel_size);
  const std::size_t stride = distance.blocks_per_row * BlockGrid::kBlock;
  BlockGrid out = make_block_grid(frame);
  std::vector<float> slab;
  for (std::size_t i = 0; i < out.slabs.size(); ++i) {
    slab.resize(slab_values(out, i));
    load_slab(distance, i, slab);
    parallel_for(static_cast<std::int64_t>(slab.size() / stride), 2, watch, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t row = begin; row < end && !watch.stopped(); ++row)
        filler.fill(slab.data() + static_cast<std::size_t>(row) * stride, frame.size[0],
                    static_cast<int>(row % frame.size[1]),
                    static_cast<int>(i) * BlockGrid::kSlab + static_cast<int>(row / frame.size[1]));
    });
    store_slab(out, i, slab);
  }
  return out;
}

/// Distances up to `band` voxels, by the way that suits the band. `tree` may be null: it is made where it is needed.
BlockGrid measure(const SoupFeatures& features, const GridFrame& frame, double band, const TriangleTree* tree,
                  StageWatch& watch) {
  if (std::isinf(band)) {
    watch.enter_part(0.1, 0.2);
    const BlockGrid near = scan_convert(features, frame, static_cast<float>(kFarField), watch);
    watch.enter_part(0.2, 1);
    return fill_far_field(near, features, watch);
  }
  watch.enter_part(0.1, band > kScanBand ? 0.2 : 0.8);
  BlockGrid near = scan_convert(features, frame, static_cast<float>(std::min(band, kScanBand)), watch);
  if (band <= kScanBand) return near;
  watch.enter_part(0.2, 1);
  if (tree) return filled(near, *tree, kScanBand, band, watch);
  return filled(near, TriangleTree(features, watch), kScanBand, band, watch);
}

}  // namespace

DistanceField unsigned_distance(const CleanSoup& soup, const DistanceOptions& options, const Progress& progress) {
  const GridFrame frame = make_grid(soup, options);
  StageWatch watch(progress, "distance");
  const double band =
      options.mode == DistanceMode::Full ? std::numeric_limits<double>::infinity() : options.band_voxels;
  watch.enter_part(0, 0.1);
  const SoupFeatures features = find_features(soup, frame, watch);
  const TriangleTree tree(features, watch);
  DistanceField field;
  field.distance = measure(features, frame, band, &tree, watch);
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
  field.distance = measure(features, frame, band_voxels, nullptr, watch);
  field.band = band_voxels * frame.voxel_size;
}

}  // namespace tetsoup
