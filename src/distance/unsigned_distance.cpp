#include <cmath>
#include <limits>

#include "base/bits.h"
#include "base/block_grid.h"
#include "base/parallel.h"
#include "base/require.h"
#include "distance/band_raster.h"
#include "distance/farthest_voxel.h"
#include "distance/triangle_tree.h"
#include "tetsoup/distance.h"

namespace tetsoup {
namespace {

using kernel::TrianglePlan;
constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr std::int64_t kValuesPerTask = 1 << 16;
/// Voxels; what every triangle lowers directly. Beyond, asking the tree once a voxel is cheaper than every triangle's
/// cube.
constexpr double kRasterBand = 4;
/// Looks at a voxel, on average, beyond which the tree is asked for all of them: more triangles than voxels. Not if the
/// triangles are so large that the tree's boxes overlap: it would look at most of them each time.
constexpr double kMaxLooks = 200, kMaxOverlap = 4;

/// The soup in voxel units: voxel centres are the whole numbers. Planned from double coordinates, so position and scale
/// of the soup cost no precision here.
std::vector<TrianglePlan> plan_triangles(const CleanSoup& soup, const GridFrame& frame, StageWatch& watch) {
  std::vector<Vec3> vertices(soup.soup.vertices.size());
  for (std::size_t i = 0; i < vertices.size(); ++i)
    vertices[i] = to_float((to_double(soup.soup.vertices[i]) - frame.origin) * (1 / frame.voxel_size));
  const auto& triangles = soup.soup.triangles;
  std::vector<TrianglePlan> plans(triangles.size());
  parallel_for(static_cast<std::int64_t>(triangles.size()), 4096, watch, [&](std::int64_t begin, std::int64_t end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i)
      plans[i] = kernel::plan_triangle(vertices[triangles[i][0]], vertices[triangles[i][1]], vertices[triangles[i][2]]);
  });
  return plans;
}

/// Squared voxels to lengths; infinity where the band ends.
float to_length(float square, float band_squared, float voxel_size) {
  return square < band_squared ? std::sqrt(square) * voxel_size : kInfinity;
}

void squares_to_lengths(std::vector<float>& values, float band_squared, float voxel_size, StageWatch& watch) {
  parallel_for(static_cast<std::int64_t>(values.size()), kValuesPerTask, watch,
               [&](std::int64_t begin, std::int64_t end) {
                 for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i)
                   values[i] = to_length(values[i], band_squared, voxel_size);
               });
}

/// The largest value over the unpadded box; searched by the tree only if some voxel there is not known yet.
float farthest_distance(const Grid<float>& distance, const TriangleTree& tree, StageWatch& watch) {
  const GridFrame& frame = distance.frame;
  float largest = 0;
  for (int z = frame.pad; z < frame.size[2] - frame.pad && largest < kInfinity; ++z)
    for (int y = frame.pad; y < frame.size[1] - frame.pad && largest < kInfinity; ++y)
      for (int x = frame.pad; x < frame.size[0] - frame.pad; ++x) largest = std::max(largest, distance.at(x, y, z));
  if (largest < kInfinity) return largest;
  return std::sqrt(farthest_voxel_squared(tree, frame, watch)) * static_cast<float>(frame.voxel_size);
}

float squared_band(double band_voxels) {
  const auto band = static_cast<float>(std::min(band_voxels, 1e6));  // beyond any grid
  return band * band;
}

/// Voxels that a band of `to` voxels can reach if all distances below `from` are known: on the way to its nearest point
/// such a voxel meets the known ones after to - from voxels, give or take half a voxel's diagonal twice.
BitGrid reachable(const Grid<float>& distance, double from, double to, StageWatch& watch) {
  constexpr double kDiagonal = 1.74;
  const GridFrame& frame = distance.frame;
  BitGrid known = make_bit_grid(frame);
  const std::int64_t rows = static_cast<std::int64_t>(frame.size[1]) * frame.size[2];
  const auto nx = static_cast<std::size_t>(frame.size[0]);
  parallel_for(rows, 64, watch, [&](std::int64_t begin, std::int64_t end) {
    for (auto row = static_cast<std::size_t>(begin); row < static_cast<std::size_t>(end); ++row)
      for (std::size_t x = 0; x < nx; ++x)
        known.words[row * known.words_per_row + x / 64] |=
            static_cast<std::uint64_t>(distance.values[row * nx + x] < kInfinity) << (x % 64);
  });
  return dilated(known, static_cast<int>(std::ceil(to - from + kDiagonal)));
}

