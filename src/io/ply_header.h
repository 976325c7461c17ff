// The header of a PLY file: what records follow, and of what numbers they are made.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/soup_readers.h"

namespace tetsoup::readers::ply {

enum class Type { Int8, Uint8, Int16, Uint16, Int32, Uint32, Float32, Float64 };
enum class Encoding { Ascii, LittleEndian, BigEndian };

std::size_t size_of(Type type);

struct Property {
  std::string name;
  Type type;
  std::optional<Type> count_type;  ///< Set for lists.
};

struct Element {
  std::string name;
  std::size_t line = 0;  ///< Of the header.
  std::uint64_t count = 0;
  std::vector<Property> properties;

  /// No record is smaller: binary, all lists empty.
  std::size_t smallest_record() const;
};

struct Header {
  Encoding encoding = Encoding::Ascii;
  std::vector<Element> elements;
  std::size_t body_offset = 0;
  std::size_t body_line = 0;
};

Header read_header(const Source& source);

}  // namespace tetsoup::readers::ply
