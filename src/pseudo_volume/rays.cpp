#include "pseudo_volume/rays.h"

#include <algorithm>

#include "base/bits.h"

namespace tetsoup {
namespace {

/// A straight sequence of rows (y, z), (y + dy, z + dz), ...: a sheet of voxels that holds whole rays. Sheets of one
/// kind share no row, so they can be cast at the same time. A sheet may begin and end beyond the grid, where nothing
/// happens.
struct Sheet {
  std::size_t kind;  ///< Of kernel::kSheetSteps.
  int y, z;

  std::array<int, 2> row(int i) const {
    const auto [dy, dz] = kernel::kSheetSteps[kind];
    return {y + i * dy, z + i * dz};
  }
};

/// How many sheets of a kind there are, and of how many rows.
struct SheetCount {
  int sheets, rows;
};
SheetCount count_sheets(std::size_t kind, const GridFrame& frame) {
  const auto [dy, dz] = kernel::kSheetSteps[kind];
  const int ny = frame.size[1], nz = frame.size[2];
  if (dz == 0) return {nz, ny};
  return {dy == 0 ? ny : ny + nz - 1, nz};
}

Sheet nth_sheet(std::size_t kind, int n, const GridFrame& frame) {
  const auto [dy, dz] = kernel::kSheetSteps[kind];
  if (dz == 0) return {kind, 0, n};
  return {kind, dy > 0 ? n - (frame.size[2] - 1) : n, 0};
}

/// What 64 rays that go the same way remember from voxel to voxel.
struct Rays {
  std::uint64_t parity = 0;   ///< Inside.
  std::uint64_t fired = 0;    ///< The run of band voxels they are in has had its event.
  std::uint64_t stretch = 0;  ///< The event was raised in the stretch of unsound voxels they are in.
};

enum class Way { Forward, Back };

/// Rays enter a word of voxels where the soup's own crossings count, but for the unsound voxels near its rims: there a
/// run has its one event, unless it was crossed already.
/// @param crossed  Exact crossings between these voxels and those one step ahead on the axis, if not both are unsound.
template <Way way>
std::uint64_t enter_exact(Rays& rays, std::uint64_t band, std::uint64_t unsound, std::uint64_t ahead,
                          std::uint64_t lowest, std::uint64_t crossed) {
  const std::uint64_t in = way == Way::Back ? crossed & ~rays.stretch : 0;
  const std::uint64_t open = band & unsound & ~rays.fired & ~in;
  const std::uint64_t now = open & ahead, after = open & lowest & ~ahead;
  rays.stretch = (rays.stretch | now | after) & unsound & band;
  const std::uint64_t out = way == Way::Forward ? crossed & ~rays.stretch : 0;
  rays.fired = (rays.fired & band) | now | after | in | out;
  const std::uint64_t inside = rays.parity ^ in ^ now;
  rays.parity = inside ^ after ^ out;
  return inside;
}

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

  void reset() {
    std::fill(words_.begin(), words_.end(), ThreeWays{});
    active_ = {};
  }

  /// Moves all rays into the next row and lets them meet it. Rays that enter through the side of the grid have zero
  /// bits: outside.
  /// @param reach  The words of the row that hold all of its band.
  /// @param meet   meet(w, rays): what the rays do in word w; called where there is band, or a ray inside.
  template <class Meet>
  void enter_row(const std::uint64_t* band, WordRange reach, std::uint64_t last_mask, const Meet& meet) {
    const auto words = static_cast<std::uint32_t>(words_.size() - 1);
    if (!active_.empty()) {
      reach.include(active_.begin > 0 ? active_.begin - 1 : 0);
      reach.include(std::min(active_.end, words - 1));
    }
    active_ = {};
    Rays from_below;  // the top bits of the word before, as it was
    for (std::uint32_t w = reach.begin; w < reach.end; ++w) {
      ThreeWays rays = words_[w];
      const Rays above = words_[w + 1][0], up = rays[2];
      rays[0] = {rays[0].parity >> 1 | above.parity << 63, rays[0].fired >> 1 | above.fired << 63,
                 rays[0].stretch >> 1 | above.stretch << 63};
      rays[2] = {up.parity << 1 | from_below.parity, up.fired << 1 | from_below.fired,
                 up.stretch << 1 | from_below.stretch};
      from_below = {up.parity >> 63, up.fired >> 63, up.stretch >> 63};
      if (w + 1 == words) rays[2].parity &= last_mask;
      if (band[w] == 0)
        for (Rays& way : rays) way.fired = way.stretch = 0;
      if ((band[w] | rays[0].parity | rays[1].parity | rays[2].parity) != 0) {
        meet(w, rays);
        active_.include(w);
      }
      words_[w] = rays;
    }
  }

