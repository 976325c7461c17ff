// Sorting by 32-bit keys without comparing.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace tetsoup {

/// Sorts by the member `key`, ascending; equal keys keep their order. `scratch` must be as long. O(entries).
template <class Entry>
void radix_sort(std::span<Entry> entries, std::span<Entry> scratch) {
  constexpr std::size_t kBits = 11, kDigits = std::size_t{1} << kBits, kPasses = 3;
  std::array<std::array<std::uint32_t, kDigits>, kPasses> place{};
  const auto digit = [](const Entry& e, std::size_t pass) { return e.key >> (kBits * pass) & (kDigits - 1); };
  for (const Entry& e : entries)
    for (std::size_t pass = 0; pass < kPasses; ++pass) ++place[pass][digit(e, pass)];

  std::span<Entry> from = entries, to = scratch;
  for (std::size_t pass = 0; pass < kPasses; ++pass) {
    auto& next = place[pass];
    if (entries.empty() || next[digit(entries[0], pass)] == entries.size()) continue;  // one digit for all
    std::uint32_t sum = 0;
    for (std::uint32_t& n : next) {
      const std::uint32_t count = n;
      n = sum;
      sum += count;
    }
    for (const Entry& e : from) to[next[digit(e, pass)]++] = e;
    std::swap(from, to);
  }
  if (from.data() != entries.data()) std::copy(from.begin(), from.end(), entries.begin());
}

}  // namespace tetsoup
