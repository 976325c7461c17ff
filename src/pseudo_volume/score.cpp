#include "pseudo_volume/score.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/bits.h"
#include "base/elementary.h"
#include "kernel/voxels_below.h"
#include "pseudo_volume/unpadded.h"

namespace tetsoup {
namespace {

constexpr double kTouchedVoxels = 0.6;     ///< Voxels that the soup passes through, nearly.
constexpr double kSurfaceExponent = 1.75;  ///< In the middle of the range, 1.6 to 2, over which little changes.
constexpr double kSealedVoxels = 0.9;      ///< More than the 0.87 that half a diagonal step may pass by.

constexpr std::int64_t kRowsAtOnce = 256;  ///< Some ten microseconds of work a row at 1024 voxels.

std::int64_t row_count(const GridFrame& frame) {
  return static_cast<std::int64_t>(frame.size[1]) * frame.size[2];
}

/// Calls body(y, z, row) for rows begin to end - 1 of a grid in their order.
template <class Body>
void for_rows(const GridFrame& frame, std::int64_t begin, std::int64_t end, const Body& body) {
  for (std::int64_t row = begin; row < end; ++row)
    body(static_cast<int>(row % frame.size[1]), static_cast<int>(row / frame.size[1]), static_cast<std::size_t>(row));
}

/// How many of what.
struct Share {
  std::uint64_t some = 0, all = 0;
  void operator+=(const Share& other) { some += other.some, all += other.all; }
  void count(std::uint64_t bits, std::uint64_t of_these) {
    all += bit_count(bits);
    some += bit_count(bits & of_these);
  }
};

struct VoteSums {
  std::uint64_t voxels_in = 0, votes_in = 0, votes = 0;
  void operator+=(const VoteSums& other) {
    voxels_in += other.voxels_in, votes_in += other.votes_in, votes += other.votes;
  }
};

/// Share of the touched voxels that are among the bits `of_these(y, z, word)`; 1 if there are none.
template <class Bits>
double share_of_touched(const BitGrid& touched, StageWatch& watch, const Bits& of_these) {
  const auto share =
      parallel_sum<Share>(row_count(touched.frame), kRowsAtOnce, watch, [&](std::int64_t begin, std::int64_t end) {
        Share sum;
        for_rows(touched.frame, begin, end, [&](int y, int z, std::size_t row) {
          const std::uint64_t* touch = touched.words.data() + row * touched.words_per_row;
          for (std::size_t w = 0; w < touched.words_per_row; ++w)
            if (touch[w] != 0) sum.count(touch[w], of_these(y, z, w));
        });
        return sum;
      });
  return share.all == 0 ? 1 : static_cast<double>(share.some) / static_cast<double>(share.all);
}

}  // namespace

double covered_share(const BitGrid& inside, const BitGrid& touched, StageWatch& watch) {
  const BitRows rows(inside);
  return share_of_touched(touched, watch, [&](int y, int z, std::size_t w) { return rows.grown(y, z, w); });
}

double surface_share(const BitGrid& inside, const BitGrid& touched, StageWatch& watch) {
  const BitRows rows(inside);
  return share_of_touched(touched, watch, [&](int y, int z, std::size_t w) { return rows.mixed(y, z, w); });
}

double voxels_per_face(const BitGrid& inside, StageWatch& watch) {
  const BitRows in(inside);
  const std::size_t words = inside.words_per_row;
  const auto sums =
      parallel_sum<Share>(row_count(inside.frame), kRowsAtOnce, watch, [&](std::int64_t begin, std::int64_t end) {
        Share sum;
        for_rows(inside.frame, begin, end, [&](int y, int z, std::size_t) {
          const std::uint64_t* here = in.at(y, z);
          // There are no faces at the grid's end: there every voxel has itself beside it.
          const std::uint64_t* above = z + 1 < inside.frame.size[2] ? in.at(y, z + 1) : here;
          const std::uint64_t* beside = y + 1 < inside.frame.size[1] ? in.at(y + 1, z) : here;
          for (std::size_t w = 0; w < words; ++w) {
            const std::uint64_t across_x = here[w] ^ shifted_down(here, w, words);
            const std::uint64_t across_y = here[w] ^ beside[w], across_z = here[w] ^ above[w];
            if ((here[w] | across_x | across_y | across_z) == 0) continue;
            sum.some += bit_count(here[w]);
            sum.all += bit_count(across_x) + bit_count(across_y) + bit_count(across_z);
          }
        });
        return sum;
      });
  return sums.all == 0 ? 0 : static_cast<double>(sums.some) / static_cast<double>(sums.all);
}

SoupMarks mark_soup(const BlockGrid& distance, StageWatch& watch) {
  const GridFrame& frame = distance.frame;
  const auto length = [&](double voxels) { return static_cast<float>(voxels * frame.voxel_size); };
  const std::array<float, 2> limits{length(kSealedVoxels), length(kTouchedVoxels)};
  std::vector<BitGrid> marks = kernel::voxels_below(distance, limits, watch);
  const Unpadded unpadded(frame);
  parallel_for(row_count(frame), kRowsAtOnce, watch, [&](std::int64_t begin, std::int64_t end) {
    for_rows(frame, begin, end, [&](int y, int z, std::size_t row) {
      for (BitGrid& bits : marks) {
        std::uint64_t* words = bits.words.data() + row * bits.words_per_row;
        for (std::size_t w = 0; w < bits.words_per_row; ++w) words[w] &= unpadded.at(w, y, z);
      }
    });
  });
  return {std::move(marks[0]), std::move(marks[1])};
}

VoteStatistics count_votes(const VoteGrid& votes, int rays, BitGrid& inside, StageWatch& watch) {
  const auto half = static_cast<unsigned>(rays) / 2;  // 13 of 26: strict; 6 of 13: 7 are more than half
  const Unpadded unpadded(votes.frame);
  const auto sums =
      parallel_sum<VoteSums>(row_count(votes.frame), kRowsAtOnce, watch, [&](std::int64_t begin, std::int64_t end) {
        VoteSums sum;
        for_rows(votes.frame, begin, end, [&](int y, int z, std::size_t row) {
          const VoteWord* words = votes.words.data() + row * votes.words_per_row;
          std::uint64_t* in = inside.words.data() + row * votes.words_per_row;
          const bool counts = unpadded.has_row(y, z);
          for (std::size_t w = 0; w < votes.words_per_row; ++w) {
            const bool any = any_vote(words[w]) != 0;
            in[w] = any ? votes_above(words[w], half) : 0;
            if (!any || !counts) continue;
            const std::uint64_t in_box = in[w] & unpadded[w];
            sum.votes += sum_votes(words[w], unpadded[w]);
            if (in_box == 0) continue;
            sum.voxels_in += bit_count(in_box);
            sum.votes_in += sum_votes(words[w], in_box);
          }
        });
        return sum;
      });
  const double n_in = static_cast<double>(sums.voxels_in),
               n_out = static_cast<double>(unpadded.voxel_count() - sums.voxels_in);
  const double agree_in = 2.0 * static_cast<double>(sums.votes_in) / rays - n_in;
  const double agree_out = n_out - 2.0 * static_cast<double>(sums.votes - sums.votes_in) / rays;
  VoteStatistics s;
  s.inside = sums.voxels_in;
  s.consensus_inside = n_in > 0 ? agree_in / n_in : 0;
  s.consensus_outside = n_out > 0 ? agree_out / n_out : 0;
  s.consensus = n_in + n_out > 0 ? (agree_in + agree_out) / (n_in + n_out) : 0;
  return s;
}

double score_solid(double surface, const BitGrid& solid, const VoteStatistics& s, StageWatch& watch) {
  if (s.inside == 0) return 0;
  return elementary::exp(kSurfaceExponent * elementary::log(surface)) * voxels_per_face(solid, watch) *
         std::sqrt(std::max(0.0, s.consensus_outside));
}

}  // namespace tetsoup
