// Wavefront OBJ: positions and faces; every other statement is passed over.
#include "io/text_scanner.h"

namespace tetsoup::readers {
namespace {

/// Weights and vertex colours may follow the three coordinates.
void read_vertex(TextScanner& text, std::vector<Vec3>& vertices) {
  const auto coordinate = [&] {
    text.skip_blanks();
    return static_cast<float>(text.number());
  };
  const float x = coordinate(), y = coordinate(), z = coordinate();
  vertices.push_back({x, y, z});
}

/// One-based from the start, or from -1 for the latest vertex.
std::uint32_t corner_index(std::int64_t index, std::size_t vertex_count) {
  if (index > 0) return vertex_index(index - 1);
  if (index == 0) return kNoVertex;
  return vertex_index(index + static_cast<std::int64_t>(vertex_count));
}

void read_face(TextScanner& text, TriangleSoup& soup) {
  Fan fan(soup.triangles);
  for (text.skip_blanks(); !text.at_line_end() && !text.at('#'); text.skip_blanks()) {
    fan.add(corner_index(text.leading_integer(), soup.vertices.size()));
    while (text.take('/')) {
      if (!text.at('/') && !text.at_word_end()) text.leading_integer();
    }
    if (!text.at_word_end()) text.fail_expected("a corner such as 1, 1/2, 1//3 or 1/2/3");
  }
}

}  // namespace

TriangleSoup read_obj(const Source& source) {
  TextScanner text(source);
  TriangleSoup soup;
  for (; !text.at_end(); text.skip_line()) {
    text.skip_blanks();
    const std::string_view keyword = text.word();
    if (keyword == "v") {
      read_vertex(text, soup.vertices);
    } else if (keyword == "f" || keyword == "fo") {
      read_face(text, soup);
    }
  }
  if (soup.vertices.empty() && soup.triangles.empty()) text.fail("no vertex and no face up to here: not an OBJ file?");
  return soup;
}

}  // namespace tetsoup::readers
