// Checksums that a mutation has broken, made right again where they are found, so that what lies behind them is
// reached.
#pragma once

#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>

#include "io/crc32.h"

namespace tetsoup::fuzz {

/// Those in the directory of a zip file, wherever it begins in the bytes.
inline void repair_checksums(std::span<std::uint8_t> bytes) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const auto number = [&](std::size_t at, std::size_t size) {
    std::uint32_t value = 0;
    if (at + size <= bytes.size()) std::memcpy(&value, bytes.data() + at, size);
    return std::size_t{value};
  };
  const std::size_t first = text.find("PK\x03\x04");
  if (first == text.npos) return;
  constexpr std::size_t kEntryBytes = 46, kHeaderBytes = 30;
  for (std::size_t at = text.find("PK\x01\x02"); at != text.npos; at = text.find("PK\x01\x02", at + 1)) {
    if (at + kEntryBytes > bytes.size()) return;
    const std::size_t size = number(at + 20, 4), header = first + number(at + 42, 4);
    const std::size_t content = header + kHeaderBytes + number(header + 26, 2) + number(header + 28, 2);
    if (content > bytes.size() || size > bytes.size() - content) continue;
    const std::uint32_t checksum = crc32(text.substr(content, size));
    std::memcpy(bytes.data() + at + 16, &checksum, 4);
  }
}

}  // namespace tetsoup::fuzz
