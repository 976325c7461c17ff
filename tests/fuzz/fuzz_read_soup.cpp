// libFuzzer: the first byte chooses the format, the rest is the file. Anything but a soup, the same as a render mesh,
// or IoError is a finding.
#include <cstdint>
#include <cstdlib>
#include <span>

#include "tetsoup/error.h"
#include "tetsoup/io.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr unsigned kFormats = 5;
  if (size == 0) return 0;
  const auto format = static_cast<tetsoup::SoupFormat>(data[0] % kFormats);
  const auto bytes = std::as_bytes(std::span(data + 1, size - 1));
  try {
    const tetsoup::TriangleSoup soup = tetsoup::parse_soup(bytes, format, "fuzz");
    if (tetsoup::triangles_of(tetsoup::parse_render_mesh(bytes, format, "fuzz")).triangles != soup.triangles)
      std::abort();
  } catch (const tetsoup::IoError&) {
  }
  return 0;
}
