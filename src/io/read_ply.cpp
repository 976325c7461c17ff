// PLY, text and binary of both orders: vertices, faces and triangle strips; all other elements are passed over.
#include <algorithm>
#include <bit>

#include "io/load_bytes.h"
#include "io/ply_header.h"
#include "io/text_scanner.h"

namespace tetsoup::readers {
namespace {

using namespace ply;

// The two bodies have the same members: one number, a list's length, passing over numbers, room for records.

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

  [[noreturn]] void fail(const std::string& what) const { fail_at_byte(source_.name, at_, what); }

 private:
  std::size_t bytes_left() const { return source_.bytes.size() - at_; }

  Source source_;
  std::endian order_;
  std::size_t at_;
};

class TextBody {
 public:
  TextBody(const Source& source, const Header& header) : text_(source, header.body_offset, header.body_line) {}

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
  [[noreturn]] void fail(const std::string& what) const { text_.fail(what); }

 private:
  TextScanner text_;
};

template <class Body>
void skip_property(Body& body, const Property& property) {
  body.skip(property.type, property.count_type ? body.list_length(property) : 1);
}

template <class Body>
void read_vertices(Body& body, const Element& element, std::vector<Vec3>& vertices) {
  vertices.reserve(vertices.size() + element.count);
  for (std::uint64_t i = 0; i < element.count; ++i) {
    Vec3 vertex;
    for (const Property& property : element.properties) {
      if (property.count_type || property.name.size() != 1) {
        skip_property(body, property);
        continue;
      }
      const auto value = static_cast<float>(body.number(property.type));
      if (property.name[0] == 'x') vertex.x = value;
      if (property.name[0] == 'y') vertex.y = value;
      if (property.name[0] == 'z') vertex.z = value;
    }
    vertices.push_back(vertex);
  }
}

bool is_corner_list(const Property& property) {
  return property.count_type && (property.name == "vertex_indices" || property.name == "vertex_index");
}

template <class Body>
void read_faces(Body& body, const Element& element, std::vector<Triangle>& triangles) {
  triangles.reserve(triangles.size() + element.count);
  for (std::uint64_t i = 0; i < element.count; ++i) {
    for (const Property& property : element.properties) {
      if (!is_corner_list(property)) {
        skip_property(body, property);
        continue;
      }
      Fan fan(triangles);
      for (std::size_t left = body.list_length(property); left > 0; --left) {
        fan.add(vertex_index(body.number(property.type)));
      }
    }
  }
}

/// A negative index ends a strip.
template <class Body>
void read_strips(Body& body, const Element& element, std::vector<Triangle>& triangles) {
  for (std::uint64_t i = 0; i < element.count; ++i) {
    for (const Property& property : element.properties) {
      if (!is_corner_list(property)) {
        skip_property(body, property);
        continue;
      }
      Strip strip(triangles);
      for (std::size_t left = body.list_length(property); left > 0; --left) {
        const double index = body.number(property.type);
        if (index < 0) {
          strip.restart();
        } else {
          strip.add(vertex_index(index));
        }
      }
    }
  }
}

template <class Body>
TriangleSoup read_body(Body body, const Header& header) {
  TriangleSoup soup;
  for (const Element& element : header.elements) {
    if (element.count == 0 || element.properties.empty()) continue;
    body.expect_room(element);
    if (element.name == "vertex") {
      read_vertices(body, element, soup.vertices);
    } else if (element.name == "face") {
      read_faces(body, element, soup.triangles);
    } else if (element.name == "tristrips") {
      read_strips(body, element, soup.triangles);
    } else {
      for (std::uint64_t i = 0; i < element.count; ++i) {
        for (const Property& property : element.properties) skip_property(body, property);
      }
    }
  }
  return soup;
}

void check_elements(const Source& source, const Header& header) {
  bool has_vertices = false;
  for (const Element& element : header.elements) {
    const auto has = [&](auto&& wanted) {
      return std::any_of(element.properties.begin(), element.properties.end(), wanted);
    };
    const auto has_coordinate = [&](std::string_view name) {
      return has([&](const Property& p) { return p.name == name && !p.count_type; });
    };
    if (element.name == "vertex") {
      has_vertices = true;
      if (!has_coordinate("x") || !has_coordinate("y") || !has_coordinate("z")) {
        fail_at_line(source.name, element.line, "the vertices have no properties x, y and z");
      }
    } else if ((element.name == "face" || element.name == "tristrips") && element.count > 0 && !has(is_corner_list)) {
      fail_at_line(source.name, element.line, in_quotes(element.name) + " has no list property vertex_indices");
    }
  }
  if (!has_vertices) fail_at_line(source.name, header.body_line, "the header ends without 'element vertex'");
}

}  // namespace

TriangleSoup read_ply(const Source& source) {
  const Header header = read_header(source);
  check_elements(source, header);
  if (header.encoding == Encoding::Ascii) return read_body(TextBody(source, header), header);
  return read_body(BinaryBody(source, header), header);
}

}  // namespace tetsoup::readers
