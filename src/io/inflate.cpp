#include "io/inflate.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace tetsoup {
namespace {

constexpr unsigned kLongestCode = 15;  // bits
constexpr std::size_t kLiteralCodes = 288, kDistanceCodes = 30;

/// Bits from the least significant of each byte on. Behind the end they are zeros, and `overrun()` says so.
class BitReader {
 public:
  explicit BitReader(std::string_view bytes) : bytes_(bytes) {}

  std::uint32_t peek(unsigned count) {
    while (held_ < count) {
      const std::uint64_t next = at_ < bytes_.size() ? static_cast<unsigned char>(bytes_[at_]) : 0U;
      ++at_;
      bits_ |= next << held_;
      held_ += 8;
    }
    return static_cast<std::uint32_t>(bits_ & ((std::uint64_t{1} << count) - 1));
  }
  void drop(unsigned count) {
    bits_ >>= count;
    held_ -= count;
  }
  std::uint32_t take(unsigned count) {
    const std::uint32_t value = peek(count);
    drop(count);
    return value;
  }
  /// More was taken than there is.
  bool overrun() const { return at_ > bytes_.size() + held_ / 8; }

  /// So many whole bytes from the next whole byte on; nothing if there are fewer.
  std::optional<std::string_view> whole_bytes(std::size_t count) {
    if (overrun()) return {};
    const std::size_t begin = at_ - held_ / 8;
    bits_ = held_ = 0;
    at_ = begin;
    if (count > bytes_.size() - begin) return {};
    at_ += count;
    return bytes_.substr(begin, count);
  }

 private:
  std::string_view bytes_;
  std::size_t at_ = 0;
  std::uint64_t bits_ = 0;
  unsigned held_ = 0;
};

/// A canonical Huffman code as a table of all words of its longest length: symbol and length of what each begins with.
class HuffmanCode {
 public:
  /// @param lengths  Of each symbol's code in bits, 0: it has none. False if they are more than fit.
  bool build(std::span<const std::uint8_t> lengths) {
    std::array<std::uint32_t, kLongestCode + 2> first{};
    for (const std::uint8_t length : lengths) ++first[length + 1U];
    first[1] = 0;
    std::uint32_t code = 0;
    for (unsigned length = 1; length <= kLongestCode; ++length) {
      const std::uint32_t count = first[length + 1];
      first[length] = code;
      code += count;
      if (code > 1U << length) return false;
      code <<= 1;
    }
    std::fill(table_.begin(), table_.end(), std::uint16_t{0});
    for (std::size_t symbol = 0; symbol < lengths.size(); ++symbol) {
      const unsigned length = lengths[symbol];
      if (length == 0) continue;
      std::uint32_t reversed = 0;
      const std::uint32_t own = first[length]++;
      for (unsigned bit = 0; bit < length; ++bit) reversed |= (own >> bit & 1U) << (length - 1 - bit);
      for (std::uint32_t word = reversed; word < table_.size(); word += 1U << length)
        table_[word] = static_cast<std::uint16_t>(symbol << kLengthBits | length);
    }
    return true;
  }

  /// Nothing if no symbol has the code that follows.
  std::optional<unsigned> next(BitReader& in) const {
    const std::uint16_t entry = table_[in.peek(kLongestCode)];
    constexpr unsigned kLengthMask = (1U << kLengthBits) - 1;
    if (entry == 0) return {};
    in.drop(entry & kLengthMask);
    return entry >> kLengthBits;
  }

