// libFuzzer: the first byte chooses the format, the rest is the file. Anything but a soup or IoError is a finding.
#include <cstdint>
#include <span>

#include "tetsoup/error.h"
#include "tetsoup/io.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr unsigned kFormats = 5;
  if (size == 0) return 0;
  const auto format = static_cast<tetsoup::SoupFormat>(data[0] % kFormats);
  try {
    tetsoup::parse_soup(std::as_bytes(std::span(data + 1, size - 1)), format, "fuzz");
  } catch (const tetsoup::IoError&) {
  }
  return 0;
}
