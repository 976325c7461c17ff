#include "io/ply_header.h"

#include <algorithm>
#include <array>

#include "io/text_scanner.h"

namespace tetsoup::readers::ply {
namespace {

struct TypeName {
  std::string_view name, sized_name;
  std::size_t size;
};
constexpr std::array<TypeName, 8> kTypes = {{{"char", "int8", 1},
                                             {"uchar", "uint8", 1},
                                             {"short", "int16", 2},
                                             {"ushort", "uint16", 2},
                                             {"int", "int32", 4},
                                             {"uint", "uint32", 4},
                                             {"float", "float32", 4},
                                             {"double", "float64", 8}}};  // in the order of Type

std::string_view next_word(TextScanner& text) {
  text.skip_blanks();
  return text.word();
}

Type read_type(TextScanner& text) {
  text.skip_blanks();
  TextScanner ahead = text;
  const std::string_view word = ahead.word();
  for (std::size_t i = 0; i < kTypes.size(); ++i) {
    if (word != kTypes[i].name && word != kTypes[i].sized_name) continue;
    text = ahead;
    return static_cast<Type>(i);
  }
  text.fail_expected("a type such as float or uchar");
}

Encoding read_format(TextScanner& text) {
  text.skip_blanks();
  TextScanner ahead = text;
  const std::string_view word = ahead.word();
  if (word == "ascii") return Encoding::Ascii;
  if (word == "binary_little_endian") return Encoding::LittleEndian;
  if (word == "binary_big_endian") return Encoding::BigEndian;
  text.fail_expected("ascii, binary_little_endian or binary_big_endian");
}

Element read_element(TextScanner& text) {
  Element element;
  element.line = text.line();
  element.name = next_word(text);
  text.skip_blanks();
  const std::int64_t count = text.integer();
  if (count < 0) text.fail("the number of " + in_quotes(element.name) + " is negative");
  element.count = static_cast<std::uint64_t>(count);
  return element;
}

Property read_property(TextScanner& text) {
  text.skip_blanks();
  TextScanner ahead = text;
  std::optional<Type> count_type;
  if (ahead.word() == "list") {
    text = ahead;
    count_type = read_type(text);
    if (*count_type >= Type::Float32) text.fail("a list cannot be counted in floating-point numbers");
  }
  const Type type = read_type(text);
  return {std::string(next_word(text)), type, count_type};
}

/// Some programs leave out the word "comment". What may be a declaration with a word misspelt is none of those: without
/// it the records would be read wrongly.
void pass_over_remark(TextScanner& text) {
  TextScanner ahead = text;
  ahead.word();
  const std::string_view second = next_word(ahead);
  ahead.skip_blanks();
  std::string_view third = ahead.word();
  const bool typed = second == "list" || std::any_of(kTypes.begin(), kTypes.end(), [&](const TypeName& type) {
                       return second == type.name || second == type.sized_name;
                     });
  const bool counted = !third.empty() && third.find_first_not_of("0123456789") == third.npos;
  if (typed || counted) text.fail_expected("a header line of a PLY file");
}

void skip_first_line(TextScanner& text) {
  TextScanner ahead = text;
  if (ahead.word() != "ply") text.fail_expected("'ply'");
  text.skip_line();
}

/// Behind the end of the header's last line. Where lines end in a lone \r, an \n already belongs to binary data.
std::size_t body_offset(const Source& source, const TextScanner& behind_line) {
  const auto at = [&](std::size_t i) { return static_cast<char>(source.bytes[i]); };
  std::size_t first_end = 0;
  while (first_end + 1 < source.bytes.size() && at(first_end) != '\r' && at(first_end) != '\n') ++first_end;
  const bool lone_returns = at(first_end) == '\r' && at(first_end + 1) != '\n';
  const std::size_t offset = behind_line.offset();
  return lone_returns && at(offset - 1) == '\n' ? offset - 1 : offset;
}

}  // namespace

std::size_t size_of(Type type) {
  return kTypes[static_cast<std::size_t>(type)].size;
}

std::size_t Element::smallest_record() const {
  std::size_t size = 0;
  for (const Property& property : properties) size += size_of(property.count_type.value_or(property.type));
  return size;
}

Header read_header(const Source& source) {
  TextScanner text(source);
  skip_first_line(text);
  Header header;
  bool has_format = false;
  for (; !text.at_end(); text.skip_line()) {
    text.skip_blanks();
    TextScanner ahead = text;
    const std::string_view keyword = ahead.word();
    if (keyword == "format") {
      header.encoding = read_format(ahead);
      has_format = true;
    } else if (keyword == "element") {
      header.elements.push_back(read_element(ahead));
    } else if (keyword == "property") {
      if (header.elements.empty()) text.fail("a property before the first element");
      header.elements.back().properties.push_back(read_property(ahead));
    } else if (keyword == "end_header") {
      if (!has_format) text.fail("the header ends without a format line");
      text.skip_line();
      header.body_offset = body_offset(source, text);
      header.body_line = text.line();
      return header;
    } else if (keyword != "comment" && keyword != "obj_info" && !keyword.empty()) {
      pass_over_remark(text);
    }
  }
  text.fail("the file ends before 'end_header'");
}

}  // namespace tetsoup::readers::ply
