#include "pseudo_volume/cavities.h"

#include <bit>
#include <vector>

namespace tetsoup {
namespace {

/// Seeds spread through the runs of free voxels of one row, both ways along x. Returns whether anything was added.
bool spread_along_row(std::uint64_t* reached, const std::uint64_t* free, std::size_t words) {
  bool changed = false;
  const auto smear = [&](std::size_t w, std::uint64_t carry_in, bool up) {
    std::uint64_t seeds = (reached[w] | carry_in) & free[w], open = free[w];
    for (int step = 1; step < 64; step *= 2) {
      seeds |= open & (up ? seeds << step : seeds >> step);
      open &= up ? open << step : open >> step;
    }
    changed |= seeds != reached[w];
    reached[w] = seeds;
  };
  for (std::size_t w = 0; w < words; ++w) smear(w, w > 0 ? reached[w - 1] >> 63 : 0, true);
  for (std::size_t w = words; w-- > 0;) smear(w, w + 1 < words ? reached[w + 1] << 63 : 0, false);
  return changed;
}

/// Free voxels connected, through faces, to a free voxel of the grid's border.
BitGrid flood_from_border(const BitGrid& free, StageWatch& watch) {
  BitGrid reached = make_bit_grid(free.frame);
  const int nx = free.frame.size[0], ny = free.frame.size[1], nz = free.frame.size[2];
  const std::size_t words = free.words_per_row;
  std::vector<std::uint32_t> pending;
  std::vector<char> queued(static_cast<std::size_t>(ny) * static_cast<std::size_t>(nz), 1);
  for (int z = 0; z < nz; ++z) {
    for (int y = 0; y < ny; ++y) {
      const std::size_t row = free.row(y, z);
      const bool border = y == 0 || z == 0 || y == ny - 1 || z == nz - 1;
      for (std::size_t w = 0; border && w < words; ++w) reached.words[row + w] = free.words[row + w];
      reached.words[row] |= free.words[row] & 1U;
      const auto last = static_cast<std::size_t>(nx - 1);
      reached.words[row + last / 64] |= free.words[row + last / 64] & std::uint64_t{1} << (last % 64);
      pending.push_back(static_cast<std::uint32_t>(row / words));
    }
  }
  const auto pass_on = [&](std::size_t from, int y, int z) {
    if (y < 0 || z < 0 || y >= ny || z >= nz) return;
    const std::size_t to = free.row(y, z);
    std::uint64_t added = 0;
    for (std::size_t w = 0; w < words; ++w) {
      const std::uint64_t more = reached.words[from + w] & free.words[to + w] & ~reached.words[to + w];
      reached.words[to + w] |= more;
      added |= more;
    }
    if (added == 0 || queued[to / words]) return;
    queued[to / words] = 1;
    pending.push_back(static_cast<std::uint32_t>(to / words));
  };
  for (std::size_t steps = 0; !pending.empty(); ++steps) {
    const std::uint32_t index = pending.back();
    pending.pop_back();
    queued[index] = 0;
    const std::size_t row = index * words;
    spread_along_row(reached.words.data() + row, free.words.data() + row, words);
    const int y = static_cast<int>(index) % ny, z = static_cast<int>(index) / ny;
    pass_on(row, y - 1, z);
    pass_on(row, y + 1, z);
    pass_on(row, y, z - 1);
    pass_on(row, y, z + 1);
    if (steps % 4096 == 0) watch.step(0);
  }
  return reached;
}

/// Bits of a row's word that have a set voxel among their 27 neighbours.
std::uint64_t grown(const BitGrid& bits, int y, int z, std::size_t w) {
  std::uint64_t out = 0;
  for (int dz = -1; dz <= 1; ++dz) {
    for (int dy = -1; dy <= 1; ++dy) {
      if (y + dy < 0 || z + dz < 0 || y + dy >= bits.frame.size[1] || z + dz >= bits.frame.size[2]) continue;
      const std::uint64_t* row = bits.words.data() + bits.row(y + dy, z + dz);
      out |= row[w] | shifted_up(row, w) | shifted_down(row, w, bits.words_per_row);
    }
  }
  return out;
}

}  // namespace

std::size_t fill_cavities(BitGrid& inside, const BitGrid& near_soup, StageWatch& watch) {
  const auto [nx, ny, nz] = inside.frame.size;
  const std::size_t words = inside.words_per_row;
  BitGrid free = make_bit_grid(inside.frame);
  for (std::size_t i = 0; i < free.words.size(); ++i)
    free.words[i] = ~inside.words[i] & ~near_soup.words[i] & row_mask(nx, i % words);
  const BitGrid reached = flood_from_border(free, watch);

  BitGrid cavity = make_bit_grid(inside.frame);
  std::size_t added = 0;
  for (std::size_t i = 0; i < free.words.size(); ++i) {
    cavity.words[i] = free.words[i] & ~reached.words[i];
    added += static_cast<std::size_t>(std::popcount(cavity.words[i]));
  }
  if (added == 0) return 0;
  for (int z = 0; z < nz; ++z) {
    for (int y = 0; y < ny; ++y) {
      const std::size_t row = inside.row(y, z);
      for (std::size_t w = 0; w < words; ++w) {
        const std::uint64_t around = grown(cavity, y, z, w);
        if (around == 0) continue;
        const std::uint64_t crust =
            around & ~grown(reached, y, z, w) & near_soup.words[row + w] & ~inside.words[row + w];
        added += static_cast<std::size_t>(std::popcount(crust));
        inside.words[row + w] |= cavity.words[row + w] | crust;
      }
    }
  }
  return added;
}

}  // namespace tetsoup
