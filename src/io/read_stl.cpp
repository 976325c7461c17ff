// STL, text and binary. Which of the two cannot be told from the first word: many binary files begin with "solid".
#include "io/load_bytes.h"
#include "io/text_scanner.h"

namespace tetsoup::readers {
namespace {

constexpr std::size_t kHeaderBytes = 84;    // 80 of title, 4 of triangle count
constexpr std::size_t kTriangleBytes = 50;  // normal, three corners, 2 bytes of attributes

std::size_t promised_triangles(std::span<const std::byte> bytes) {
  return load<std::uint32_t>(bytes.data() + kHeaderBytes - 4);
}

bool has_exact_binary_size(std::span<const std::byte> bytes) {
  return bytes.size() >= kHeaderBytes && bytes.size() == kHeaderBytes + kTriangleBytes * promised_triangles(bytes);
}

bool equals_ignoring_case(std::string_view word, std::string_view lower_case) {
  if (word.size() != lower_case.size()) return false;
  for (std::size_t i = 0; i < word.size(); ++i) {
    if ((word[i] | 0x20) != lower_case[i]) return false;
  }
  return true;
}

bool begins_with_solid(std::span<const std::byte> bytes) {
  TextScanner text({bytes, ""});
  text.skip_space();
  return equals_ignoring_case(text.word(), "solid");
}

bool is_binary(std::span<const std::byte> bytes) {
  constexpr std::size_t kProbe = 512;  // bytes: title, count and nine triangles, of which text has none that is zero
  if (has_exact_binary_size(bytes) || !begins_with_solid(bytes)) return true;
  const auto probe = bytes.first(std::min(kProbe, bytes.size()));
  return std::find(probe.begin(), probe.end(), std::byte{0}) != probe.end();
}

template <class Sink>
void read_binary(const Source& source, Sink& sink) {
  const auto bytes = source.bytes;
  if (bytes.size() < kHeaderBytes) {
    fail_at_byte(
        source.name, bytes.size(),
        "the file ends within the 84 bytes that start a binary STL file, nor is it text: that begins with 'solid'");
  }
  const std::size_t count = promised_triangles(bytes), available = (bytes.size() - kHeaderBytes) / kTriangleBytes;
  if (count > available || (count == 0 && available > 0)) {
    fail_at_byte(
        source.name, kHeaderBytes - 4,
        "the header promises " + std::to_string(count) + " triangles, but the file holds " + std::to_string(available));
  }
  sink.reserve_vertices(3 * count);
  sink.reserve_faces(count);
  for (std::size_t t = 0; t < count; ++t) {
    const std::byte* at = bytes.data() + kHeaderBytes + t * kTriangleBytes + 3 * sizeof(float);
    const auto first = static_cast<std::uint32_t>(3 * t);
    for (int corner = 0; corner < 3; ++corner, at += 3 * sizeof(float)) {
      sink.add_vertex({load<float>(at), load<float>(at + 4), load<float>(at + 8)});
    }
    sink.add_triangle(first, first + 1, first + 2);
  }
}

/// Words in any line layout: solid NAME (facet normal N (outer loop vertex P vertex P vertex P endloop) endfacet)
/// endsolid NAME, again and again.
template <class Sink>
class TextReader {
 public:
  TextReader(const Source& source, Sink& sink) : text_(source), sink_(sink) {}

  void read() {
    bool in_solid = false;
    for (text_.skip_space(); !text_.at_end(); text_.skip_space()) {
      if (!in_solid) {
        expect("solid");
        read_name();
        in_solid = true;
      } else if (take("endsolid")) {
        text_.skip_line();
        in_solid = false;
      } else {
        expect("facet");
        read_facet();
      }
    }
    if (in_solid) text_.fail("the file ends before 'endsolid'");
  }

 private:
  bool take(std::string_view keyword) {
    text_.skip_space();
    TextScanner ahead = text_;
    if (!equals_ignoring_case(ahead.word(), keyword)) return false;
    text_ = ahead;
    return true;
  }
  void expect(std::string_view keyword) {
    if (!take(keyword)) text_.fail_expected(in_quotes(keyword));
  }
  Vec3d point() {
    const auto coordinate = [&] {
      text_.skip_space();
      return text_.number();
    };
    const double x = coordinate(), y = coordinate(), z = coordinate();
    return {x, y, z};
  }

  /// To the line's end.
  void read_name() {
    if constexpr (Sink::kDetails) sink_.set_object(joined_words(text_.rest_of_line()));
    text_.skip_line();
  }

  void read_facet() {
    expect("normal");
    point();
    expect("outer");
    expect("loop");
    typename Sink::Polygon polygon(sink_);
    while (take("vertex")) {
      polygon.add(vertex_index(static_cast<std::int64_t>(sink_.vertex_count())));
      sink_.add_vertex(point());
    }
    polygon.finish();
    expect("endloop");
    expect("endfacet");
  }

  TextScanner text_;
  Sink& sink_;
};

}  // namespace

bool is_stl(std::span<const std::byte> bytes) {
  return begins_with_solid(bytes) || (has_exact_binary_size(bytes) && promised_triangles(bytes) > 0);
}

template <class Sink>
void read_stl(const Source& source, Sink& sink) {
  if (is_binary(source.bytes)) {
    read_binary(source, sink);
  } else {
    TextReader<Sink>(source, sink).read();
  }
}

template void read_stl(const Source&, SoupSink&);
template void read_stl(const Source&, MeshSink&);

}  // namespace tetsoup::readers
