// Wavefront OBJ: positions and faces, for render meshes also texture coordinates, normals and names; every other
// statement is passed over.
#include <array>
#include <string>

#include "io/text_scanner.h"

namespace tetsoup::readers {
namespace {

constexpr std::uint32_t kNone = RenderMesh::kNone;
static_assert(kNone == kNoVertex);

/// Weights and vertex colours may follow the three coordinates.
Vec3d read_point(TextScanner& text) {
  const auto coordinate = [&] {
    text.skip_blanks();
    return text.number();
  };
  const double x = coordinate(), y = coordinate(), z = coordinate();
  return {x, y, z};
}

/// One-based from the start, or from -1 for the latest.
std::uint32_t corner_index(std::int64_t index, std::size_t count) {
  if (index > 0) return vertex_index(index - 1);
  if (index == 0) return kNoVertex;
  return vertex_index(index + static_cast<std::int64_t>(count));
}

/// Texture coordinate and normal behind a corner's vertex, as the file has them; 0 where there is none. Nobody counts
/// what follows behind further slashes.
std::array<std::int64_t, 2> read_corner_details(TextScanner& text) {
  std::array<std::int64_t, 2> indices{};
  for (std::size_t slashes = 0; text.take('/'); ++slashes) {
    if (text.at('/') || text.at_word_end()) continue;
    const std::int64_t index = text.leading_integer();
    if (slashes < indices.size()) indices[slashes] = index;
  }
  return indices;
}

template <class Sink>
void read_face(TextScanner& text, Sink& sink) {
  typename Sink::Polygon polygon(sink);
  for (text.skip_blanks(); !text.at_line_end() && !text.at('#'); text.skip_blanks()) {
    const std::uint32_t vertex = corner_index(text.leading_integer(), sink.vertex_count());
    if constexpr (Sink::kDetails) {
      const auto [texcoord, normal] = read_corner_details(text);
      polygon.add(vertex, corner_index(texcoord, sink.texcoord_count()), corner_index(normal, sink.normal_count()));
    } else {
      polygon.add(vertex);
      if (text.at('/')) read_corner_details(text);
    }
    if (!text.at_word_end()) text.fail_expected("a corner such as 1, 1/2, 1//3 or 1/2/3");
  }
  polygon.finish();
}

/// Within its line: a soup's reader passes over these lines, and must come to the same place. What is no number is 0,
/// so that the others keep theirs. A # belongs to a name, as in "Box #1".
void read_detail(std::string_view keyword, std::string_view line, MeshSink& sink) {
  std::array<float, 3> numbers{};
  if (keyword == "vt") {
    parse_numbers(line, std::span(numbers).first<2>());
    sink.add_texcoord({numbers[0], numbers[1]});
  } else if (keyword == "vn") {
    parse_numbers(line, numbers);
    sink.add_normal({numbers[0], numbers[1], numbers[2]});
  } else if (keyword == "o") {
    sink.set_object(joined_words(line));
  } else if (keyword == "g") {
    sink.set_group(joined_words(line));
  } else if (keyword == "usemtl") {
    sink.set_material(joined_words(line));
  }
}

}  // namespace

template <class Sink>
void read_obj(const Source& source, Sink& sink) {
  TextScanner text(source);
  for (; !text.at_end(); text.skip_line()) {
    text.skip_blanks();
    const std::string_view keyword = text.word();
    if (keyword == "v") {
      sink.add_vertex(read_point(text));
    } else if (keyword == "f" || keyword == "fo") {
      read_face(text, sink);
    } else if constexpr (Sink::kDetails) {
      read_detail(keyword, text.rest_of_line(), sink);
    }
  }
  if (sink.vertex_count() == 0 && sink.face_count() == 0)
    text.fail("no vertex and no face up to here: not an OBJ file?");
}

template void read_obj(const Source&, SoupSink&);
template void read_obj(const Source&, MeshSink&);

}  // namespace tetsoup::readers
