// Arithmetic on the votes of 64 voxels at once.
#pragma once

#include <cstdint>

#include "base/bits.h"
#include "tetsoup/pseudo_volume.h"

namespace tetsoup {

using VoteWord = VoteGrid::Word;

/// A number below 8 for each of 64 voxels, bit-sliced.
struct Tally {
  std::uint64_t ones = 0, twos = 0, fours = 0;
};

/// How many of three rays are inside.
inline Tally tally_of(std::uint64_t a, std::uint64_t b, std::uint64_t c) {
  return {a ^ b ^ c, (a & b) | (c & (a ^ b)), 0};
}

/// Sum of two tallies below 4.
inline Tally operator+(const Tally& a, const Tally& b) {
  const std::uint64_t carry = a.ones & b.ones;
  return {a.ones ^ b.ones, a.twos ^ b.twos ^ carry, (a.twos & b.twos) | (carry & (a.twos ^ b.twos))};
}

inline void add(VoteWord& votes, const Tally& more) {
  auto& [s0, s1, s2, s3, s4] = votes.slices;
  const std::uint64_t c0 = s0 & more.ones;
  s0 ^= more.ones;
  const std::uint64_t x1 = s1 ^ more.twos, c1 = (s1 & more.twos) | (c0 & x1);
  s1 = x1 ^ c0;
  const std::uint64_t x2 = s2 ^ more.fours, c2 = (s2 & more.fours) | (c1 & x2);
  s2 = x2 ^ c1;
  const std::uint64_t c3 = s3 & c2;
  s3 ^= c2;
  s4 ^= c3;
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
