#include "distance/far_field.h"

#include <cmath>
#include <limits>

#include "base/block_grid.h"
#include "distance/surface_points.h"

namespace tetsoup {
namespace {

static_assert(kPointSpacing * kPointSpacing / (4 * kFarField) < 0.045);

/// Asks for the unknown voxels of a slab, brick by brick: what was nearest to one brick is a hint for the next.
class SlabFiller {
 public:
  SlabFiller(const GridFrame& frame, std::size_t row_stride, const PointTree& tree)
      : frame_(frame), stride_(row_stride), tree_(tree.view()) {}

  int brick_rows() const { return (frame_.size[1] + kernel::kBrick - 1) / kernel::kBrick; }

  /// Fills the rows y0..y0 + 3 of the layers z_begin..z_end, which are all of the slab's.
  void fill(std::span<float> slab, int y0, int z_begin, int z_end) const {
    std::uint32_t hint = 0;
    for (int z0 = z_begin; z0 < z_end; z0 += kernel::kBrick)
      for (int x0 = 0; x0 < frame_.size[0]; x0 += kernel::kBrick) fill_brick(slab, {x0, y0, z0}, z_begin, hint);
  }

 private:
  void fill_brick(std::span<float> slab, const std::array<int, 3>& at, int z_begin, std::uint32_t& hint) const {
    std::array<float, kernel::kBrick * kernel::kBrick * kernel::kBrick> squares{};
    const auto for_unknown = [&](const auto& body) {
      std::size_t i = 0;
      for (int z = at[2]; z < at[2] + kernel::kBrick; ++z) {
        for (int y = at[1]; y < at[1] + kernel::kBrick; ++y) {
          for (int x = at[0]; x < at[0] + kernel::kBrick; ++x, ++i) {
            if (!frame_.contains(x, y, z)) continue;
            float& value = slab[static_cast<std::size_t>((z - z_begin) * frame_.size[1] + y) * stride_ +
                                static_cast<std::size_t>(x)];
            if (std::isinf(value)) body(value, squares[i]);
          }
        }
      }
    };
    bool any = false;
    for_unknown([&](float, float& square) {
      square = std::numeric_limits<float>::max();
      any = true;
    });
    if (!any) return;
    kernel::lower_brick(tree_, at[0], at[1], at[2], squares, hint);
    for_unknown([&](float& value, float square) { value = std::sqrt(square) * static_cast<float>(frame_.voxel_size); });
  }

  const GridFrame& frame_;
  std::size_t stride_;
  kernel::PointTreeView tree_;
};

}  // namespace

BlockGrid fill_far_field(const BlockGrid& band, const SoupFeatures& features, StageWatch& watch) {
  const PointTree tree(surface_points(features), watch);
  BlockGrid out = make_block_grid(band.frame);
  const SlabFiller filler(band.frame, band.blocks_per_row * BlockGrid::kBlock, tree);
  std::vector<float> slab;
  for (std::size_t i = 0; i < out.slabs.size(); ++i) {
    slab.resize(slab_values(out, i));
    load_slab(band, i, slab);
    const int z_begin = static_cast<int>(i) * BlockGrid::kSlab, z_end = z_begin + slab_layers(band.frame, i);
    parallel_for(filler.brick_rows(), 1, watch, [&](std::int64_t row, std::int64_t) {
      filler.fill(slab, static_cast<int>(row) * kernel::kBrick, z_begin, z_end);
    });
    store_slab(out, i, slab);
  }
  return out;
}

}  // namespace tetsoup
