// The votes of all rays, bit-sliced: 64 voxels' counters in five words.
#pragma once

#include <array>
#include <cstdint>

#include "base/bits.h"
#include "tetsoup/types.h"

namespace tetsoup {

inline constexpr std::size_t kVoteBits = 5;  ///< 26 rays at most.

/// Counters of the 64 voxels of one word; slice i holds bit i of every counter.
struct VoteWord {
  std::array<std::uint64_t, kVoteBits> slice{};

  void add(std::uint64_t inside) {
    for (std::size_t i = 0; inside != 0 && i < kVoteBits; ++i) {
      const std::uint64_t carry = slice[i] & inside;
      slice[i] ^= inside;
      inside = carry;
    }
  }
  /// Voxels whose counter is above `limit`.
  std::uint64_t above(unsigned limit) const {
    std::uint64_t greater = 0, equal = ~std::uint64_t{0};
    for (std::size_t i = kVoteBits; i-- > 0;) {
      const std::uint64_t limit_bit = (limit >> i & 1U) ? ~std::uint64_t{0} : 0;
      greater |= equal & slice[i] & ~limit_bit;
      equal &= ~(slice[i] ^ limit_bit);
    }
    return greater;
  }
  /// Sum of the counters of the voxels in `mask`.
  std::uint64_t sum(std::uint64_t mask) const {
    std::uint64_t total = 0;
    for (std::size_t i = 0; i < kVoteBits; ++i)
      total += static_cast<std::uint64_t>(std::popcount(slice[i] & mask)) << i;
    return total;
  }
  std::uint8_t at(unsigned bit) const {
    unsigned count = 0;
    for (std::size_t i = 0; i < kVoteBits; ++i) count |= static_cast<unsigned>(slice[i] >> bit & 1U) << i;
    return static_cast<std::uint8_t>(count);
  }
};

}  // namespace tetsoup
