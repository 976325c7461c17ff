#include "distance/far_field.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/block_grid.h"
#include "distance/surface_points.h"

namespace tetsoup {
namespace {

static_assert(kPointSpacing * kPointSpacing / (4 * kFarField) < 0.045);

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNoLimit = 1e15F;  ///< Voxels: beyond any grid, and its square is a number.
constexpr int kRegion = 64;        ///< Voxels along each edge of what is one piece of work.
static_assert(kRegion % BlockGrid::kBlock == 0 && kRegion % kernel::kBrick == 0);

/// Voxels z < 64 and rows of whole blocks, so that the bricks of a region never leave the memory.
class RegionFiller {
 public:
  RegionFiller(const GridFrame& frame, std::size_t row_stride, const kernel::PointColumns& points, float limit)
      : frame_(frame), stride_(row_stride), points_(points), limit_(limit) {}

  /// Fills the unknown voxels of the region at x0, y0 in layers z0 to z0 + 63, whose values are `layers`.
  void fill(std::span<float> layers, const std::array<int, 3>& at) const {
    std::array<kernel::PointColumns, 4> lists;  // for boxes of 64, 32, 16 and 8 voxels
    divide(layers, at, at[2], kRegion, points_, lists);
  }

 private:
  void divide(std::span<float> layers, const std::array<int, 3>& at, int first_layer, int edge,
              const kernel::PointColumns& points, std::span<kernel::PointColumns> lists) const {
    if (!frame_.contains(at[0], at[1], at[2])) return;
    if (edge == kernel::kBrick && !any_unknown(layers, at, first_layer)) return;
    const float half = static_cast<float>(edge - 1) * 0.5F;
    const Vec3 centre{static_cast<float>(at[0]) + half, static_cast<float>(at[1]) + half,
                      static_cast<float>(at[2]) + half};
    kernel::keep_candidates(points, {centre, {half, half, half}}, lists[0]);
    if (limit_ < kNoLimit && is_beyond(lists[0], centre, half)) return;
    if (edge == kernel::kBrick) return fill_brick(layers, at, first_layer, lists[0]);
    for (int i = 0; i < 8; ++i)
      divide(layers, {at[0] + (i & 1) * edge / 2, at[1] + (i >> 1 & 1) * edge / 2, at[2] + (i >> 2) * edge / 2},
             first_layer, edge / 2, lists[0], lists.subspan(1));
  }

  /// No voxel of the box is nearer than the limit.
  bool is_beyond(const kernel::PointColumns& points, const Vec3& centre, float half) const {
    constexpr float kSlack = 1.01F;
    float least = kInfinity;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const float dx = points.x[i] - centre.x, dy = points.y[i] - centre.y, dz = points.z[i] - centre.z;
      least = std::min(least, dx * dx + dy * dy + dz * dz);
    }
    return std::sqrt(least) > (limit_ + std::sqrt(3.0F) * half) * kSlack;
  }

  /// body(value, index in the brick) for the unknown voxels of a brick; false ends it.
  template <class Body>
  void for_unknown(std::span<float> layers, const std::array<int, 3>& at, int first_layer, const Body& body) const {
    const int nx = std::min(kernel::kBrick, frame_.size[0] - at[0]),
              ny = std::min(kernel::kBrick, frame_.size[1] - at[1]),
              nz = std::min(kernel::kBrick, frame_.size[2] - at[2]);
    for (int z = 0; z < nz; ++z) {
      for (int y = 0; y < ny; ++y) {
        float* row =
            &layers[static_cast<std::size_t>((at[2] + z - first_layer) * frame_.size[1] + at[1] + y) * stride_ +
                    static_cast<std::size_t>(at[0])];
        for (int x = 0; x < nx; ++x)
          if (std::isinf(row[x])) body(row[x], static_cast<std::size_t>((z * kernel::kBrick + y) * kernel::kBrick + x));
      }
    }
  }

  bool any_unknown(std::span<float> layers, const std::array<int, 3>& at, int first_layer) const {
    bool any = false;
    for_unknown(layers, at, first_layer, [&](float, std::size_t) { any = true; });
    return any;
  }

  void fill_brick(std::span<float> layers, const std::array<int, 3>& at, int first_layer,
                  const kernel::PointColumns& points) const {
    std::array<float, kernel::kBrick * kernel::kBrick * kernel::kBrick> squares;
    kernel::nearest_squares(points, at[0], at[1], at[2], squares);
    for_unknown(layers, at, first_layer, [&](float& value, std::size_t i) {
      if (squares[i] < limit_ * limit_) value = std::sqrt(squares[i]) * static_cast<float>(frame_.voxel_size);
    });
  }

  const GridFrame& frame_;
  std::size_t stride_;
  const kernel::PointColumns& points_;
  float limit_;  ///< Voxels.
};

}  // namespace

BlockGrid fill_far_field(const BlockGrid& band, const SoupFeatures& features, double limit, StageWatch& watch) {
  constexpr std::size_t kSlabs = kRegion / BlockGrid::kSlab;
  const kernel::PointColumns points = surface_points(features);
  watch.step(0);
  BlockGrid out = make_block_grid(band.frame);
  const RegionFiller filler(band.frame, band.blocks_per_row * BlockGrid::kBlock, points,
                            static_cast<float>(std::min(limit, double{kNoLimit})));
  const auto columns = static_cast<std::int64_t>(band.blocks_per_row);
  const std::int64_t regions = columns * ((band.frame.size[1] + kRegion - 1) / kRegion);
  std::vector<float> layers;
  for (std::size_t first = 0; first < out.slabs.size(); first += kSlabs) {
    const std::size_t count = std::min(kSlabs, out.slabs.size() - first), values = slab_values(out, first);
    const auto slab = [&](std::size_t i) { return std::span(layers).subspan(i * values, slab_values(out, first + i)); };
    layers.resize(count * values);
    for (std::size_t i = 0; i < count; ++i) load_slab(band, first + i, slab(i));
    parallel_for(regions, 1, watch, [&](std::int64_t i, std::int64_t) {
      filler.fill(layers, {static_cast<int>(i % columns) * kRegion, static_cast<int>(i / columns) * kRegion,
                           static_cast<int>(first) * BlockGrid::kSlab});
    });
    for (std::size_t i = 0; i < count; ++i) store_slab(out, first + i, slab(i));
  }
  return out;
}

}  // namespace tetsoup
