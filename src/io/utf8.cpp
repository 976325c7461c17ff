#include "io/utf8.h"

#include <cstddef>

namespace tetsoup {

namespace {

constexpr char32_t kUnknown = 0xFFFD;

struct Character {
  char32_t code = kUnknown;
  std::size_t bytes = 1;
};

/// The first of a text that is not empty.
Character first_character(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned lead = byte(0);
  if (lead < 0x80) return {lead, 1};
  const std::size_t bytes = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4 || text.size() < bytes) return {};
  char32_t code = lead & (0xFFU >> (bytes + 1));
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(i) & 0xC0U) != 0x80) return {};
    code = code << 6 | (byte(i) & 0x3FU);
  }
  constexpr char32_t kLeast[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xD800 && code <= 0xDFFF;
  if (code < kLeast[bytes] || code > 0x10FFFF || surrogate) return {};
  return {code, bytes};
}

}  // namespace

std::u32string decode_utf8(std::string_view text) {
  std::u32string codes;
  while (!text.empty()) {
    const Character character = first_character(text);
    codes += character.code;
    text.remove_prefix(character.bytes);
  }
  return codes;
}

std::string encode_utf8(std::u32string_view text) {
  std::string bytes;
  const auto add = [&](char32_t value) { bytes += static_cast<char>(static_cast<unsigned char>(value)); };
  for (const char32_t code : text) {
    if (code < 0x80) {
      add(code);
      continue;
    }
    const unsigned tails = code < 0x800 ? 1 : code < 0x10000 ? 2 : 3;
    constexpr char32_t kLeads[] = {0, 0xC0, 0xE0, 0xF0};
    add(kLeads[tails] | code >> (6 * tails));
    for (unsigned tail = tails; tail-- > 0;) add(0x80U | (code >> (6 * tail) & 0x3FU));
  }
  return bytes;
}

}  // namespace tetsoup
