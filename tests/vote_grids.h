// Votes for tests, voxel by voxel.
#pragma once

#include <cstdint>

#include "tetsoup/pseudo_volume.h"

namespace tetsoup::test {

/// votes_at(x, y, z) in every voxel of a grid.
template <class VotesAt>
VoteGrid make_votes(const GridFrame& frame, const VotesAt& votes_at) {
  VoteGrid votes{frame, static_cast<std::size_t>((frame.size[0] + 63) / 64), {}};
  for (int z = 0; z < frame.size[2]; ++z) {
    for (int y = 0; y < frame.size[1]; ++y) {
      votes.words.resize(votes.words.size() + votes.words_per_row);
      VoteGrid::Word* row = votes.words.data() + votes.words.size() - votes.words_per_row;
      for (int x = 0; x < frame.size[0]; ++x)
        for (int bit = 0; bit < 5; ++bit)
          row[x / 64].slices[static_cast<std::size_t>(bit)] |= static_cast<std::uint64_t>(votes_at(x, y, z) >> bit & 1)
                                                               << (x % 64);
    }
  }
  return votes;
}

}  // namespace tetsoup::test
