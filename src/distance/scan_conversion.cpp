#include "distance/scan_conversion.h"

#include <cmath>
#include <limits>
#include <mutex>
#include <numeric>

#include "base/block_grid.h"
#include "distance/row_clip.h"

namespace tetsoup {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Faces first, then edges, then corners, in one numbering.
class FeatureClips {
 public:
  FeatureClips(const SoupFeatures& features, float band, const GridFrame& frame, StageWatch& watch)
      : faces_(features.faces.size()), edges_(features.edges.size()) {
    const std::size_t count = faces_ + edges_ + features.corners.size();
    chunks_.resize((count + kChunk - 1) / kChunk);
    parallel_for(static_cast<std::int64_t>(chunks_.size()), 1, watch, [&](std::int64_t chunk, std::int64_t) {
      const std::size_t begin = static_cast<std::size_t>(chunk) * kChunk;
      for (std::size_t i = begin; i < std::min(count, begin + kChunk); ++i) {
        const auto append = [&](const FeatureRegion& region) {
          chunks_[static_cast<std::size_t>(chunk)].append(region);
        };
        visit_feature(
            i, [&](std::uint32_t face) { append(face_region(features, face, band, frame)); },
            [&](std::uint32_t edge) { append(edge_region(features, edge, band, frame)); },
            [&](std::uint32_t corner) { append(corner_region(features, corner, band, frame)); });
      }
    });
    bin_by_slab(frame);
  }

  /// Calls face, edge or corner with the feature's index and its number here.
  template <class Face, class Edge, class Corner>
  void visit_slab(std::size_t slab, const Face& face, const Edge& edge, const Corner& corner) const {
    for (std::size_t k = begins_[slab]; k < begins_[slab + 1]; ++k) {
      const std::size_t i = items_[k];
      visit_feature(
          i, [&](std::uint32_t f) { face(f, i); }, [&](std::uint32_t e) { edge(e, i); },
          [&](std::uint32_t c) { corner(c, i); });
    }
  }

  template <class Row>
  void visit_rows(std::size_t i, IndexRange layers, std::vector<std::int32_t>& scratch, const Row& row) const {
    chunks_[i / kChunk].visit(i % kChunk, layers, scratch, row);
  }

 private:
  static constexpr std::size_t kChunk = 2048;

  template <class Face, class Edge, class Corner>
  void visit_feature(std::size_t i, const Face& face, const Edge& edge, const Corner& corner) const {
    if (i < faces_)
      face(static_cast<std::uint32_t>(i));
    else if (i < faces_ + edges_)
      edge(static_cast<std::uint32_t>(i - faces_));
    else
      corner(static_cast<std::uint32_t>(i - faces_ - edges_));
  }

  void bin_by_slab(const GridFrame& frame) {
    const auto for_all = [&](const auto& body) {
      std::uint32_t i = 0;
      for (const RowClips& chunk : chunks_)
        for (std::size_t k = 0; k < chunk.size(); ++k, ++i)
          for (int z = chunk.layers(k).begin; z < chunk.layers(k).end;
               z = (z / BlockGrid::kSlab + 1) * BlockGrid::kSlab)
            body(static_cast<std::size_t>(z / BlockGrid::kSlab), i);
    };
    begins_.resize(static_cast<std::size_t>((frame.size[2] - 1) / BlockGrid::kSlab) + 2);
    for_all([&](std::size_t slab, std::uint32_t) { ++begins_[slab]; });
    std::exclusive_scan(begins_.begin(), begins_.end(), begins_.begin(), std::size_t{0});
    items_.resize(begins_.back());
    std::vector<std::size_t> next(begins_.begin(), begins_.end() - 1);
    for_all([&](std::size_t slab, std::uint32_t i) { items_[next[slab]++] = i; });
  }

  std::size_t faces_, edges_;
  std::vector<RowClips> chunks_;
  std::vector<std::size_t> begins_;   ///< Of each slab in `items_`, and the end.
  std::vector<std::uint32_t> items_;  ///< The features that reach into each slab.
};

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
  IndexRange layers() const { return layers_; }

  template <class Square>
  void lower(int y, int z, IndexRange xs, const Square& square) {
    const std::size_t row = static_cast<std::size_t>((z - layers_.begin) * ny_ + y) * blocks_per_row_;
    const auto first = static_cast<std::size_t>(xs.begin) / kBlock,
               last = static_cast<std::size_t>(xs.end - 1) / kBlock;
    for (std::size_t b = first; b <= last; ++b) touched_[row + b] = 1;
    float* values = values_.data() + row * kBlock;
    for (int x = xs.begin; x < xs.end; ++x) {
      const float s = square(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z));
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

}  // namespace

BlockGrid scan_convert(const SoupFeatures& features, const GridFrame& frame, float band_voxels, StageWatch& watch) {
  BlockGrid grid = make_block_grid(frame);
  const FeatureClips clips(features, band_voxels, frame, watch);
  SlabPool pool;
  parallel_for(static_cast<std::int64_t>(grid.slabs.size()), 1, watch, [&](std::int64_t index, std::int64_t) {
    const auto i = static_cast<std::size_t>(index);
    const int first = static_cast<int>(i) * BlockGrid::kSlab;
    SlabSquares slab = pool.take();
    slab.cover({first, first + slab_layers(frame, i)}, frame.size[1], grid.blocks_per_row);
    std::vector<std::int32_t> rows;
    const auto lower = [&](std::size_t clip, const auto& square) {
      clips.visit_rows(clip, slab.layers(), rows, [&](int y, int z, int begin, int end) {
        slab.lower(y, z, {begin, end}, square);
      });
    };
    clips.visit_slab(
        i,
        [&](std::uint32_t face, std::size_t clip) {
          const kernel::FacePlan& plan = features.faces[face];
          lower(clip, [&](float x, float y, float z) { return kernel::face_square(plan, x, y, z); });
        },
        [&](std::uint32_t edge, std::size_t clip) {
          const SoupFeatures::Edge& e = features.edges[edge];
          const kernel::EdgePlan plan = kernel::plan_edge(features.corners[e.from], features.corners[e.to]);
          lower(clip, [&](float x, float y, float z) { return kernel::edge_square(plan, x, y, z); });
        },
        [&](std::uint32_t corner, std::size_t clip) {
          const Vec3 at = features.corners[corner];
          lower(clip, [&](float x, float y, float z) { return kernel::corner_square(at, x, y, z); });
        });
    slab.store(grid.slabs[i], band_voxels * band_voxels, static_cast<float>(frame.voxel_size));
    pool.give(std::move(slab));
  });
  return grid;
}

}  // namespace tetsoup
