// CRC-32 as zip files have it [ISO 3309]: all that would be needed of zlib.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace tetsoup {

/// Of bytes that follow those whose checksum is `before`.
inline std::uint32_t crc32(std::string_view bytes, std::uint32_t before = 0) {
  static constexpr auto kTable = [] {
    constexpr std::uint32_t kPolynomial = 0xEDB88320;
    std::array<std::uint32_t, 256> table{};
    for (std::uint32_t i = 0; i < table.size(); ++i) {
      std::uint32_t rest = i;
      for (int bit = 0; bit < 8; ++bit) rest = (rest & 1U) != 0 ? kPolynomial ^ rest >> 1 : rest >> 1;
      table[i] = rest;
    }
    return table;
  }();
  std::uint32_t sum = ~before;
  for (const char byte : bytes) sum = kTable[(sum ^ static_cast<unsigned char>(byte)) & 0xFFU] ^ sum >> 8;
  return ~sum;
}

}  // namespace tetsoup
