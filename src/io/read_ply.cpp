// PLY, text and binary of both orders: vertices with texture coordinates and normals, faces and triangle
// strips; all other elements are passed over.
#include <algorithm>
#include <bit>
#include <utility>

#include "base/vec.h"
#include "io/load_bytes.h"
#include "io/ply_header.h"
#include "io/text_scanner.h"

namespace tetsoup::readers {
namespace {

using namespace ply;

// The two bodies have the same members: one number, a list's length, passing over numbers, room for records, the end
// of one.

class BinaryBody {
 public:
  BinaryBody(const Source& source, const Header& header)
      : source_(source),
        order_(header.encoding == Encoding::BigEndian ? std::endian::big : std::endian::little),
        at_(header.body_offset) {}

  double number(Type type) {
    const std::size_t size = size_of(type);
    if (size > bytes_left()) fail("the file ends within a record");
    const std::byte* const p = source_.bytes.data() + at_;
    at_ += size;
    switch (type) {
      case Type::Int8:
        return load<std::int8_t>(p);
      case Type::Uint8:
        return load<std::uint8_t>(p);
      case Type::Int16:
        return load<std::int16_t>(p, order_);
      case Type::Uint16:
        return load<std::uint16_t>(p, order_);
      case Type::Int32:
        return load<std::int32_t>(p, order_);
      case Type::Uint32:
        return load<std::uint32_t>(p, order_);
      case Type::Float32:
        return static_cast<double>(load<float>(p, order_));
      case Type::Float64:
        break;
    }
    return load<double>(p, order_);
  }

  void skip(Type type, std::size_t count) {
    if (count > bytes_left() / size_of(type)) fail("the file ends within a record");
    at_ += count * size_of(type);
  }

  std::size_t list_length(const Property& list) {
    const double length = number(*list.count_type);
    if (length < 0) fail("a list of negative length");
    if (length * static_cast<double>(size_of(list.type)) > static_cast<double>(bytes_left())) {
      fail("a list of " + std::to_string(static_cast<std::uint64_t>(length)) +
           " numbers reaches beyond the file's end");
    }
    return static_cast<std::size_t>(length);
  }

  void expect_room(const Element& element) {
    if (element.count <= bytes_left() / element.smallest_record()) return;
    fail("the header promises " + std::to_string(element.count) + " times " + in_quotes(element.name) +
         ", more than the file has room for");
  }

  void end_record() {}

  [[noreturn]] void fail(const std::string& what) const { fail_at_byte(source_.name, at_, what); }

 private:
  std::size_t bytes_left() const { return source_.bytes.size() - at_; }

  Source source_;
  std::endian order_;
  std::size_t at_;
};

class TextBody {
 public:
  TextBody(const Source& source, const Header& header) : text_(source, header.body_offset, header.body_line) {
    const std::uint64_t most = source.bytes.size();  // none takes less than a byte, so more will not be read
    for (const Element& element : header.elements)
      if (!element.properties.empty()) records_left_ += std::min(element.count, most);
  }

  double number(Type) {
    text_.skip_space();
    return text_.number();
  }
  void skip(Type type, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) number(type);
  }
  std::size_t list_length(const Property&) {
    text_.skip_space();
    const std::int64_t length = text_.integer();
    if (length < 0) fail("a list of negative length");
    return static_cast<std::size_t>(length);
  }
  void expect_room(const Element& element) {
    constexpr std::size_t kShortest = 2;  // bytes a number takes: one digit, one blank; the last needs no blank
    if (element.count <= (text_.bytes_left() + 1) / kShortest / element.properties.size()) return;
    fail("the header promises " + std::to_string(element.count) + " times " + in_quotes(element.name) +
         ", more than the file has room for");
  }
  /// Numbers that the header does not tell of are passed over to the line's end, where as many lines follow as records.
  void end_record() {
    if (records_left_ > 0) --records_left_;
    text_.skip_blanks();
    if (text_.at_line_end()) return;
    if (!record_a_line_) record_a_line_ = records_left_ <= text_lines_below();
    if (*record_a_line_) text_.skip_line();
  }
  [[noreturn]] void fail(const std::string& what) const { text_.fail(what); }

 private:
  /// Lines with something on them, behind this one.
  std::uint64_t text_lines_below() const {
    TextScanner ahead = text_;
    std::uint64_t lines = 0;
    for (ahead.skip_line(), ahead.skip_space(); !ahead.at_end(); ahead.skip_line(), ahead.skip_space()) ++lines;
    return lines;
  }

  std::uint64_t records_left_ = 0;     ///< Of all elements.
  std::optional<bool> record_a_line_;  ///< Known once a line does not end with its record.
  TextScanner text_;
};

template <class Body>
void skip_property(Body& body, const Property& property) {
  body.skip(property.type, property.count_type ? body.list_length(property) : 1);
}

struct VertexRecord {
  Vec3d position, normal;
  double u = 0, v = 0;

