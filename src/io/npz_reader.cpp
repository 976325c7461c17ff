// Nothing that a .npz file says about offsets, sizes or shapes is believed before it fits into the bytes that are
// there.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>

#include "io/crc32.h"
#include "io/npz.h"
#include "io/raw_numbers.h"
#include "io/zip_reader.h"
#include "tetsoup/error.h"

namespace tetsoup {

namespace {

std::string in_quotes(const std::string& text) {
  return "'" + text + "'";
}

std::string_view open_member(std::string_view bytes, const std::string& name, const ZipMember& member,
                             std::size_t& offset) {
  if (!member.stored) fail_in_file(name, member.entry_at, "an array is compressed or encrypted; save with numpy.savez");
  if (member.packed_size != member.size)
    fail_in_file(name, member.entry_at, "an array is stored in another size than its own");
  const std::string_view content = packed_bytes(bytes, name, member, offset);
  if (crc32(content) != member.checksum) fail_in_file(name, offset, "an array's checksum is wrong");
  return content;
}

/// What stands behind a key of the header's dictionary, up to and without `end`.
std::string_view value_of(std::string_view header, std::string_view key, char begin, char end) {
  const std::size_t at = header.find(key);
  if (at == header.npos) return {};
  std::string_view value = header.substr(at + key.size());
  value.remove_prefix(std::min(value.find_first_not_of(": "), value.size()));
  if (!value.starts_with(begin)) return {};
  value.remove_prefix(1);
  return value.substr(0, value.find(end));
}

/// Of at most `most` elements; nothing if it is no shape or has more.
std::optional<std::vector<std::size_t>> shape_of(std::string_view text, std::size_t most) {
  std::vector<std::size_t> shape;
  std::size_t count = 1;
  while (true) {
    text.remove_prefix(std::min(text.find_first_not_of(", "), text.size()));
    if (text.empty()) return shape;
    std::size_t size = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), size);
    if (error != std::errc() || (size > 0 && count > most / size)) return {};
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    count *= size;
    shape.push_back(size);
  }
}

/// Bytes of one element; 0 unless it is a number that we know.
std::size_t element_size(std::string_view type) {
  if (type.size() != 3 || (type[0] != '<' && type[0] != '|')) return 0;
  const std::string_view kind = type.substr(1);
  for (const char* known : {"f4", "f8", "i1", "i2", "i4", "i8", "u1", "u2", "u4", "u8"})
    if (kind == known) return static_cast<std::size_t>(kind[1] - '0');
  return 0;
}

std::optional<NpzArray> read_npy(std::string_view content, const std::string& name, std::size_t offset) {
  constexpr std::size_t kMostDimensions = 32;
  ByteCursor in(content, name, 0, offset);
  in.expect("\x93NUMPY", "the header of an array");
  const auto version = in.number<std::uint8_t>();
  in.take(1);
  const std::string_view header = in.take(version == 1 ? in.number<std::uint16_t>() : in.number<std::uint32_t>());
  NpzArray array;
  array.type = value_of(header, "'descr'", '\'', '\'');
  const std::size_t size = element_size(array.type);
  if (size == 0) return {};
  if (header.find("'fortran_order': False") == header.npos) fail_in_file(name, offset, "an array is in column order");
  array.bytes = content.substr(in.at());
  array.offset = offset + in.at();
  const auto shape = shape_of(value_of(header, "'shape'", '(', ')'), array.bytes.size() / size);
  if (!shape || shape->size() > kMostDimensions)
    fail_in_file(name, offset, "an array promises more than its member holds");
  array.shape = *shape;
  if (array.bytes.size() != array.count() * size)
    fail_in_file(name, offset, "an array is of another size than its shape says");
  return array;
}

template <class Number, class Add>
void add_all(std::string_view bytes, const Add& add) {
  for (std::size_t i = 0; i < bytes.size(); i += sizeof(Number)) add(load_raw<Number>(bytes.substr(i)));
}

/// add(number) for every number of the array.
template <class Add>
void for_each_number(const NpzArray& array, const Add& add) {
  const std::string_view kind = std::string_view(array.type).substr(1);
  if (kind == "f4") return add_all<float>(array.bytes, add);
  if (kind == "f8") return add_all<double>(array.bytes, add);
  if (kind == "i1") return add_all<std::int8_t>(array.bytes, add);
  if (kind == "i2") return add_all<std::int16_t>(array.bytes, add);
  if (kind == "i4") return add_all<std::int32_t>(array.bytes, add);
  if (kind == "i8") return add_all<std::int64_t>(array.bytes, add);
  if (kind == "u1") return add_all<std::uint8_t>(array.bytes, add);
  if (kind == "u2") return add_all<std::uint16_t>(array.bytes, add);
  if (kind == "u4") return add_all<std::uint32_t>(array.bytes, add);
  add_all<std::uint64_t>(array.bytes, add);
}

const NpzArray& find_array(const std::map<std::string, NpzArray>& arrays, const std::string& file,
                           const std::string& array, std::size_t columns) {
  const auto found = arrays.find(array);
  if (found == arrays.end()) fail_in_file(file, 0, "there is no array " + in_quotes(array) + " of numbers");
  const std::vector<std::size_t>& shape = found->second.shape;
  const bool fits = columns == 0 ? shape.size() == 1 : shape.size() == 2 && shape[1] == columns;
  if (!fits)
    fail_in_file(file, found->second.offset,
                 "array " + in_quotes(array) + " is not of shape (N" +
                     (columns == 0 ? ",)" : ", " + std::to_string(columns) + ")"));
  return found->second;
}

}  // namespace

std::size_t NpzArray::count() const {
  return std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>());
}

std::map<std::string, NpzArray> read_npz(std::string_view bytes, const std::string& name) {
  constexpr std::string_view kExtension = ".npy";
  std::map<std::string, NpzArray> arrays;
  std::size_t left = bytes.size();
  for (const ZipMember& member : read_zip_directory(bytes, name, "a .npz file")) {
    if (!member.name.ends_with(kExtension)) continue;
    if (member.size > left) fail_in_file(name, member.entry_at, "its arrays take more than the whole file");
    left -= member.size;
    std::size_t offset = 0;
    const std::string_view content = open_member(bytes, name, member, offset);
    if (const auto array = read_npy(content, name, offset))
      arrays[std::string(member.name.substr(0, member.name.size() - kExtension.size()))] = *array;
  }
  return arrays;
}

std::vector<double> npz_reals(const std::map<std::string, NpzArray>& arrays, const std::string& file,
                              const std::string& array, std::size_t columns) {
  const NpzArray& found = find_array(arrays, file, array, columns);
  std::vector<double> numbers;
  numbers.reserve(found.count());
  for_each_number(found, [&](auto value) { numbers.push_back(static_cast<double>(value)); });
  return numbers;
}

std::vector<std::uint32_t> npz_indices(const std::map<std::string, NpzArray>& arrays, const std::string& file,
                                       const std::string& array, std::size_t columns) {
  const NpzArray& found = find_array(arrays, file, array, columns);
  std::vector<std::uint32_t> indices;
  indices.reserve(found.count());
  for_each_number(found, [&](auto value) {
    const auto number = static_cast<double>(value);
    if (!(number >= 0 && number <= std::numeric_limits<std::uint32_t>::max()) || number != std::floor(number))
      fail_in_file(file, found.offset, "array " + in_quotes(array) + " holds what is no index");
    indices.push_back(static_cast<std::uint32_t>(number));
  });
  return indices;
}

}  // namespace tetsoup
