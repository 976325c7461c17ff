// Numbers as the bytes of binary files hold them.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>

namespace tetsoup {

static_assert(std::endian::native == std::endian::little, "binary files are written as this machine stores numbers");

enum class ByteOrder { Little, Big };

/// The number whose bytes begin `bytes`, which must hold them all.
template <class Number>
Number load_raw(std::string_view bytes, ByteOrder order = ByteOrder::Little) {
  std::array<char, sizeof(Number)> raw;
  std::copy_n(bytes.data(), raw.size(), raw.begin());
  if (order == ByteOrder::Big) std::reverse(raw.begin(), raw.end());
  Number number;
  std::memcpy(&number, raw.data(), sizeof number);
  return number;
}

/// Nearest float; infinite beyond its range, where a plain conversion is undefined.
inline float narrow(double value) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  if (std::abs(value) > static_cast<double>(std::numeric_limits<float>::max()))
    return value < 0 ? -kInfinity : kInfinity;
  return static_cast<float>(value);
}

template <class Number>
void append_raw(std::string& bytes, Number value) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  bytes.append(raw, sizeof value);
}

}  // namespace tetsoup
