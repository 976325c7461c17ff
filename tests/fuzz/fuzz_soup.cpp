// Readers of triangle soups: the first byte chooses the format, the rest is the file. A soup, the same as a render
// mesh, or IoError.
#include "fuzz.h"
#include "tetsoup/error.h"
#include "tetsoup/io.h"

namespace tetsoup::fuzz {

void fuzz_one(Bytes bytes) {
  constexpr unsigned kFormats = 7;
  Choices choices(bytes);
  if (!choices.are_left()) return;
  const auto format = static_cast<SoupFormat>(choices.below(kFormats));
  const auto file = std::as_bytes(choices.rest());
  try {
    const TriangleSoup soup = parse_soup(file, format, "fuzz");
    const RenderMesh mesh = parse_render_mesh(file, format, "fuzz");
    expect(triangles_of(mesh).triangles == soup.triangles, "a render mesh has the triangles of the soup");
    part_names(mesh);
  } catch (const IoError&) {
  }
}

}  // namespace tetsoup::fuzz
