#include "pseudo_volume/rays.h"

#include <algorithm>

#include "base/bits.h"

namespace tetsoup {
namespace {

/// A straight sequence of rows (y, z), (y + dy, z + dz), ...: a sheet of the grid that holds whole rays. Sheets of one
/// kind share no row, so they can be cast at the same time.
struct Sheet {
  std::size_t kind;  ///< Of kernel::kSheetSteps.
  int y, z, count;
};

/// Sheet `i` of those whose rows move by dy from layer to layer: the part inside the grid.
Sheet sheet_along_z(std::size_t kind, int i, int ny, int nz) {
  const int dy = kernel::kSheetSteps[kind][0];
  if (dy == 0) return {kind, i, 0, nz};
  const int start = dy > 0 ? i - (nz - 1) : i;  // y at z = 0, outside the grid for sheets that enter from the side
  const int first = dy > 0 ? std::max(0, -start) : std::max(0, start - (ny - 1));
  const int last = dy > 0 ? std::min(nz - 1, ny - 1 - start) : std::min(nz - 1, start);
  return {kind, start + dy * first, first, last - first + 1};
}

/// What 64 rays that go the same way remember from voxel to voxel.
struct Rays {
  std::uint64_t parity = 0;  ///< Inside.
  std::uint64_t fired = 0;   ///< The run of band voxels they are in has had its event.
};

/// Rays enter a word of voxels: bits of those that call it inside.
/// @param ahead, lowest  As in kernel::AxisEvents, in the direction of the rays.
std::uint64_t enter(Rays& rays, std::uint64_t band, std::uint64_t ahead, std::uint64_t lowest) {
  const std::uint64_t open = band & ~rays.fired;  // runs that still wait for their event
  const std::uint64_t now = open & ahead;         // the successor is not closer, and no closer than the predecessor
  const std::uint64_t after = open & lowest & ~ahead;  // it is: the crossing lies beyond the voxel
  rays.fired = (rays.fired & band) | now | after;
  const std::uint64_t inside = rays.parity ^ now;
  rays.parity = inside ^ after;
  return inside;
}

/// The rays of one word that move by dx = -1, 0 and 1 along x a row, after they moved into a new row.
using ThreeWays = std::array<Rays, 3>;

/// The rays of one sheet that go one way, by word.
class RayFront {
 public:
  explicit RayFront(std::size_t words) : words_(words + 1) {}  // one that stays empty follows the last

  void reset() { std::fill(words_.begin(), words_.end(), ThreeWays{}); }

  /// Moves all rays into the next row and lets them meet it. Rays that enter through the side of the grid have zero
  /// bits: outside.
  /// @param meet  meet(w, rays): what the rays do in word w; called where there is band, or a ray inside.
  template <class Meet>
  void enter_row(const std::uint64_t* band, std::uint64_t last_mask, const Meet& meet) {
    const std::size_t words = words_.size() - 1;
    Rays from_below;  // the top bits of the word before, as it was
    for (std::size_t w = 0; w < words; ++w) {
      ThreeWays& rays = words_[w];
      const Rays& above = words_[w + 1][0];
      rays[0] = {rays[0].parity >> 1 | above.parity << 63, rays[0].fired >> 1 | above.fired << 63};
      const Rays up = rays[2];
      rays[2] = {up.parity << 1 | from_below.parity, up.fired << 1 | from_below.fired};
      from_below = {up.parity >> 63, up.fired >> 63};
      if (w + 1 == words) rays[2].parity &= last_mask;
      if (band[w] == 0) {
        rays[0].fired = rays[1].fired = rays[2].fired = 0;
        if ((rays[0].parity | rays[1].parity | rays[2].parity) == 0) continue;
      }
      meet(w, rays);
    }
  }

 private:
  std::vector<ThreeWays> words_;
};

/// The inside bits of one ray along a row of bits. The first candidate of each run is where a carry that enters at the
/// run's start, and ripples through the voxels that are no candidates, comes to rest.
class RowRay {
 public:
  /// Takes the row's words in the order of the ray, and gives each word's inside bits.
  std::uint64_t enter(std::uint64_t band, std::uint64_t ahead, std::uint64_t lowest) {
    const std::uint64_t starts = band & ~(band << 1 | band_before_ >> 63);
    const std::uint64_t candidates = ahead | lowest;
    const std::uint64_t waiting = band & ~candidates;
    const std::uint64_t partial = waiting + starts;
    const std::uint64_t sum = partial + carry_;
    carry_ = static_cast<std::uint64_t>(partial < waiting) | static_cast<std::uint64_t>(sum < partial);
    const std::uint64_t fire = sum & candidates & band;
    const std::uint64_t after = fire & ~ahead;
    const std::uint64_t inside = prefix_parity((fire & ahead) ^ (after << 1 | late_flip_)) ^ (0 - parity_);
    late_flip_ = after >> 63;
    parity_ = inside >> 63;
    band_before_ = band;
    return inside;
  }

 private:
  std::uint64_t band_before_ = 0, carry_ = 0, late_flip_ = 0, parity_ = 0;
};

enum class Way { Forward, Back };

class RayCaster {
 public:
  RayCaster(const BitGrid& band, const EventStore& events, int rays, VoteGrid& votes)
      : band_(band),
        events_(events),
        votes_(votes),
        words_(band.words_per_row),
        last_mask_(row_mask(band.frame.size[0], words_ - 1)),
        both_ways_(rays == 26) {}

  /// Sheets begin to end - 1 of a kind along z.
  void cast_sheets(std::size_t kind, std::int64_t begin, std::int64_t end) const {
    const auto [nx, ny, nz] = band_.frame.size;
    Scratch scratch(words_, nz);
    for (auto i = static_cast<int>(begin); i < static_cast<int>(end); ++i)
      cast_sheet(sheet_along_z(kind, i, ny, nz), scratch);
  }

