// Numbers from raw bytes of either order, aligned or not.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>

namespace tetsoup::readers {

/// The caller vouches for sizeof(Number) bytes at `at`.
template <class Number>
Number load(const std::byte* at, std::endian order = std::endian::little) {
  std::array<std::byte, sizeof(Number)> raw;
  std::copy_n(at, sizeof(Number), raw.begin());
  if (order != std::endian::native) std::reverse(raw.begin(), raw.end());
  Number value;
  std::memcpy(&value, raw.data(), sizeof(Number));
  return value;
}

}  // namespace tetsoup::readers