 private:
  std::vector<ThreeWays> words_;
  WordRange active_;  ///< Beyond, all is zero.
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

/// The same, voxel by voxel, where exact crossings count; along a row the three axes of a sheet are one.
class ExactRowRay {
 public:
  template <Way way>
  std::uint64_t enter(std::uint64_t band, std::uint64_t unsound, std::uint64_t ahead, std::uint64_t lowest,
                      std::uint64_t crossed) {
    if ((band | crossed) == 0) {
      rays_.fired = rays_.stretch = 0;
      return 0 - rays_.parity;
    }
    std::uint64_t inside = 0;
    for (int i = 0; i < 64; ++i) {
      const int x = way == Way::Forward ? i : 63 - i;
      const auto bit = [x](std::uint64_t word) { return word >> x & 1U; };
      inside |= enter_exact<way>(rays_, bit(band), bit(unsound), bit(ahead), bit(lowest), bit(crossed)) << x;
    }
    return inside;
  }

 private:
  Rays rays_;  ///< One ray: the lowest bits.
};

/// Whose rays are cast side by side: their rows are half a page, and what is known of them stays in a core's cache.
constexpr std::int64_t kSheetsAtOnce = 4;

class RayCaster {
 public:
  RayCaster(const BandBits& band, const EventStore& events, const ExactCrossings* exact, int rays, VoteGrid& votes)
      : band_(exact == nullptr ? band.bits : exact->near.bits),
        ranges_(exact == nullptr ? band.ranges : exact->near.ranges),
        events_band_(band.bits),
        exact_(exact),
        events_(events),
        votes_(votes),
        words_(band.bits.words_per_row),
        last_mask_(row_mask(band.bits.frame.size[0], words_ - 1)),
        both_ways_(rays == 26) {}

  /// Casts sheets begin to end - 1 of a kind side by side, so that rows which lie side by side in memory are read
  /// together.
  void cast_sheets(std::size_t kind, std::int64_t begin, std::int64_t end) const {
    const int rows = count_sheets(kind, band_.frame).rows;
    std::vector<SheetRays> sheets;
    for (auto n = static_cast<int>(begin); n < static_cast<int>(end); ++n)
      sheets.push_back({nth_sheet(kind, n, band_.frame), RayFront(words_)});
    for (int i = 0; i < rows; ++i)
      for (SheetRays& rays : sheets) enter_row<Way::Forward>(rays, i);
    if (!both_ways_) return;
    for (SheetRays& rays : sheets) rays.front.reset();
    for (int i = rows; i-- > 0;)
      for (SheetRays& rays : sheets) enter_row<Way::Back>(rays, i);
  }

  /// The rays along x of the rows of layers begin to end - 1.
  void cast_along_x(std::int64_t begin, std::int64_t end) const {
    for (auto z = static_cast<int>(begin); z < static_cast<int>(end); ++z)
      for (int y = 0; y < band_.frame.size[1]; ++y) cast_along_row(y, z);
  }

 private:
  struct SheetRays {
    Sheet sheet;
    RayFront front;
  };

