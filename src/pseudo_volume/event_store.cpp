#include "pseudo_volume/event_store.h"

#include <algorithm>
#include <limits>

#include "base/block_grid.h"

namespace tetsoup {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

constexpr auto kBeyondTheGrid = [] {
  std::array<float, BlockGrid::kBlock> block{};
  for (float& value : block) value = kInfinity;
  return block;
}();

constexpr kernel::AxisEvents kAlways{~std::uint64_t{0}, ~std::uint64_t{0}, ~std::uint64_t{0}};

/// The nine rows of blocks around a row.
class RowNeighbours {
 public:
  RowNeighbours(const BlockGrid& distance, int y, int z) : words_(distance.blocks_per_row) {
    for (int r = 0; r < 9; ++r) {
      const int ry = y + r % 3 - 1, rz = z + r / 3 - 1;
      if (distance.frame.contains(0, ry, rz)) rows_[static_cast<std::size_t>(r)] = block_row(distance, ry, rz);
    }
  }

  kernel::BlockNeighbours at(std::size_t w) const {
    kernel::BlockNeighbours around;
    for (std::size_t r = 0; r < 9; ++r) {
      const BlockRow& row = rows_[r];
      const bool within = row.places != nullptr;
      around.rows[r] = within ? row[w] : kBeyondTheGrid.data();
      around.before[r] = within && w > 0 ? row[w - 1][BlockGrid::kBlock - 1] : kInfinity;
      around.after[r] = within && w + 1 < words_ ? row[w + 1][0] : kInfinity;
    }
    return around;
  }

 private:
  std::array<BlockRow, 9> rows_{};
  std::size_t words_;
};

}  // namespace

EventStore::EventStore(const BlockGrid& distance, float reach, StageWatch& watch)
    : reach_(reach),
      rows_per_layer_(static_cast<std::size_t>(distance.frame.size[1])),
      words_per_row_(distance.blocks_per_row),
      slabs_(distance.slabs.size()) {
  parallel_for(static_cast<std::int64_t>(slabs_.size()), 1, watch, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i) fill(distance, static_cast<std::size_t>(i));
  });
}

void EventStore::fill(const BlockGrid& distance, std::size_t index) {
  const BlockGrid::Slab& known = distance.slabs[index];
  Slab& slab = slabs_[index];
  slab.places.resize(known.places.size());
  std::uint32_t count = 0;
  for (std::size_t i = 0; i < known.places.size(); ++i) {
    std::uint64_t within = 0;
    if (known.places[i] != 0)
      kernel::find_below(known.values.data() + std::size_t{BlockGrid::kBlock} * known.places[i], &reach_, 1, &within);
    if (within != 0) slab.places[i] = ++count;
  }
  for (auto& events : slab.sheets) {
    events.resize(count + 1);
    events.front() = {kAlways, kAlways, kAlways};
  }
  slab.along_x.resize(count + 1);
  slab.along_x.front() = kAlways;
  const int first_layer = static_cast<int>(index) * BlockGrid::kSlab;
  for (std::size_t row = 0; row * words_per_row_ < slab.places.size(); ++row) {
    const std::uint32_t* places = slab.places.data() + row * words_per_row_;
    if (std::all_of(places, places + words_per_row_, [](std::uint32_t place) { return place == 0; })) continue;
    const RowNeighbours around(distance, static_cast<int>(row % rows_per_layer_),
                               first_layer + static_cast<int>(row / rows_per_layer_));
    for (std::size_t w = 0; w < words_per_row_; ++w) {
      if (places[w] == 0) continue;
      const kernel::WordEvents events = kernel::find_events(around.at(w));
      for (std::size_t kind = 0; kind < kernel::kSheetKinds; ++kind) slab.sheets[kind][places[w]] = events.sheets[kind];
      slab.along_x[places[w]] = events.along_x;
    }
  }
}

}  // namespace tetsoup
