#include "pseudo_volume/score.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/bits.h"
#include "kernel/voxels_below.h"

namespace tetsoup {
namespace {

constexpr double kNearVoxels = 1.2;       ///< A boundary face this close to the soup is where it belongs.
constexpr double kTouchedVoxels = 0.6;    ///< Voxels that the soup passes through, nearly.
constexpr double kSealedVoxels = 0.9;     ///< More than the 0.87 that half a diagonal step may pass by.
constexpr double kNearFloor = 0.02;       ///< Keeps a boundary that is nowhere near the soup comparable.
constexpr double kInsideConsensus = 0.4;  ///< Below this the inside is speckle.

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

/// Bits of a row of words that belong to voxels of the soup's box, without the padding.
class Unpadded {
 public:
  explicit Unpadded(const GridFrame& frame) : frame_(frame), words_(words_for(frame.size[0])) {
    for (int x = frame.pad; x < frame.size[0] - frame.pad; ++x)
      words_[static_cast<std::size_t>(x / 64)] |= std::uint64_t{1} << (x % 64);
  }
  bool has_row(int y, int z) const {
    const int pad = frame_.pad;
    return y >= pad && z >= pad && y < frame_.size[1] - pad && z < frame_.size[2] - pad;
  }
  std::uint64_t operator[](std::size_t w) const { return words_[w]; }
  std::uint64_t voxel_count() const {
    std::uint64_t count = 1;
    for (const int size : frame_.size) count *= static_cast<std::uint64_t>(std::max(0, size - 2 * frame_.pad));
    return count;
  }

 private:
  GridFrame frame_;
  std::vector<std::uint64_t> words_;
};

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

/// Share of the faces between an inside and an outside voxel that have one of the two near the soup.
double near_share(const BitGrid& inside, const BitGrid& near, StageWatch& watch) {
  const BitRows in(inside), by(near);
  const std::size_t words = inside.words_per_row;
  const auto share =
      parallel_sum<Share>(row_count(inside.frame), kRowsAtOnce, watch, [&](std::int64_t begin, std::int64_t end) {
        Share sum;
        for_rows(inside.frame, begin, end, [&](int y, int z, std::size_t) {
          const std::uint64_t *i0 = in.at(y, z), *n0 = by.at(y, z);
          // There are no faces at the grid's end: there every voxel has itself beside it.
          const bool last_y = y + 1 == inside.frame.size[1], last_z = z + 1 == inside.frame.size[2];
          const std::uint64_t *iy = last_y ? i0 : in.at(y + 1, z), *ny = last_y ? n0 : by.at(y + 1, z);
          const std::uint64_t *iz = last_z ? i0 : in.at(y, z + 1), *nz = last_z ? n0 : by.at(y, z + 1);
          for (std::size_t w = 0; w < words; ++w) {
            const std::uint64_t across_x = i0[w] ^ shifted_down(i0, w, words);
            const std::uint64_t across_y = i0[w] ^ iy[w], across_z = i0[w] ^ iz[w];
            if ((across_x | across_y | across_z) == 0) continue;
            sum.count(across_x, n0[w] | shifted_down(n0, w, words));
            sum.count(across_y, n0[w] | ny[w]);
            sum.count(across_z, n0[w] | nz[w]);
          }
        });
        return sum;
      });
  return share.all == 0 ? 0 : static_cast<double>(share.some) / static_cast<double>(share.all);
}

}  // namespace

double covered_share(const BitGrid& inside, const BitGrid& touched, StageWatch& watch) {
  const BitRows rows(inside);
  const auto share =
      parallel_sum<Share>(row_count(inside.frame), kRowsAtOnce, watch, [&](std::int64_t begin, std::int64_t end) {
        Share sum;
        for_rows(inside.frame, begin, end, [&](int y, int z, std::size_t row) {
          const std::uint64_t* touch = touched.words.data() + row * touched.words_per_row;
          for (std::size_t w = 0; w < touched.words_per_row; ++w)
            if (touch[w] != 0) sum.count(touch[w], rows.grown(y, z, w));
        });
        return sum;
      });
  return share.all == 0 ? 1 : static_cast<double>(share.some) / static_cast<double>(share.all);
}

SoupMarks mark_soup(const BlockGrid& distance, StageWatch& watch) {
  const GridFrame& frame = distance.frame;
  const auto length = [&](double voxels) { return static_cast<float>(voxels * frame.voxel_size); };
  const std::array<float, 3> limits{length(kNearVoxels), length(kSealedVoxels), length(kTouchedVoxels)};
  std::vector<BitGrid> marks = kernel::voxels_below(distance, limits, watch);
  const Unpadded unpadded(frame);
  parallel_for(row_count(frame), kRowsAtOnce, watch, [&](std::int64_t begin, std::int64_t end) {
    for_rows(frame, begin, end, [&](int y, int z, std::size_t row) {
      const bool counts = unpadded.has_row(y, z);
      for (BitGrid& bits : marks) {
        std::uint64_t* words = bits.words.data() + row * bits.words_per_row;
        for (std::size_t w = 0; w < bits.words_per_row; ++w) words[w] &= counts ? unpadded[w] : 0;
      }
    });
  });
  return {std::move(marks[0]), std::move(marks[1]), std::move(marks[2])};
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

double score_votes(const BitGrid& inside, const SoupMarks& marks, const VoteStatistics& s, StageWatch& watch) {
  if (s.inside == 0) return 0;
  const double speckle = std::pow(std::min(1.0, s.consensus_inside / kInsideConsensus), 1.5);
  return std::sqrt(s.consensus_inside * s.consensus_outside) *
         std::sqrt(kNearFloor + near_share(inside, marks.near, watch)) * covered_share(inside, marks.touched, watch) *
         speckle;
}

}  // namespace tetsoup
