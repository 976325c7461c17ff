#include "pseudo_volume/rays.h"

#include <algorithm>

#include "pseudo_volume/row_events.h"

namespace tetsoup {
namespace {

/// A straight sequence of rows (y, z), (y + dy, z + dz), ...: a sheet of the grid that holds whole rays. Sheets of one
/// kind share no row, so they can be cast at the same time.
struct Sheet {
  int y, z, dy, dz, count;
};

class RayCaster {
 public:
  RayCaster(const Grid<float>& distance, float band, int rays, Placement placement, std::vector<VoteWord>& votes,
            StageWatch& watch)
      : distance_(distance),
        votes_(votes),
        watch_(watch),
        band_(make_bit_grid(distance.frame)),
        both_ways_(rays == 26),
        at_entry_(placement == Placement::Entry) {
    mark_band(band);
  }

  void run(double begin, double end) {
    const int ny = distance_.frame.size[1], nz = distance_.frame.size[2];
    const auto part = [&](int i) { return begin + (end - begin) * i / 5; };
    for (const int dy : {-1, 0, 1}) {
      watch_.enter_part(part(dy + 1), part(dy + 2));
      const std::int64_t sheets = dy == 0 ? ny : ny + nz - 1;
      parallel_for(sheets, 2, watch_, [&](std::int64_t first, std::int64_t last) {
        for (auto i = static_cast<int>(first); i < static_cast<int>(last); ++i)
          cast_sheet(sheet_along_z(dy, i, ny, nz));
      });
    }
    watch_.enter_part(part(3), part(4));
    parallel_for(nz, 2, watch_, [&](std::int64_t first, std::int64_t last) {
      for (auto z = static_cast<int>(first); z < static_cast<int>(last); ++z) cast_sheet({0, z, 1, 0, ny});
    });
    watch_.enter_part(part(4), part(5));
    parallel_for(nz, 2, watch_, [&](std::int64_t first, std::int64_t last) {
      for (auto z = static_cast<int>(first); z < static_cast<int>(last); ++z)
        for (int y = 0; y < ny; ++y) cast_along_x(y, z);
    });
  }

 private:
  /// Sheet `i` of those whose rows move by dy from layer to layer: the part inside the grid.
  static Sheet sheet_along_z(int dy, int i, int ny, int nz) {
    if (dy == 0) return {i, 0, 0, 1, nz};
    const int start = dy > 0 ? i - (nz - 1) : i;  // y at z = 0, outside the grid for sheets that enter from the side
    const int first = dy > 0 ? std::max(0, -start) : std::max(0, start - (ny - 1));
    const int last = dy > 0 ? std::min(nz - 1, ny - 1 - start) : std::min(nz - 1, start);
    return {start + dy * first, first, dy, 1, last - first + 1};
  }

  void mark_band(float band) {
    const GridFrame& frame = distance_.frame;
    const std::int64_t rows = static_cast<std::int64_t>(frame.size[1]) * frame.size[2];
    parallel_for(rows, 64, watch_, [&](std::int64_t begin, std::int64_t end) {
      for (auto row = static_cast<std::size_t>(begin); row < static_cast<std::size_t>(end); ++row) {
        const float* values = distance_.values.data() + row * static_cast<std::size_t>(frame.size[0]);
        std::uint64_t* words = band_.words.data() + row * band_.words_per_row;
        for (std::size_t w = 0; w < band_.words_per_row; ++w) {
          const std::size_t first = 64 * w, last = std::min(first + 64, static_cast<std::size_t>(frame.size[0]));
          std::uint64_t bits = 0;
          for (std::size_t x = first; x < last; ++x)
            bits |= static_cast<std::uint64_t>(values[x] < band) << (x - first);
          words[w] = bits;
        }
      }
    });
  }

  void cast_sheet(const Sheet& sheet) {
    for (const int dx : {-1, 0, 1}) {
      cast_direction(sheet, dx);
      if (!both_ways_) continue;
      const int last = sheet.count - 1;
      cast_direction({sheet.y + last * sheet.dy, sheet.z + last * sheet.dz, -sheet.dy, -sheet.dz, sheet.count}, -dx);
    }
  }

  RowNeighbours neighbours(const Sheet& sheet, int i, int dx) const {
    const auto row = [&](int j) -> const float* {
      if (j < 0 || j >= sheet.count) return nullptr;
      return distance_.values.data() + distance_.index(0, sheet.y + j * sheet.dy, sheet.z + j * sheet.dz);
    };
    return {row(i), row(i + 1), row(i - 1), dx, distance_.frame.size[0]};
  }

