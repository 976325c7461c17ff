#include "distance/scan_conversion.h"

#include <cmath>
#include <limits>
#include <mutex>
#include <numeric>

#include "base/block_grid.h"
#include "distance/region_rows.h"

namespace tetsoup {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr std::size_t kChunk = 2048;  ///< Features that one task cuts into rows.
constexpr int kManyRows = 512;        ///< A region with more is cut anew in every slab, so that memory stays small.

struct LargeFeature {
  std::uint32_t feature;
  IndexRange layers;
};

/// A chunk of features: the rows of the small ones, by slab, and the large ones.
struct ChunkRows {
  std::vector<FeatureRow> rows;
  std::vector<std::size_t> slab_begins;  ///< One more at the end.
  std::vector<LargeFeature> large;
};

ChunkRows sorted_by_slab(const std::vector<FeatureRow>& rows, std::size_t slabs) {
  ChunkRows sorted{std::vector<FeatureRow>(rows.size()), std::vector<std::size_t>(slabs + 1), {}};
  for (const FeatureRow& row : rows) ++sorted.slab_begins[row.z / BlockGrid::kSlab];
  std::exclusive_scan(sorted.slab_begins.begin(), sorted.slab_begins.end(), sorted.slab_begins.begin(), std::size_t{0});
  std::vector<std::size_t> next = sorted.slab_begins;
  for (const FeatureRow& row : rows) sorted.rows[next[row.z / BlockGrid::kSlab]++] = row;
  return sorted;
}

/// Features count on: faces first, then edges, then corners.
FeatureRegion region_of(const SoupFeatures& features, std::size_t i, float band, const GridFrame& frame) {
  const std::size_t faces = features.faces.size(), edges = features.edges.size();
  if (i < faces) return face_region(features, static_cast<std::uint32_t>(i), band, frame);
  if (i < faces + edges) return edge_region(features, static_cast<std::uint32_t>(i - faces), band, frame);
  return corner_region(features, static_cast<std::uint32_t>(i - faces - edges), band, frame);
}

bool is_large(const FeatureRegion& region) {
  const auto size = [](const IndexRange& range) { return std::max(0, range.end - range.begin); };
  return size(region.box[0]) > 0 && size(region.box[1]) * size(region.box[2]) > kManyRows;
}

std::vector<ChunkRows> cut_into_rows(const SoupFeatures& features, float band, const GridFrame& frame,
                                     std::size_t slabs, StageWatch& watch) {
  const std::size_t count = features.faces.size() + features.edges.size() + features.corners.size();
  std::vector<ChunkRows> chunks((count + kChunk - 1) / kChunk);
  parallel_for(static_cast<std::int64_t>(count), kChunk, watch, [&](std::int64_t begin, std::int64_t end) {
    RegionRows clip;
    std::vector<FeatureRow> rows;
    std::vector<LargeFeature> large;
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      const FeatureRegion region = region_of(features, i, band, frame);
      if (is_large(region))
        large.push_back({static_cast<std::uint32_t>(i), region.box[2]});
      else
        clip.append(region, static_cast<std::uint32_t>(i), rows);
    }
    ChunkRows& chunk = chunks[static_cast<std::size_t>(begin) / kChunk];
    chunk = sorted_by_slab(rows, slabs);
    chunk.large = std::move(large);
  });
  return chunks;
}

/// Squared distances of a slab, its rows padded to whole blocks, and the blocks that something was written to.
class SlabSquares {
 public:
  void cover(IndexRange layers, int ny, std::size_t blocks_per_row) {
    layers_ = layers;
    ny_ = ny;
    blocks_per_row_ = blocks_per_row;
    const std::size_t blocks =
        static_cast<std::size_t>(layers.end - layers.begin) * static_cast<std::size_t>(ny) * blocks_per_row;
    touched_.assign(blocks, 0);
    if (values_.size() < blocks * kBlock) values_.resize(blocks * kBlock, kernel::kBeyond);
  }

  template <class Square>
  void lower(const FeatureRow& part, const Square& square) {
    const IndexRange xs{part.x_begin, part.x_end};
    const auto fy = static_cast<float>(part.y), fz = static_cast<float>(part.z);
    const std::size_t row = static_cast<std::size_t>((part.z - layers_.begin) * ny_ + part.y) * blocks_per_row_;
    const auto first = static_cast<std::size_t>(xs.begin) / kBlock,
               last = static_cast<std::size_t>(xs.end - 1) / kBlock;
    for (std::size_t b = first; b <= last; ++b) touched_[row + b] = 1;
    float* values = values_.data() + row * kBlock;
    for (int x = xs.begin; x < xs.end; ++x) {
      const float s = square(static_cast<float>(x), fy, fz);
      values[x] = s < values[x] ? s : values[x];
    }
  }