  /// All rays that stay in layers begin to end - 1.
  void cast_layers(std::int64_t begin, std::int64_t end) const {
    const int ny = band_.frame.size[1];
    Scratch scratch(words_, ny);
    for (auto z = static_cast<int>(begin); z < static_cast<int>(end); ++z) {
      cast_sheet({kernel::kSheetKinds - 1, 0, z, ny}, scratch);
      for (int y = 0; y < ny; ++y) cast_along_x(y, z, scratch.tally.data());
    }
  }

 private:
  /// Of a sheet whose rays are on their way.
  struct Scratch {
    Scratch(std::size_t words, int rows) : front(words), tally(words * static_cast<std::size_t>(rows)) {}
    RayFront front;
    std::vector<Tally> tally;  ///< (row of the sheet, word): votes that are not in the grid yet.
  };

  void cast_sheet(const Sheet& sheet, Scratch& scratch) const {
    const auto step = kernel::kSheetSteps[sheet.kind];
    const auto row_at = [&](int i, Tally*& tally) {
      tally = scratch.tally.data() + words_ * static_cast<std::size_t>(i);
      return std::array<int, 2>{sheet.y + i * step[0], sheet.z + i * step[1]};
    };
    Tally* tally = nullptr;
    scratch.front.reset();
    for (int i = 0; i < sheet.count; ++i) {
      const auto [y, z] = row_at(i, tally);
      enter_row<Way::Forward>(sheet.kind, y, z, scratch.front, tally);
    }
    scratch.front.reset();
    for (int i = sheet.count; i-- > 0;) {
      const auto [y, z] = row_at(i, tally);
      if (both_ways_) enter_row<Way::Back>(sheet.kind, y, z, scratch.front, tally);
      vote(y, z, tally);
    }
  }

  template <Way way>
  void enter_row(std::size_t kind, int y, int z, RayFront& front, Tally* tally) const {
    const std::uint64_t* band = band_.words.data() + band_.row(y, z);
    const auto events = events_.sheet_row(kind, y, z);
    front.enter_row(band, last_mask_, [&](std::size_t w, ThreeWays& rays) {
      if (band[w] == 0) {
        tally[w] = tally[w] + tally_of(rays[0].parity, rays[1].parity, rays[2].parity);
        return;
      }
      const kernel::SheetEvents& axes = events[w];
      const auto meet = [&](std::size_t i) {
        // Rays that go back by dx a row are those of the axis that goes forward by -dx, met from its other end.
        const kernel::AxisEvents& axis = axes[way == Way::Forward ? i : 2 - i];
        return enter(rays[i], band[w], way == Way::Forward ? axis.ahead : axis.behind, axis.lowest);
      };
      tally[w] = tally[w] + tally_of(meet(0), meet(1), meet(2));
    });
  }

  void cast_along_x(int y, int z, Tally* tally) const {
    const std::uint64_t* band = band_.words.data() + band_.row(y, z);
    if (std::all_of(band, band + words_, [](std::uint64_t v) { return v == 0; })) return;
    const auto events = events_.row_along_x(y, z);
    RowRay forward;
    for (std::size_t w = 0; w < words_; ++w) {
      const kernel::AxisEvents& axis = events[w];
      tally[w].ones = forward.enter(band[w], axis.ahead, axis.lowest) & row_mask(band_.frame.size[0], w);
    }
    // A ray against x is a ray along x in the mirrored row, where the bits above the row's end come first.
    RowRay back;
    for (std::size_t w = words_; both_ways_ && w-- > 0;) {
      const kernel::AxisEvents& axis = events[w];
      const std::uint64_t inside =
          reversed(back.enter(reversed(band[w]), reversed(axis.behind), reversed(axis.lowest)));
      tally[w] = tally[w] + Tally{inside & row_mask(band_.frame.size[0], w)};
    }
    vote(y, z, tally);
  }

  /// Moves what the rays say of a row into the grid.
  void vote(int y, int z, Tally* tally) const {
    VoteWord* votes = votes_.words.data() + band_.row(y, z);
    for (std::size_t w = 0; w < words_; ++w) {
      if ((tally[w].ones | tally[w].twos | tally[w].fours) == 0) continue;
      add(votes[w], tally[w]);
      tally[w] = {};
    }
  }

  const BitGrid& band_;
  const EventStore& events_;
  VoteGrid& votes_;
  std::size_t words_;
  std::uint64_t last_mask_;
  bool both_ways_;
};

}  // namespace

void cast_rays(const BitGrid& band, const EventStore& events, int rays, VoteGrid& votes, StageWatch& watch,
               double begin, double end) {
  const RayCaster caster(band, events, rays, votes);
  const int ny = band.frame.size[1], nz = band.frame.size[2];
  const auto enter_part = [&](std::size_t i) {
    const double share = (end - begin) / kernel::kSheetKinds, from = begin + share * static_cast<double>(i);
    watch.enter_part(from, from + share);
  };
  for (std::size_t kind = 0; kind + 1 < kernel::kSheetKinds; ++kind) {
    enter_part(kind);
    parallel_for(kernel::kSheetSteps[kind][0] == 0 ? ny : ny + nz - 1, 2, watch,
                 [&](std::int64_t first, std::int64_t last) { caster.cast_sheets(kind, first, last); });
  }
  enter_part(kernel::kSheetKinds - 1);
  parallel_for(nz, 2, watch, [&](std::int64_t first, std::int64_t last) { caster.cast_layers(first, last); });
}

}  // namespace tetsoup
