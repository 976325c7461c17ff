#include "distance/fine_soups.h"

#include <cmath>
#include <limits>

#include "base/bits.h"
#include "base/block_grid.h"

namespace tetsoup {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr std::size_t kManyTriangles = 200000;  ///< Fewer are scan-converted within a tenth of a second.
constexpr std::size_t kVoxelsPerTriangle = 64;  ///< A larger grid would take more memory as bits than the triangles do.
constexpr std::size_t kCellsPerTriangle = 8;    ///< More voxels in the boxes of the triangles, and they are not fine.
/// Asking for a voxel costs as much as scan-converting so many triangles.
constexpr std::size_t kTrianglesPerVoxel = 3;
constexpr std::size_t kLongCells = 27;  ///< A triangle whose box has more voxels is long for a CornerTree.
constexpr std::size_t kMostLong = 64;   ///< Triangles.

/// The voxels whose cells the boxes of the triangles meet; none if those are too many.
std::optional<BitGrid> touched_voxels(std::span<const Triangle> triangles, std::span<const Vec3> corners,
                                      const GridFrame& frame, StageWatch& watch) {
  constexpr std::size_t kOften = 0xFFFF;
  BitGrid touched = make_bit_grid(frame);
  std::size_t left = kCellsPerTriangle * triangles.size(), long_ones = 0;
  const auto index = [](float at, int size) { return std::clamp(static_cast<int>(at + 0.5F), 0, size - 1); };
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if ((t & kOften) == 0) watch.step(0);
    const auto [lo, hi] = triangle_box(corners, triangles[t]);
    const int x0 = index(lo.x, frame.size[0]), x1 = index(hi.x, frame.size[0]);
    const int y0 = index(lo.y, frame.size[1]), y1 = index(hi.y, frame.size[1]);
    const int z0 = index(lo.z, frame.size[2]), z1 = index(hi.z, frame.size[2]);
    const std::size_t cells = static_cast<std::size_t>(x1 - x0 + 1) * static_cast<std::size_t>(y1 - y0 + 1) *
                              static_cast<std::size_t>(z1 - z0 + 1);
    if (cells > kLongCells && ++long_ones > kMostLong) return std::nullopt;
    if (cells > left) return std::nullopt;
    left -= cells;
    for (int z = z0; z <= z1; ++z) {
      for (int y = y0; y <= y1; ++y) {
        std::uint64_t* row = touched.words.data() + touched.row(y, z);
        for (int x = x0; x <= x1; ++x) row[x >> 6] |= std::uint64_t{1} << (x & 63);
      }
    }
  }
  return touched;
}

/// Along a row the last answer plus one step bounds the next.
void ask_row(const CornerTree& tree, const BitGrid& wanted, int y, int z, float band_squared, float* squares) {
  float bound = band_squared;
  const std::size_t row = wanted.row(y, z);
  for (std::size_t w = 0; w < wanted.words_per_row; ++w) {
    if (wanted.words[row + w] == 0) {
      bound = band_squared;
      continue;
    }
    for (int x = static_cast<int>(64 * w); x < std::min(static_cast<int>(64 * w + 64), wanted.frame.size[0]); ++x) {
      if (!wanted.test(x, y, z)) {
        bound = band_squared;
        continue;
      }
      squares[x] = tree.nearest_squared(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z), bound);
      const float next = (std::sqrt(squares[x]) + 1.001F) * 1.001F;
      bound = std::min(band_squared, next * next);
    }
  }
}

}  // namespace

std::optional<BitGrid> voxels_worth_asking(std::span<const Triangle> triangles, std::span<const Vec3> corners,
                                           const GridFrame& frame, double band, StageWatch& watch) {
  const double voxels = 1.0 * frame.size[0] * frame.size[1] * frame.size[2];
  if (triangles.size() < kManyTriangles || voxels > static_cast<double>(kVoxelsPerTriangle * triangles.size()))
    return std::nullopt;
  const std::optional<BitGrid> touched = touched_voxels(triangles, corners, frame, watch);
  if (!touched) return std::nullopt;
  // A voxel lies within the band of some point, and that within half a voxel of a touched one, along each axis.
  BitGrid wanted = dilated(*touched, static_cast<int>(band + 0.501));
  std::size_t count = 0;
  for (const std::uint64_t word : wanted.words) count += bit_count(word);
  if (count * kTrianglesPerVoxel > triangles.size()) return std::nullopt;
  return wanted;
}

BlockGrid ask_voxels(const CornerTree& tree, const BitGrid& wanted, double band, StageWatch& watch) {
  const GridFrame& frame = wanted.frame;
  BlockGrid grid = make_block_grid(frame);
  const auto band_squared = static_cast<float>(band) * static_cast<float>(band);
  const auto voxel_size = static_cast<float>(frame.voxel_size);
  const std::size_t stride = grid.blocks_per_row * BlockGrid::kBlock;
  std::vector<float> slab;
  for (std::size_t i = 0; i < grid.slabs.size(); ++i) {
    slab.assign(slab_values(grid, i), kInfinity);
    parallel_for(static_cast<std::int64_t>(slab.size() / stride), 2, watch, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t row = begin; row < end && !watch.stopped(); ++row) {
        float* values = slab.data() + static_cast<std::size_t>(row) * stride;
        ask_row(tree, wanted, static_cast<int>(row % frame.size[1]),
                static_cast<int>(i) * BlockGrid::kSlab + static_cast<int>(row / frame.size[1]), band_squared, values);
        for (int x = 0; x < frame.size[0]; ++x)
          values[x] = values[x] < band_squared ? std::sqrt(values[x]) * voxel_size : kInfinity;
      }
    });
    store_slab(grid, i, slab);
  }
  return grid;
}

}  // namespace tetsoup
