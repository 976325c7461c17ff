#include "pseudo_volume/event_store.h"

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

kernel::BlockNeighbours neighbours(const BlockGrid& distance, std::size_t w, int y, int z) {
  kernel::BlockNeighbours around{};
  for (int r = 0; r < 9; ++r) {
    const int ry = y + r % 3 - 1, rz = z + r / 3 - 1;
    const bool within = ry >= 0 && rz >= 0 && ry < distance.frame.size[1] && rz < distance.frame.size[2];
    const auto i = static_cast<std::size_t>(r);
    around.rows[i] = within ? distance.block(w, ry, rz) : kBeyondTheGrid.data();
    around.before[i] = within && w > 0 ? distance.block(w - 1, ry, rz)[BlockGrid::kBlock - 1] : kInfinity;
    around.after[i] = within && w + 1 < distance.blocks_per_row ? distance.block(w + 1, ry, rz)[0] : kInfinity;
  }
  return around;
}

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
  for (std::size_t i = 0; i < slab.places.size(); ++i) {
    const std::uint32_t place = slab.places[i];
    if (place == 0) continue;
    const std::size_t row = i / words_per_row_;
    const kernel::WordEvents events =
        kernel::find_events(neighbours(distance, i % words_per_row_, static_cast<int>(row % rows_per_layer_),
                                       first_layer + static_cast<int>(row / rows_per_layer_)));
    for (std::size_t kind = 0; kind < kernel::kSheetKinds; ++kind) slab.sheets[kind][place] = events.sheets[kind];
    slab.along_x[place] = events.along_x;
  }
}

}  // namespace tetsoup
