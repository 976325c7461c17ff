// OFF and its variants (COFF, NOFF, STOFF ...): three coordinates a vertex, then whatever the variant adds to the line.
#include <algorithm>

#include "io/text_scanner.h"

namespace tetsoup::readers {
namespace {

struct Keyword {
  std::size_t length = 0;         // characters; 0: it is none
  bool higher_dimension = false;  // 4OFF, nOFF
};

/// [ST][C][N][4][n]OFF, which the number of vertices may follow without a blank.
Keyword classify(std::string_view word) {
  const std::size_t word_length = word.size();
  const auto take = [&](std::string_view prefix) {
    const bool there = word.starts_with(prefix);
    if (there) word.remove_prefix(prefix.size());
    return there;
  };
  take("ST");
  take("C");
  take("N");
  const bool four = take("4"), n = take("n");
  if (!take("OFF") || !std::all_of(word.begin(), word.end(), [](char c) { return c >= '0' && c <= '9'; })) return {};
  return {word_length - word.size(), four || n};
}

void read_keyword(TextScanner& text) {
  TextScanner ahead = text;
  const Keyword keyword = classify(ahead.word());
  if (keyword.length == 0) return;  // the keyword is optional; counts that are none will fail
  if (keyword.higher_dimension) text.fail("OFF files of other than 3 dimensions are not supported");
  text.skip_characters(keyword.length);
  text.skip_blanks();
  if (text.rest().starts_with("BINARY")) text.fail("binary OFF is not supported: export as text");
}

std::size_t read_count(TextScanner& text, const std::string& items) {
  text.skip_space_and_comments();
  const std::int64_t count = text.integer();
  if (count < 0) text.fail("the number of " + items + " is negative");
  return static_cast<std::size_t>(count);
}

template <class Sink>
void read_vertices(TextScanner& text, std::size_t count, Sink& sink) {
  const auto coordinate = [&] {
    text.skip_space_and_comments();
    return text.number();
  };
  sink.reserve_vertices(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double x = coordinate(), y = coordinate(), z = coordinate();
    sink.add_vertex({x, y, z});
    text.skip_line();
  }
}

template <class Sink>
void read_faces(TextScanner& text, std::size_t count, Sink& sink) {
  sink.reserve_faces(count);
  for (std::size_t i = 0; i < count; ++i) {
    text.skip_space_and_comments();
    const std::int64_t corner_count = text.integer();
    if (corner_count < 0) text.fail("the number of corners is negative");
    typename Sink::Polygon polygon(sink);
    for (std::int64_t c = 0; c < corner_count; ++c) {
      text.skip_space_and_comments();
      polygon.add(vertex_index(text.integer()));
    }
    polygon.finish();
    text.skip_line();
  }
}

}  // namespace

bool is_off(std::span<const std::byte> bytes) {
  constexpr std::size_t kProbe = 4096;  // bytes of leading comments and spaces to look behind
  TextScanner text({bytes.first(std::min(kProbe, bytes.size())), ""});
  text.skip_space_and_comments();
  return classify(text.word()).length > 0;
}

template <class Sink>
void read_off(const Source& source, Sink& sink) {
  constexpr std::size_t kVertexBytes = 6, kFaceBytes = 2;  // of the shortest lines, "0 0 0" and "0"
  TextScanner text(source);
  text.skip_space_and_comments();
  read_keyword(text);
  const std::size_t vertex_count = read_count(text, "vertices");
  const std::size_t face_count = read_count(text, "faces");
  text.skip_line();  // the number of edges, often wrong or missing
  if (vertex_count > (text.bytes_left() + 1) / kVertexBytes || face_count > (text.bytes_left() + 1) / kFaceBytes) {
    text.fail("the header promises " + std::to_string(vertex_count) + " vertices and " + std::to_string(face_count) +
              " faces, more than the file has room for");
  }
  read_vertices(text, vertex_count, sink);
  read_faces(text, face_count, sink);
}

template void read_off(const Source&, SoupSink&);
template void read_off(const Source&, MeshSink&);

}  // namespace tetsoup::readers
