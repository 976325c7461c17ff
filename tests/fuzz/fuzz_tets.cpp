// Readers of tet meshes: the first byte chooses the format, the rest is the file; TetGen's are two, parted by 0x00
// 0xff. A mesh whose indices exist, or IoError.
#include "fuzz.h"
#include "io/tet_readers.h"
#include "tetsoup/error.h"

namespace tetsoup::fuzz {
namespace {

TetMesh parse(unsigned format, const Choices& choices) {
  const std::string_view text = text_of(choices.rest());
  const std::string name = "fuzz";
  if (format == 0) return parse_msh(text, name);
  if (format == 1) return parse_vtk(text, name);
  if (format == 2) return parse_vtu(text, name);
  if (format == 3) return parse_medit(text, name);
  if (format == 4) return parse_npz(text, name);
  const auto [nodes, tets] = choices.halves();
  return parse_tetgen(text_of(nodes), name, text_of(tets), name);
}

}  // namespace

void fuzz_one(Bytes bytes) {
  constexpr unsigned kFormats = 6;
  Choices choices(bytes);
  if (!choices.are_left()) return;
  const unsigned format = choices.below(kFormats);
  try {
    const TetMesh mesh = parse(format, choices);
    for (const Tet& tet : mesh.tets)
      for (const std::uint32_t vertex : tet) expect(vertex < mesh.vertices.size(), "corners of tets exist");
  } catch (const IoError&) {
  }
}

}  // namespace tetsoup::fuzz
