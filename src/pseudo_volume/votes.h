// Arithmetic on the votes of 64 voxels at once.
#pragma once

#include <cstdint>

#include "base/bits.h"
#include "tetsoup/pseudo_volume.h"

namespace tetsoup {

using VoteWord = VoteGrid::Word;

/// Adds the votes of three rays: for each the voxels it calls inside.
inline void add_votes(VoteWord& votes, std::uint64_t a, std::uint64_t b, std::uint64_t c) {
  const std::uint64_t ones = a ^ b ^ c, twos = (a & b) | (c & (a ^ b));
  auto& [s0, s1, s2, s3, s4] = votes.slices;
  const std::uint64_t carry0 = s0 & ones;
  s0 ^= ones;
  const std::uint64_t sum1 = s1 ^ twos, carry1 = (s1 & twos) | (carry0 & sum1);
  s1 = sum1 ^ carry0;
  const std::uint64_t carry2 = s2 & carry1;
  s2 ^= carry1;
  const std::uint64_t carry3 = s3 & carry2;
  s3 ^= carry2;
  s4 ^= carry3;
}

/// Voxels with any vote at all.
inline std::uint64_t any_vote(const VoteWord& votes) {
  const auto& s = votes.slices;
  return s[0] | s[1] | s[2] | s[3] | s[4];
}

/// Voxels with more than `limit` votes.
inline std::uint64_t votes_above(const VoteWord& votes, unsigned limit) {
  std::uint64_t greater = 0, equal = ~std::uint64_t{0};
  for (std::size_t i = votes.slices.size(); i-- > 0;) {
    const std::uint64_t limit_bit = (limit >> i & 1U) ? ~std::uint64_t{0} : 0;
    greater |= equal & votes.slices[i] & ~limit_bit;
    equal &= ~(votes.slices[i] ^ limit_bit);
  }
  return greater;
}

/// Sum of the votes of the voxels in `mask`.
inline std::uint64_t sum_votes(const VoteWord& votes, std::uint64_t mask) {
  std::uint64_t total = 0;
  for (std::size_t i = 0; i < votes.slices.size(); ++i) total += bit_count(votes.slices[i] & mask) << i;
  return total;
}

}  // namespace tetsoup
