#include "pseudo_volume/score.h"

#include <bit>
#include <cmath>

namespace tetsoup {
namespace {

constexpr double kNearVoxels = 1.2;       ///< A boundary face this close to the soup is where it belongs.
constexpr double kTouchedVoxels = 0.6;    ///< Voxels that the soup passes through, nearly.
constexpr double kSealedVoxels = 0.9;     ///< More than the 0.87 that half a diagonal step may pass by.
constexpr double kNearFloor = 0.02;       ///< Keeps a boundary that is nowhere near the soup comparable.
constexpr double kInsideConsensus = 0.4;  ///< Below this the inside is speckle.

/// Rows of bits by (y, z); null outside the grid.
struct RowReader {
  const BitGrid& grid;
  const std::uint64_t* at(int y, int z) const {
    const bool within = y >= 0 && z >= 0 && y < grid.frame.size[1] && z < grid.frame.size[2];
    return within ? grid.words.data() + grid.row(y, z) : nullptr;
  }
};

/// Word of a row grown by one voxel both ways along x.
std::uint64_t grown_along_x(const std::uint64_t* row, std::size_t w, std::size_t words) {
  return row ? row[w] | shifted_up(row, w) | shifted_down(row, w, words) : 0;
}

/// Share of the faces between an inside and an outside voxel that have one of the two near the soup.
double near_share(const BitGrid& inside, const BitGrid& near) {
  const RowReader in{inside}, by{near};
  const std::size_t words = inside.words_per_row;
  std::size_t faces = 0, near_faces = 0;
  const auto count = [&](std::uint64_t differ, std::uint64_t close) {
    faces += static_cast<std::size_t>(std::popcount(differ));
    near_faces += static_cast<std::size_t>(std::popcount(differ & close));
  };
  for (int z = 0; z < inside.frame.size[2]; ++z) {
    for (int y = 0; y < inside.frame.size[1]; ++y) {
      const std::uint64_t *i0 = in.at(y, z), *n0 = by.at(y, z);
      const std::uint64_t *iy = in.at(y + 1, z), *ny = by.at(y + 1, z);
      const std::uint64_t *iz = in.at(y, z + 1), *nz = by.at(y, z + 1);
      for (std::size_t w = 0; w < words; ++w) {
        const std::uint64_t in_next = shifted_down(i0, w, words), near_next = shifted_down(n0, w, words);
        count(i0[w] ^ in_next, n0[w] | near_next);
        count(iy ? i0[w] ^ iy[w] : 0, iy ? n0[w] | ny[w] : 0);
        count(iz ? i0[w] ^ iz[w] : 0, iz ? n0[w] | nz[w] : 0);
      }
    }
  }
  return faces == 0 ? 0 : static_cast<double>(near_faces) / static_cast<double>(faces);
}

}  // namespace

double covered_share(const BitGrid& inside, const BitGrid& touched) {
  const RowReader rows{inside};
  const std::size_t words = inside.words_per_row;
  std::size_t all = 0, covered = 0;
  for (int z = 0; z < inside.frame.size[2]; ++z) {
    for (int y = 0; y < inside.frame.size[1]; ++y) {
      const std::uint64_t* touch = touched.words.data() + touched.row(y, z);
      for (std::size_t w = 0; w < words; ++w) {
        if (touch[w] == 0) continue;
        std::uint64_t grown = 0;
        for (int dz = -1; dz <= 1; ++dz)
          for (int dy = -1; dy <= 1; ++dy) grown |= grown_along_x(rows.at(y + dy, z + dz), w, words);
        all += static_cast<std::size_t>(std::popcount(touch[w]));
        covered += static_cast<std::size_t>(std::popcount(touch[w] & grown));
      }
    }
  }
  return all == 0 ? 1 : static_cast<double>(covered) / static_cast<double>(all);
}

BitGrid majority(const GridFrame& frame, const std::vector<VoteWord>& votes, int rays) {
  BitGrid inside = make_bit_grid(frame);
  const auto half = static_cast<unsigned>(rays) / 2;  // 13 of 26: strict; 6 of 13: 7 are more than half
  for (std::size_t w = 0; w < inside.words.size(); ++w) inside.words[w] = votes[w].above(half);
  return inside;
}

SoupMarks mark_soup(const Grid<float>& distance, StageWatch& watch) {
  const GridFrame& frame = distance.frame;
  SoupMarks marks{make_bit_grid(frame), make_bit_grid(frame), make_bit_grid(frame), make_bit_grid(frame)};
  const auto length = [&](double voxels) { return static_cast<float>(voxels * frame.voxel_size); };
  const float near = length(kNearVoxels), sealed = length(kSealedVoxels), touched = length(kTouchedVoxels);
  const int pad = frame.pad, ny = frame.size[1];
  const std::int64_t rows = static_cast<std::int64_t>(ny) * frame.size[2];
  parallel_for(rows, 64, watch, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t index = begin; index < end; ++index) {
      const int y = static_cast<int>(index % ny), z = static_cast<int>(index / ny);
      if (y < pad || z < pad || y >= ny - pad || z >= frame.size[2] - pad) continue;
      const float* values = distance.values.data() + distance.index(0, y, z);
      const std::size_t row = marks.near.row(y, z);
      for (int x = pad; x < frame.size[0] - pad; ++x) {
        const std::size_t word = row + static_cast<std::size_t>(x >> 6);
        const auto mark = [&](BitGrid& bits, bool set) {
          bits.words[word] |= static_cast<std::uint64_t>(set) << (x & 63);
        };
        mark(marks.unpadded, true);
        if (!(values[x] < near)) continue;
        mark(marks.near, true);
        mark(marks.sealed, values[x] < sealed);
        mark(marks.touched, values[x] < touched);
      }
    }
  });
  return marks;
}

VoteStatistics summarize_votes(const BitGrid& inside, const BitGrid& unpadded, const std::vector<VoteWord>& votes,
                               int rays) {
  std::uint64_t voxels_in = 0, voxels_out = 0, votes_in = 0, votes_out = 0;
  for (std::size_t w = 0; w < votes.size(); ++w) {
    const std::uint64_t in = inside.words[w] & unpadded.words[w], out = ~inside.words[w] & unpadded.words[w];
    voxels_in += static_cast<std::uint64_t>(std::popcount(in));
    voxels_out += static_cast<std::uint64_t>(std::popcount(out));
    votes_in += votes[w].sum(in);
    votes_out += votes[w].sum(out);
  }
  const double n_in = static_cast<double>(voxels_in), n_out = static_cast<double>(voxels_out);
  const double agree_in = 2.0 * static_cast<double>(votes_in) / rays - n_in;
  const double agree_out = n_out - 2.0 * static_cast<double>(votes_out) / rays;
  VoteStatistics s;
  s.inside = voxels_in;
  s.consensus_inside = n_in > 0 ? agree_in / n_in : 0;
  s.consensus_outside = n_out > 0 ? agree_out / n_out : 0;
  s.consensus = n_in + n_out > 0 ? (agree_in + agree_out) / (n_in + n_out) : 0;
  return s;
}

double score_votes(const BitGrid& inside, const SoupMarks& marks, const VoteStatistics& s) {
  if (s.inside == 0) return 0;
  const double speckle = std::pow(std::min(1.0, s.consensus_inside / kInsideConsensus), 1.5);
  return std::sqrt(s.consensus_inside * s.consensus_outside) * std::sqrt(kNearFloor + near_share(inside, marks.near)) *
         covered_share(inside, marks.touched) * speckle;
}

}  // namespace tetsoup