 private:
  static constexpr unsigned kLengthBits = 4;  // of an entry, the lowest; the symbol is above them
  std::vector<std::uint16_t> table_ = std::vector<std::uint16_t>(std::size_t{1} << kLongestCode);
};

struct Codes {
  HuffmanCode literals, distances;
};

Codes make_fixed_codes() {
  Codes codes;
  std::array<std::uint8_t, kLiteralCodes> lengths;
  for (std::size_t i = 0; i < lengths.size(); ++i) lengths[i] = i < 144 ? 8 : i < 256 ? 9 : i < 280 ? 7 : 8;
  std::array<std::uint8_t, kDistanceCodes> five;
  five.fill(5);
  codes.literals.build(lengths);
  codes.distances.build(five);
  return codes;
}

/// A file may have a block of them every ten bits: made once.
const Codes& fixed_codes() {
  static const Codes codes = make_fixed_codes();
  return codes;
}

/// The lengths of both codes are packed themselves, with words for repetition.
bool read_lengths(BitReader& in, const HuffmanCode& code, std::span<std::uint8_t> lengths) {
  for (std::size_t i = 0; i < lengths.size();) {
    const auto symbol = code.next(in);
    if (!symbol || in.overrun()) return false;
    if (*symbol < 16) {
      lengths[i++] = static_cast<std::uint8_t>(*symbol);
      continue;
    }
    if (*symbol == 16 && i == 0) return false;
    const std::uint8_t repeated = *symbol == 16 ? lengths[i - 1] : std::uint8_t{0};
    const std::size_t count = *symbol == 16 ? 3 + in.take(2) : *symbol == 17 ? 3 + in.take(3) : 11 + in.take(7);
    if (count > lengths.size() - i) return false;
    std::fill_n(lengths.begin() + static_cast<std::ptrdiff_t>(i), count, repeated);
    i += count;
  }
  return true;
}

bool read_own_codes(BitReader& in, Codes& codes) {
  constexpr std::array<std::uint8_t, 19> kOrder = {16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15};
  const std::size_t literals = 257 + in.take(5), distances = 1 + in.take(5), words = 4 + in.take(4);
  if (literals > 286 || distances > kDistanceCodes) return false;
  std::array<std::uint8_t, 19> word_lengths{};
  for (std::size_t i = 0; i < words; ++i) word_lengths[kOrder[i]] = static_cast<std::uint8_t>(in.take(3));
  HuffmanCode words_code;
  std::array<std::uint8_t, kLiteralCodes + kDistanceCodes> lengths{};
  const std::span<std::uint8_t> used = std::span(lengths).first(literals + distances);
  return words_code.build(word_lengths) && read_lengths(in, words_code, used) &&
         codes.literals.build(used.first(literals)) && codes.distances.build(used.subspan(literals));
}

bool copy_stored(BitReader& in, std::string& out, std::size_t most) {
  const auto header = in.whole_bytes(4);
  if (!header) return false;
  const auto byte = [&](std::size_t i) { return static_cast<unsigned>(static_cast<unsigned char>((*header)[i])); };
  const unsigned count = byte(0) | byte(1) << 8;
  if (((byte(2) | byte(3) << 8) ^ count) != 0xffff || count > most - out.size()) return false;
  const auto content = in.whole_bytes(count);
  if (content) out += *content;
  return content.has_value();
}

/// Copies what was written `distance` bytes ago, which may overlap what is being written.
bool repeat(BitReader& in, const Codes& codes, unsigned symbol, std::string& out, std::size_t most) {
  constexpr std::array<std::uint16_t, 29> kLengths = {3,  4,  5,  6,  7,  8,  9,  10, 11,  13,  15,  17,  19,  23, 27,
                                                      31, 35, 43, 51, 59, 67, 83, 99, 115, 131, 163, 195, 227, 258};
  constexpr std::array<std::uint8_t, 29> kExtraBits = {0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2,
                                                       2, 3, 3, 3, 3, 4, 4, 4, 4, 5, 5, 5, 5, 0};
  constexpr std::array<std::uint16_t, 30> kDistances = {1,    2,    3,    4,    5,    7,    9,    13,    17,    25,
                                                        33,   49,   65,   97,   129,  193,  257,  385,   513,   769,
                                                        1025, 1537, 2049, 3073, 4097, 6145, 8193, 12289, 16385, 24577};
  if (symbol - 257 >= kLengths.size()) return false;
  const std::size_t length = kLengths[symbol - 257] + std::size_t{in.take(kExtraBits[symbol - 257])};
  const auto far = codes.distances.next(in);
  if (!far || *far >= kDistances.size()) return false;
  const std::size_t distance = kDistances[*far] + std::size_t{in.take(*far < 4 ? 0 : *far / 2 - 1)};
  if (distance > out.size() || length > most - out.size()) return false;
  for (std::size_t i = 0; i < length; ++i) out.push_back(out[out.size() - distance]);
  return true;
}

bool inflate_block(BitReader& in, const Codes& codes, std::string& out, std::size_t most) {
  constexpr unsigned kEnd = 256;
  while (!in.overrun()) {
    const auto symbol = codes.literals.next(in);
    if (!symbol) return false;
    if (*symbol == kEnd) return true;
    if (*symbol < kEnd) {
      if (out.size() == most) return false;
      out.push_back(static_cast<char>(*symbol));
    } else if (!repeat(in, codes, *symbol, out, most)) {
      return false;
    }
  }
  return false;
}

}  // namespace

std::optional<std::string> inflate(std::string_view packed, std::size_t most) {
  BitReader in(packed);
  std::string out;
  Codes codes;
  for (bool last = false; !last;) {
    last = in.take(1) != 0;
    const std::uint32_t kind = in.take(2);
    const bool ok = kind == 0   ? copy_stored(in, out, most)
                    : kind == 1 ? inflate_block(in, fixed_codes(), out, most)
                    : kind == 2 ? read_own_codes(in, codes) && inflate_block(in, codes, out, most)
                                : false;
    if (!ok || in.overrun()) return {};
  }
  return out;
}

}  // namespace tetsoup