  /// All rays of the sheet that move by dx along x a row: their states travel in two rows of bits. A ray that enters
  /// through the side of the grid starts with zero bits: outside.
  void cast_direction(const Sheet& sheet, int dx) {
    const std::size_t words = band_.words_per_row;
    std::vector<std::uint64_t> parity(words), fired(words), moved_parity(words), moved_fired(words);
    for (int i = 0; i < sheet.count; ++i) {
      move(parity, moved_parity, dx);
      move(fired, moved_fired, dx);
      std::swap(parity, moved_parity);
      std::swap(fired, moved_fired);
      const RowNeighbours row = neighbours(sheet, i, dx);
      const std::size_t first = band_.row(sheet.y + i * sheet.dy, sheet.z + i * sheet.dz);
      for (std::size_t w = 0; w < words; ++w) {
        const std::uint64_t in_band = band_.words[first + w];
        const std::uint64_t open = in_band & ~fired[w];  // runs that still wait for their event
        fired[w] &= in_band;
        std::uint64_t after = 0;
        if (open != 0) {
          const EventMasks events = at_entry_ ? EventMasks{open, 0} : find_events(row, w, open);
          const std::uint64_t fire = open & events.not_closer;
          fired[w] |= fire;
          parity[w] ^= fire & ~events.beyond;
          after = fire & events.beyond;
        }
        votes_[first + w].add(parity[w] & row_mask(row.nx, w));
        parity[w] ^= after;
      }
    }
  }

  static void move(const std::vector<std::uint64_t>& from, std::vector<std::uint64_t>& to, int dx) {
    const std::size_t words = from.size();
    for (std::size_t w = 0; w < words; ++w) {
      if (dx > 0) to[w] = shifted_up(from.data(), w);
      if (dx < 0) to[w] = shifted_down(from.data(), w, words);
      if (dx == 0) to[w] = from[w];
    }
  }

  void cast_along_x(int y, int z) {
    const std::size_t words = band_.words_per_row, first = band_.row(y, z);
    const std::uint64_t* in_band = band_.words.data() + first;
    if (std::all_of(in_band, in_band + words, [](std::uint64_t v) { return v == 0; })) return;
    const int nx = distance_.frame.size[0];
    const float* values = distance_.values.data() + distance_.index(0, y, z);
    std::vector<std::uint64_t> band(words), not_closer(words), beyond(words), inside(words);
    for (const int dx : {1, -1}) {
      if (dx < 0 && !both_ways_) return;
      // A ray against x is a ray along x in the mirrored row, where the bits above nx - 1 come first.
      const auto slot = [&](std::size_t w) { return dx > 0 ? w : words - 1 - w; };
      const auto turned = [&](std::uint64_t v) { return dx > 0 ? v : reversed(v); };
      for (std::size_t w = 0; w < words; ++w) {
        const std::uint64_t bits = in_band[w];
        const EventMasks events =
            at_entry_ ? EventMasks{bits, 0} : find_events({values, values, values, dx, nx}, w, bits);
        band[slot(w)] = turned(bits);
        not_closer[slot(w)] = turned(events.not_closer);
        beyond[slot(w)] = turned(events.beyond);
      }
      parity_along_row(band, not_closer, beyond, inside);
      for (std::size_t w = 0; w < words; ++w) votes_[first + w].add(turned(inside[slot(w)]) & row_mask(nx, w));
    }
  }

  /// Inside bits of one ray along a row of bits. The first candidate of each run is where a carry that enters at the
  /// run's start, and ripples through the voxels that are no candidates, comes to rest.
  static void parity_along_row(const std::vector<std::uint64_t>& band, const std::vector<std::uint64_t>& candidates,
                               const std::vector<std::uint64_t>& beyond, std::vector<std::uint64_t>& inside) {
    std::uint64_t previous_band = 0, carry = 0, late_flip = 0, parity = 0;
    for (std::size_t w = 0; w < band.size(); ++w) {
      const std::uint64_t starts = band[w] & ~(band[w] << 1 | previous_band >> 63);
      const std::uint64_t waiting = band[w] & ~candidates[w];
      const std::uint64_t partial = waiting + starts;
      const std::uint64_t sum = partial + carry;
      carry = static_cast<std::uint64_t>(partial < waiting) | static_cast<std::uint64_t>(sum < partial);
      const std::uint64_t fire = sum & candidates[w] & band[w];
      const std::uint64_t after = fire & beyond[w];
      inside[w] = prefix_parity((fire & ~beyond[w]) ^ (after << 1 | late_flip)) ^ (0 - parity);
      late_flip = after >> 63;
      parity = inside[w] >> 63;
      previous_band = band[w];
    }
  }

  const Grid<float>& distance_;
  std::vector<VoteWord>& votes_;
  StageWatch& watch_;
  BitGrid band_;
  bool both_ways_, at_entry_;
};

}  // namespace

void cast_rays(const Grid<float>& distance, float band, int rays, Placement placement, std::vector<VoteWord>& votes,
               StageWatch& watch, double begin, double end) {
  const std::size_t words = words_for(distance.frame.size[0]) * static_cast<std::size_t>(distance.frame.size[1]) *
                            static_cast<std::size_t>(distance.frame.size[2]);
  votes.assign(words, {});
  RayCaster(distance, band, rays, placement, votes, watch).run(begin, end);
}

}  // namespace tetsoup
