#include "pseudo_volume/cavities.h"

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/bits.h"
#include "pseudo_volume/unpadded.h"

namespace tetsoup {
namespace {

constexpr std::int64_t kRowsAtOnce = 256;

/// Fills the runs of free voxels of one row that hold a seed, both ways along x.
void spread_along_row(std::uint64_t* reached, const std::uint64_t* free, std::size_t words) {
  const auto smear = [&](std::size_t w, std::uint64_t carry_in, bool up) {
    std::uint64_t seeds = (reached[w] | carry_in) & free[w], open = free[w];
    if (seeds != 0 && seeds != open) {
      for (int step = 1; step < 64; step *= 2) {
        seeds |= open & (up ? seeds << step : seeds >> step);
        open &= up ? open << step : open >> step;
      }
    }
    reached[w] = seeds;
  };
  for (std::size_t w = 0; w < words; ++w) smear(w, w > 0 ? reached[w - 1] >> 63 : 0, true);
  for (std::size_t w = words; w-- > 0;) smear(w, w + 1 < words ? reached[w + 1] << 63 : 0, false);
}

/// Finds the free voxels connected, through faces, to a free voxel of the grid's border.
class Flood {
 public:
  explicit Flood(const BitGrid& free)
      : free_(free),
        reached_(make_bit_grid(free.frame)),
        words_(free.words_per_row),
        rows_y_(static_cast<std::size_t>(free.frame.size[1])),
        rows_(rows_y_ * static_cast<std::size_t>(free.frame.size[2])) {}

  BitGrid run(StageWatch& watch) {
    seed_border();
    // Up and down the whole grid once reaches nearly all; what is left lies round corners. On the way down a row misses
    // only what rows below it do later.
    for (std::size_t row = 0; row < rows_; ++row) {
      visit(row);
      if (row % 4096 == 0) watch.step(0);
    }
    std::vector<std::size_t> pending;
    for (std::size_t row = rows_; row-- > 0;) {
      if (visit(row))
        for (const std::size_t other : rows_beside(row))
          if (other > row) pending.push_back(other);
      if (row % 4096 == 0) watch.step(0);
    }
    for (std::size_t steps = 0; !pending.empty(); ++steps) {
      const std::size_t row = pending.back();
      pending.pop_back();
      if (visit(row))
        for (const std::size_t other : rows_beside(row)) pending.push_back(other);
      if (steps % 4096 == 0) watch.step(0);
    }
    return std::move(reached_);
  }

 private:
  void seed_border() {
    const auto last = static_cast<std::size_t>(free_.frame.size[0] - 1);
    for (std::size_t row = 0; row < rows_; ++row) {
      std::uint64_t* reached = reached_.words.data() + row * words_;
      const std::uint64_t* free = free_.words.data() + row * words_;
      const std::size_t y = row % rows_y_, z = row / rows_y_;
      const bool border = y == 0 || z == 0 || y + 1 == rows_y_ || row + rows_y_ >= rows_;
      for (std::size_t w = 0; border && w < words_; ++w) reached[w] = free[w];
      reached[0] |= free[0] & 1U;
      reached[last / 64] |= free[last / 64] & std::uint64_t{1} << (last % 64);
      spread_along_row(reached, free, words_);
    }
  }

  /// The rows beside a row, itself in place of those beyond the grid.
  std::array<std::size_t, 4> rows_beside(std::size_t row) const {
    const std::size_t y = row % rows_y_;
    return {y > 0 ? row - 1 : row, y + 1 < rows_y_ ? row + 1 : row, row >= rows_y_ ? row - rows_y_ : row,
            row + rows_y_ < rows_ ? row + rows_y_ : row};
  }

  /// Lets the flood enter a row from those beside it. Returns whether it got any further.
  bool visit(std::size_t row) {
    std::uint64_t* reached = reached_.words.data() + row * words_;
    const std::uint64_t* free = free_.words.data() + row * words_;
    const auto beside = rows_beside(row);
    std::uint64_t entered = 0;
    for (std::size_t w = 0; w < words_; ++w) {
      const std::uint64_t dry = free[w] & ~reached[w];
      if (dry == 0) continue;
      std::uint64_t around = 0;
      for (const std::size_t other : beside) around |= reached_.words[other * words_ + w];
      reached[w] |= around & dry;
      entered |= around & dry;
    }
    if (entered != 0) spread_along_row(reached, free, words_);
    return entered != 0;
  }