/// Asks the tree for every unknown voxel that the band can reach. Along a row the last answer plus one step bounds the
/// next.
void fill_unknown(const TriangleTree& tree, double known_voxels, double band_voxels, Grid<float>& distance,
                  StageWatch& watch) {
  constexpr double kLocal = 16;  // voxels; a band that grows by more reaches most of the grid anyway
  const GridFrame& frame = distance.frame;
  const auto voxel_size = static_cast<float>(frame.voxel_size);
  const float band_squared = squared_band(band_voxels);
  const bool local = known_voxels > 0 && band_voxels - known_voxels < kLocal;
  const BitGrid wanted = local ? reachable(distance, known_voxels, band_voxels, watch) : BitGrid{};
  const std::int64_t rows = static_cast<std::int64_t>(frame.size[1]) * frame.size[2];
  parallel_for(rows, 2, watch, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t row = begin; row < end; ++row) {
      const int y = static_cast<int>(row % frame.size[1]), z = static_cast<int>(row / frame.size[1]);
      float* values = distance.values.data() + distance.index(0, y, z);
      float bound = band_squared;
      for (int x = 0; x < frame.size[0]; ++x) {
        if (local && !wanted.test(x, y, z)) {
          bound = band_squared;
          continue;
        }
        if (!(values[x] < kInfinity)) {
          const float square =
              tree.nearest_squared(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z), bound);
          values[x] = to_length(square, band_squared, voxel_size);
        }
        const float next = (values[x] / voxel_size + 1.001F) * 1.001F;
        bound = std::min(band_squared, next * next);
      }
      if (watch.stopped()) return;
    }
  });
}

}  // namespace

// TEMP
BlockGrid in_blocks(const Grid<float>& dense) {
  BlockGrid grid = make_block_grid(dense.frame);
  const auto nx = static_cast<std::size_t>(dense.frame.size[0]), ny = static_cast<std::size_t>(dense.frame.size[1]);
  const std::size_t padded = grid.blocks_per_row * BlockGrid::kBlock;
  std::vector<float> slab;
  for (std::size_t i = 0; i < grid.slabs.size(); ++i) {
    slab.assign(slab_values(grid, i), kInfinity);
    for (std::size_t row = 0; row < slab.size() / padded; ++row)
      std::copy_n(dense.values.begin() + static_cast<std::ptrdiff_t>((i * BlockGrid::kSlab * ny + row) * nx), nx,
                  slab.begin() + static_cast<std::ptrdiff_t>(row * padded));
    store_slab(grid, i, slab);
  }
  return grid;
}

DistanceField unsigned_distance(const CleanSoup& soup, const DistanceOptions& options, const Progress& progress) {
  DistanceField field;
  Grid<float> distance{make_grid(soup, options), {}};
  const GridFrame& frame = distance.frame;
  StageWatch watch(progress, "distance");
  watch.enter_part(0, 0.02);
  const std::vector<TrianglePlan> triangles = plan_triangles(soup, frame, watch);

  distance.values.resize(frame.voxel_count());
  const bool full = options.mode == DistanceMode::Full;
  const double band = full ? std::numeric_limits<double>::infinity() : options.band_voxels;
  double raster = std::min(band, kRasterBand);
  const RasterWork work = estimate_work(triangles, static_cast<float>(raster));
  const auto voxels = static_cast<double>(frame.voxel_count());
  if (work.looks > kMaxLooks * voxels && work.box_voxels < kMaxOverlap * voxels) raster = 0;
  watch.enter_part(0.02, full ? 0.2 : 0.7);
  raster_band(triangles, static_cast<float>(raster), distance, watch);
  squares_to_lengths(distance.values, squared_band(raster), static_cast<float>(frame.voxel_size), watch);

  const TriangleTree tree(triangles, watch);
  field.d_max = static_cast<double>(farthest_distance(distance, tree, watch));
  watch.enter_part(full ? 0.2 : 0.7, 1);
  if (band > raster) fill_unknown(tree, raster, band, distance, watch);
  field.band = band * frame.voxel_size;
  field.distance = in_blocks(distance);
  return field;
}

void widen_distance(DistanceField& field, const CleanSoup& soup, double band_voxels, const Progress& progress) {
  const GridFrame& frame = field.distance.frame;
  if (band_voxels * frame.voxel_size <= field.band) return;
  StageWatch watch(progress, "distance");
  Grid<float> distance = dense(field.distance);
  watch.enter_part(0, 0.05);
  const TriangleTree tree(plan_triangles(soup, frame, watch), watch);
  watch.enter_part(0.05, 1);
  fill_unknown(tree, field.band / frame.voxel_size, band_voxels, distance, watch);
  field.distance = in_blocks(distance);
  field.band = band_voxels * field.distance.frame.voxel_size;
}

}  // namespace tetsoup