  /// Where a property's number goes; nowhere: it is passed over.
  double* place_of(const Property& property) {
    if (property.count_type) return nullptr;
    const std::pair<std::string_view, double*> places[] = {{"x", &position.x}, {"y", &position.y}, {"z", &position.z},
                                                           {"nx", &normal.x},  {"ny", &normal.y},  {"nz", &normal.z},
                                                           {"s", &u},          {"t", &v},          {"u", &u},
                                                           {"v", &v},          {"texture_u", &u},  {"texture_v", &v}};
    for (const auto& [name, place] : places)
      if (property.name == name) return place;
    return nullptr;
  }
};

/// What some vertices of the file have; the others then have zeros.
struct VertexDetails {
  bool texcoords = false, normals = false;
};

bool has_number(const Element& element, std::string_view name) {
  return std::any_of(element.properties.begin(), element.properties.end(),
                     [&](const Property& p) { return p.name == name && !p.count_type; });
}

VertexDetails details_of(const Header& header) {
  VertexDetails details;
  for (const Element& element : header.elements) {
    if (element.name != "vertex") continue;
    const auto has = [&](std::string_view name) { return has_number(element, name); };
    details.normals = details.normals || (has("nx") && has("ny") && has("nz"));
    details.texcoords =
        details.texcoords || (has("s") && has("t")) || (has("u") && has("v")) || (has("texture_u") && has("texture_v"));
  }
  return details;
}

template <class Body, class Sink>
void read_vertices(Body& body, const Element& element, [[maybe_unused]] VertexDetails details, Sink& sink) {
  VertexRecord record;
  std::vector<double*> places;
  for (const Property& property : element.properties) places.push_back(record.place_of(property));
  sink.reserve_vertices(element.count);
  for (std::uint64_t i = 0; i < element.count; ++i) {
    for (std::size_t p = 0; p < places.size(); ++p) {
      const Property& property = element.properties[p];
      if (places[p]) {
        *places[p] = body.number(property.type);
      } else {
        skip_property(body, property);
      }
    }
    sink.add_vertex(record.position);
    if constexpr (Sink::kDetails) {
      if (details.texcoords) sink.add_texcoord({static_cast<float>(record.u), static_cast<float>(record.v)});
      if (details.normals) sink.add_normal(to_float(record.normal));
    }
    body.end_record();
  }
}

bool is_corner_list(const Property& property) {
  return property.count_type && (property.name == "vertex_indices" || property.name == "vertex_index");
}

template <class Body, class Sink>
void read_faces(Body& body, const Element& element, Sink& sink) {
  sink.reserve_faces(element.count);
  for (std::uint64_t i = 0; i < element.count; ++i) {
    for (const Property& property : element.properties) {
      if (!is_corner_list(property)) {
        skip_property(body, property);
        continue;
      }
      typename Sink::Polygon polygon(sink);
      for (std::size_t left = body.list_length(property); left > 0; --left) {
        polygon.add(vertex_index(body.number(property.type)));
      }
      polygon.finish();
    }
    body.end_record();
  }
}

/// A negative index ends a strip.
template <class Body, class Sink>
void read_strips(Body& body, const Element& element, Sink& sink) {
  for (std::uint64_t i = 0; i < element.count; ++i) {
    for (const Property& property : element.properties) {
      if (!is_corner_list(property)) {
        skip_property(body, property);
        continue;
      }
      Strip<Sink> strip(sink);
      for (std::size_t left = body.list_length(property); left > 0; --left) {
        const double index = body.number(property.type);
        if (index < 0) {
          strip.restart();
        } else {
          strip.add(vertex_index(index));
        }
      }
    }
    body.end_record();
  }
}

template <class Body, class Sink>
void read_body(Body body, const Header& header, Sink& sink) {
  const VertexDetails details = details_of(header);
  for (const Element& element : header.elements) {
    if (element.count == 0 || element.properties.empty()) continue;
    body.expect_room(element);
    if (element.name == "vertex") {
      read_vertices(body, element, details, sink);
    } else if (element.name == "face") {
      read_faces(body, element, sink);
    } else if (element.name == "tristrips") {
      read_strips(body, element, sink);
    } else {
      for (std::uint64_t i = 0; i < element.count; ++i) {
        for (const Property& property : element.properties) skip_property(body, property);
        body.end_record();
      }
    }
  }
  if constexpr (Sink::kDetails) {
    if (details.texcoords) sink.take_vertex_texcoords(0, 0, sink.vertex_count(), 0);
    if (details.normals) sink.take_vertex_normals(0, 0, sink.vertex_count(), 0);
  }
}

void check_elements(const Source& source, const Header& header) {
  bool has_vertices = false;
  for (const Element& element : header.elements) {
    if (element.name == "vertex") {
      has_vertices = true;
      if (!has_number(element, "x") || !has_number(element, "y") || !has_number(element, "z")) {
        fail_at_line(source.name, element.line, "the vertices have no properties x, y and z");
      }
    } else if ((element.name == "face" || element.name == "tristrips") && element.count > 0 &&
               std::none_of(element.properties.begin(), element.properties.end(), is_corner_list)) {
      fail_at_line(source.name, element.line, in_quotes(element.name) + " has no list property vertex_indices");
    }
  }
  if (!has_vertices) fail_at_line(source.name, header.body_line, "the header ends without 'element vertex'");
}

}  // namespace

template <class Sink>
void read_ply(const Source& source, Sink& sink) {
  const Header header = read_header(source);
  check_elements(source, header);
  if (header.encoding == Encoding::Ascii) {
    read_body(TextBody(source, header), header, sink);
  } else {
    read_body(BinaryBody(source, header), header, sink);
  }
}

template void read_ply(const Source&, SoupSink&);
template void read_ply(const Source&, MeshSink&);

}  // namespace tetsoup::readers