  const BitGrid& free_;
  BitGrid reached_;
  std::size_t words_, rows_y_, rows_;
};

/// One word of a row: its place in the grid's words, and where that is.
struct Place {
  std::size_t i = 0, w = 0;
  int y = 0, z = 0;
};

/// Calls body(place) for all words of rows begin to end - 1.
template <class Body>
void for_words(const BitGrid& grid, std::int64_t begin, std::int64_t end, const Body& body) {
  Place at{static_cast<std::size_t>(begin) * grid.words_per_row, 0, static_cast<int>(begin % grid.frame.size[1]),
           static_cast<int>(begin / grid.frame.size[1])};
  for (std::int64_t row = begin; row < end; ++row) {
    for (at.w = 0; at.w < grid.words_per_row; ++at.w, ++at.i) body(at);
    if (++at.y == grid.frame.size[1]) at.y = 0, ++at.z;
  }
}

std::int64_t row_count(const BitGrid& grid) {
  return static_cast<std::int64_t>(grid.frame.size[1]) * grid.frame.size[2];
}

/// The outside voxels that no barrier holds.
template <class Barrier>
BitGrid free_of(const BitGrid& inside, StageWatch& watch, const Barrier& barrier) {
  BitGrid free = make_bit_grid(inside.frame);
  parallel_for(row_count(free), kRowsAtOnce, watch, [&](std::int64_t begin, std::int64_t end) {
    for_words(free, begin, end, [&](const Place& at) {
      free.words[at.i] = ~inside.words[at.i] & ~barrier(at) & row_mask(free.frame.size[0], at.w);
    });
  });
  return free;
}

/// Keeps of `free` what the flood has not reached. Returns how much, and marks the rows that hold any.
std::size_t keep_unreached(BitGrid& free, const BitGrid& reached, std::vector<char>& rows_with_any, StageWatch& watch) {
  rows_with_any.assign(static_cast<std::size_t>(row_count(free)), 0);
  return parallel_sum<std::size_t>(row_count(free), kRowsAtOnce, watch, [&](std::int64_t begin, std::int64_t end) {
    std::size_t count = 0;
    for_words(free, begin, end, [&](const Place& at) {
      free.words[at.i] &= ~reached.words[at.i];
      if (free.words[at.i] == 0) return;
      count += bit_count(free.words[at.i]);
      rows_with_any[at.i / free.words_per_row] = 1;
    });
    return count;
  });
}

/// Adds cavities to the inside, and the sealed voxels between the two. Returns how many voxels the latter are.
std::size_t add_with_crust(BitGrid& inside, const BitGrid& cavity, const std::vector<char>& has_cavity,
                           const BitGrid& reached, const BitGrid& sealed, StageWatch& watch) {
  const auto ny = static_cast<std::int64_t>(inside.frame.size[1]);
  const BitRows cavities(cavity), outside(reached);
  const auto is_beside_cavity = [&](int y, int z) {
    for (int dz = -1; dz <= 1; ++dz)
      for (int dy = -1; dy <= 1; ++dy)
        if (cavities.at(y + dy, z + dz) && has_cavity[static_cast<std::size_t>((z + dz) * ny + y + dy)]) return true;
    return false;
  };
  return parallel_sum<std::size_t>(row_count(inside), kRowsAtOnce, watch, [&](std::int64_t begin, std::int64_t end) {
    std::size_t count = 0;
    for (std::int64_t row = begin; row < end; ++row) {
      const int y = static_cast<int>(row % ny), z = static_cast<int>(row / ny);
      if (!is_beside_cavity(y, z)) continue;
      for_words(inside, row, row + 1, [&](const Place& at) {
        const std::uint64_t around = cavities.grown(y, z, at.w);
        if (around == 0) return;
        const std::uint64_t crust = around & ~outside.grown(y, z, at.w) & sealed.words[at.i] & ~inside.words[at.i];
        count += bit_count(crust);
        inside.words[at.i] |= cavity.words[at.i] | crust;
      });
    }
    return count;
  });
}

/// One step through faces: what touches `from` within `free`, but for what is `taken`.
void seep(BitGrid& from, const BitGrid& free, const BitGrid& taken, StageWatch& watch) {
  const BitGrid before = from;
  const BitRows rows(before);
  const std::size_t words = from.words_per_row;
  parallel_for(row_count(from), kRowsAtOnce, watch, [&](std::int64_t begin, std::int64_t end) {
    for_words(from, begin, end, [&](const Place& at) {
      const std::uint64_t open = free.words[at.i] & ~before.words[at.i] & ~taken.words[at.i];
      if (open == 0) return;
      const std::uint64_t* here = rows.at(at.y, at.z);
      std::uint64_t around = shifted_up(here, at.w) | shifted_down(here, at.w, words);
      for (const std::uint64_t* beside :
           {rows.at(at.y - 1, at.z), rows.at(at.y + 1, at.z), rows.at(at.y, at.z - 1), rows.at(at.y, at.z + 1)})
        if (beside != nullptr) around |= beside[at.w];
      from.words[at.i] |= open & around;
    });
  });
}

}  // namespace

std::size_t fill_cavities(BitGrid& inside, const BitGrid& sealed, StageWatch& watch) {
  BitGrid cavity = free_of(inside, watch, [&](const Place& at) { return sealed.words[at.i]; });
  const BitGrid reached = Flood(cavity).run(watch);
  std::vector<char> has_cavity;
  const std::size_t added = keep_unreached(cavity, reached, has_cavity, watch);
  return added == 0 ? 0 : added + add_with_crust(inside, cavity, has_cavity, reached, sealed, watch);
}

std::size_t fill_rooms(BitGrid& inside, const BitGrid& sealed, const BitGrid& band, double band_voxels,
                       StageWatch& watch) {
  const Unpadded unpadded(inside.frame);
  BitGrid rooms =
      free_of(inside, watch, [&](const Place& at) { return band.words[at.i] & unpadded.at(at.w, at.y, at.z); });
  BitGrid reached = Flood(rooms).run(watch);
  std::vector<char> has_room;
  if (keep_unreached(rooms, reached, has_room, watch) == 0) return 0;

  // Both take the space in the band from their sides, up to the soup: as many steps as a diagonal through it has.
  const BitGrid free = free_of(inside, watch, [&](const Place& at) { return sealed.words[at.i]; });
  const int steps = static_cast<int>(std::ceil(std::numbers::sqrt3 * band_voxels));
  for (int step = 0; step < steps; ++step) {
    seep(reached, free, rooms, watch);
    seep(rooms, free, reached, watch);
  }
  const std::size_t added = keep_unreached(rooms, reached, has_room, watch);
  return added + add_with_crust(inside, rooms, has_room, reached, sealed, watch);
}

}  // namespace tetsoup
