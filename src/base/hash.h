// A hash of words in their order, the same on every machine [Fowler, Noll, Vo: FNV-1a, by words instead of bytes].
#pragma once

#include <cstdint>
#include <cstring>

namespace tetsoup {

/// The number's own bits; std::bit_cast, which libc++ 14 has not.
inline std::uint32_t bits_of(float value) {
  std::uint32_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}

class WordHash {
 public:
  void add(std::uint64_t word) { value_ = (value_ ^ word) * 0x100000001B3U; }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xCBF29CE484222325U;
};

}  // namespace tetsoup