  /// Moves the distances within the band to the grid and is clean again.
  void store(BlockGrid::Slab& slab, float band_squared, float voxel_size) {
    std::size_t known = 0;
    for (std::size_t i = 0; i < touched_.size(); ++i) {
      if (!touched_[i]) continue;
      float least = kernel::kBeyond;
      for (std::size_t k = 0; k < kBlock; ++k) least = std::min(least, values_[i * kBlock + k]);
      slab.places[i] = least < band_squared ? static_cast<std::uint32_t>(++known) : 0;
    }
    slab.values.reserve((known + 1) * kBlock);
    for (std::size_t i = 0; i < touched_.size(); ++i) {
      if (!touched_[i]) continue;
      float* block = values_.data() + i * kBlock;
      if (slab.places[i] != 0) {
        slab.values.insert(slab.values.end(), block, block + kBlock);
        float* stored = slab.values.data() + slab.places[i] * kBlock;
        for (std::size_t k = 0; k < kBlock; ++k)
          stored[k] = stored[k] < band_squared ? std::sqrt(stored[k]) * voxel_size : kInfinity;
      }
      std::fill_n(block, kBlock, kernel::kBeyond);
    }
  }

 private:
  static constexpr std::size_t kBlock = BlockGrid::kBlock;
  IndexRange layers_{};
  int ny_ = 0;
  std::size_t blocks_per_row_ = 0;
  std::vector<float> values_;
  std::vector<std::uint8_t> touched_;
};

/// Buffers of the tasks at work: as many as threads.
class SlabPool {
 public:
  SlabSquares take() {
    const std::lock_guard lock(mutex_);
    if (free_.empty()) return {};
    SlabSquares slab = std::move(free_.back());
    free_.pop_back();
    return slab;
  }
  void give(SlabSquares slab) {
    const std::lock_guard lock(mutex_);
    free_.push_back(std::move(slab));
  }

 private:
  std::mutex mutex_;
  std::vector<SlabSquares> free_;
};

void lower(const SoupFeatures& features, const FeatureRow& row, SlabSquares& slab) {
  const std::size_t faces = features.faces.size(), edges = features.edges.size();
  if (row.feature < faces) {
    const kernel::FacePlan& plan = features.faces[row.feature];
    slab.lower(row, [&](float x, float y, float z) { return kernel::face_square(plan, x, y, z); });
  } else if (row.feature < faces + edges) {
    const SoupFeatures::Edge& e = features.edges[row.feature - faces];
    const kernel::EdgePlan plan = kernel::plan_edge(features.corners[e.from], features.corners[e.to]);
    slab.lower(row, [&](float x, float y, float z) { return kernel::edge_square(plan, x, y, z); });
  } else {
    const Vec3 at = features.corners[row.feature - faces - edges];
    slab.lower(row, [&](float x, float y, float z) { return kernel::corner_square(at, x, y, z); });
  }
}

}  // namespace

BlockGrid scan_convert(const SoupFeatures& features, const GridFrame& frame, float band_voxels, StageWatch& watch) {
  BlockGrid grid = make_block_grid(frame);
  const std::vector<ChunkRows> chunks = cut_into_rows(features, band_voxels, frame, grid.slabs.size(), watch);
  SlabPool pool;
  parallel_for(static_cast<std::int64_t>(grid.slabs.size()), 1, watch, [&](std::int64_t index, std::int64_t) {
    const auto i = static_cast<std::size_t>(index);
    const int first = static_cast<int>(i) * BlockGrid::kSlab;
    SlabSquares slab = pool.take();
    const IndexRange layers{first, first + slab_layers(frame, i)};
    slab.cover(layers, frame.size[1], grid.blocks_per_row);
    RegionRows clip;
    std::vector<FeatureRow> rows;
    for (const ChunkRows& chunk : chunks) {
      for (std::size_t k = chunk.slab_begins[i]; k < chunk.slab_begins[i + 1]; ++k)
        lower(features, chunk.rows[k], slab);
      for (const LargeFeature& large : chunk.large) {
        if (large.layers.begin >= layers.end || large.layers.end <= layers.begin) continue;
        FeatureRegion region = region_of(features, large.feature, band_voxels, frame);
        region.box[2] = {std::max(large.layers.begin, layers.begin), std::min(large.layers.end, layers.end)};
        rows.clear();
        clip.append(region, large.feature, rows);
        for (const FeatureRow& row : rows) lower(features, row, slab);
      }
      watch.poll();
      if (watch.stopped()) return;
    }
    slab.store(grid.slabs[i], band_voxels * band_voxels, static_cast<float>(frame.voxel_size));
    pool.give(std::move(slab));
  });
  return grid;
}

}  // namespace tetsoup