  /// Row `i` of the sheet.
  template <Way way>
  void enter_row(SheetRays& rays, int i) const {
    const auto [y, z] = rays.sheet.row(i);
    if (!band_.frame.contains(0, y, z)) return;
    const std::size_t row = band_.row(y, z);
    const std::uint64_t* band = band_.words.data() + row;
    const auto events = events_.sheet_row(rays.sheet.kind, y, z);
    VoteWord* votes = votes_.words.data() + row;
    rays.front.enter_row(band, ranges_[row / words_], last_mask_, [&](std::size_t w, ThreeWays& three) {
      if (band[w] == 0) {
        add_votes(votes[w], three[0].parity, three[1].parity, three[2].parity);
        return;
      }
      const kernel::SheetEvents& axes = events[w];
      const auto meet = [&](std::size_t k) {
        // Rays that go back by dx a row are those of the axis that goes forward by -dx, met from its other end.
        const std::size_t of_sheet = way == Way::Forward ? k : 2 - k;
        const kernel::AxisEvents& axis = axes[of_sheet];
        const std::uint64_t ahead = way == Way::Forward ? axis.ahead : axis.behind;
        if (exact_ == nullptr) return enter(three[k], band[w], ahead, axis.lowest);
        return enter_exact<way>(three[k], events_band_.words[row + w], exact_->unsound.words[row + w], ahead,
                                axis.lowest, exact_->planes[3 * rays.sheet.kind + of_sheet].words[row + w]);
      };
      add_votes(votes[w], meet(0), meet(1), meet(2));
    });
  }

  void cast_along_row(int y, int z) const {
    const std::size_t row = band_.row(y, z);
    const std::uint64_t* band = band_.words.data() + row;
    const WordRange reach = ranges_[row / words_];
    if (reach.empty()) return;
    const auto events = events_.row_along_x(y, z);
    const auto vote = [&](std::size_t w, std::uint64_t inside) {
      if (inside != 0) add_votes(votes_.words[row + w], inside & row_mask(band_.frame.size[0], w), 0, 0);
    };
    if (exact_ != nullptr) {
      cast_exactly_along_row(row, reach, events, vote);
      return;
    }
    RowRay forward;
    for (std::size_t w = reach.begin; w < words_; ++w) {
      const kernel::AxisEvents& axis = events[w];
      vote(w, forward.enter(band[w], axis.ahead, axis.lowest));
    }
    // A ray against x is a ray along x in the mirrored row, where the bits above the row's end come first.
    RowRay back;
    for (std::size_t w = reach.end; both_ways_ && w-- > 0;) {
      const kernel::AxisEvents& axis = events[w];
      vote(w, reversed(back.enter(reversed(band[w]), reversed(axis.behind), reversed(axis.lowest))));
    }
  }

  template <class Events, class Vote>
  void cast_exactly_along_row(std::size_t row, const WordRange& reach, const Events& events, const Vote& vote) const {
    const auto meet = [&]<Way way>(ExactRowRay& ray, std::size_t w) {
      const kernel::AxisEvents& axis = events[w];
      vote(w, ray.enter<way>(events_band_.words[row + w], exact_->unsound.words[row + w],
                             way == Way::Forward ? axis.ahead : axis.behind, axis.lowest,
                             exact_->planes.back().words[row + w]));
    };
    ExactRowRay forward, back;
    for (std::size_t w = reach.begin; w < words_; ++w) meet.template operator()<Way::Forward>(forward, w);
    for (std::size_t w = reach.end; both_ways_ && w-- > 0;) meet.template operator()<Way::Back>(back, w);
  }

  const BitGrid& band_;                   ///< Where anything may happen to a ray,
  const std::vector<WordRange>& ranges_;  ///< and in which words of a row.
  const BitGrid& events_band_;            ///< Where volume events may be.
  const ExactCrossings* exact_;           ///< Null: volume events alone.
  const EventStore& events_;
  VoteGrid& votes_;
  std::size_t words_;
  std::uint64_t last_mask_;
  bool both_ways_;
};

}  // namespace

void cast_rays(const BandBits& band, const EventStore& events, const ExactCrossings* exact, int rays, VoteGrid& votes,
               StageWatch& watch, double begin, double end) {
  const RayCaster caster(band, events, exact, rays, votes);
  const GridFrame& frame = band.bits.frame;
  for (std::size_t kind = 0; kind < kernel::kSheetKinds; ++kind) {
    const double share = (end - begin) / kernel::kSheetKinds, from = begin + share * static_cast<double>(kind);
    watch.enter_part(from, from + share);
    // Sheets in a layer are rows that follow each other anyway.
    const bool in_layer = kernel::kSheetSteps[kind][1] == 0;
    parallel_for(count_sheets(kind, frame).sheets, in_layer ? 1 : kSheetsAtOnce, watch,
                 [&](std::int64_t first, std::int64_t last) {
                   caster.cast_sheets(kind, first, last);
                   if (in_layer) caster.cast_along_x(first, last);
                 });
  }
}

}  // namespace tetsoup
