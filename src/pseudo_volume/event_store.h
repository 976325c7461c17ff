// Where the volume events of all rays may lie, found once for all bands that are tried.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/parallel.h"
#include "kernel/event_masks.h"
#include "tetsoup/types.h"

namespace tetsoup {

/// The events of every word of voxels that holds one nearer to the soup than a reach: 312 bytes for such a word, and 4
/// for any word. In other words every voxel may have an event whichever way a ray goes; with a reach of zero that is so
/// in all.
class EventStore {
 public:
  EventStore(const BlockGrid& distance, float reach, StageWatch& watch);

  float reach() const { return reach_; }

  /// Events in one row of voxels, by word.
  template <class Events>
  class Row {
   public:
    Row(const std::uint32_t* places, const Events* events) : places_(places), events_(events) {}
    const Events& operator[](std::size_t word) const { return events_[places_[word]]; }

   private:
    const std::uint32_t* places_;
    const Events* events_;
  };
  Row<kernel::SheetEvents> sheet_row(std::size_t kind, int y, int z) const {
    return {places(y, z), slab(z).sheets[kind].data()};
  }
  Row<kernel::AxisEvents> row_along_x(int y, int z) const { return {places(y, z), slab(z).along_x.data()}; }

 private:
  /// Layers that are stored together, as those of the distance.
  struct Slab {
    std::vector<std::uint32_t> places;  ///< (layers, ny, words_per_row): the word's place in what follows.
    std::array<std::vector<kernel::SheetEvents>, kernel::kSheetKinds> sheets;
    std::vector<kernel::AxisEvents> along_x;
  };
  const Slab& slab(int z) const { return slabs_[static_cast<std::size_t>(z / BlockGrid::kSlab)]; }
  const std::uint32_t* places(int y, int z) const {
    return slab(z).places.data() +
           (static_cast<std::size_t>(z % BlockGrid::kSlab) * rows_per_layer_ + static_cast<std::size_t>(y)) *
               words_per_row_;
  }
  void fill(const BlockGrid& distance, std::size_t index);

  float reach_;
  std::size_t rows_per_layer_, words_per_row_;
  std::vector<Slab> slabs_;
};

}  // namespace tetsoup
