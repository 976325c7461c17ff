#include <algorithm>
#include <limits>

#include "io/npz.h"
#include "io/crc32.h"
#include "io/number_text.h"
#include "io/raw_numbers.h"
#include "io/utf8.h"
#include "tetsoup/error.h"

namespace tetsoup {

namespace {

constexpr std::size_t kMostBytes = std::numeric_limits<std::uint32_t>::max();

/// Magic, version 1.0, and a dictionary padded so that the numbers start at a multiple of 64.
std::string npy_header(const std::string& type, std::initializer_list<std::size_t> shape) {
  constexpr std::size_t kAlignment = 64, kPreamble = 10;
  std::string text = "{'descr': '" + type + "', 'fortran_order': False, 'shape': (";
  const char* separator = "";
  for (const std::size_t size : shape) {
    append_number(text += separator, size);
    separator = ", ";
  }
  text += shape.size() == 1 ? ",), }" : "), }";
  const std::size_t unpadded = kPreamble + text.size() + 1;
  text.append((kAlignment - unpadded % kAlignment) % kAlignment, ' ');
  text += '\n';
  std::string header("\x93NUMPY\x01\x00", 8);
  append_raw(header, static_cast<std::uint16_t>(text.size()));
  return header + text;
}

/// What a member's own header and the directory's entry have in common: from the version needed to the extra length.
std::string member_facts(std::uint32_t checksum, std::size_t size, std::size_t name_size) {
  constexpr std::uint16_t kVersion = 20, kUtf8Name = 0x800, kStored = 0, kMidnight = 0, kFirstOfJanuary1980 = 0x21;
  std::string facts;
  for (const std::uint16_t fact : {kVersion, kUtf8Name, kStored, kMidnight, kFirstOfJanuary1980})
    append_raw(facts, fact);
  append_raw(facts, checksum);
  append_raw(facts, static_cast<std::uint32_t>(size));
  append_raw(facts, static_cast<std::uint32_t>(size));
  append_raw(facts, static_cast<std::uint16_t>(name_size));
  append_raw(facts, std::uint16_t{0});
  return facts;
}

}  // namespace

void NpzWriter::add_array(std::string_view name, const std::string& type, std::initializer_list<std::size_t> shape,
                          std::string_view bytes) {
  constexpr std::uint32_t kMember = 0x04034B50, kEntry = 0x02014B50;
  const std::string file_name = std::string(name) + ".npy", header = npy_header(type, shape);
  if (header.size() + bytes.size() > kMostBytes || bytes_.size() > kMostBytes)
    throw IoError("array '" + std::string(name) + "': more than the 4 GB that a .npz file can hold");
  const std::string facts = member_facts(crc32(bytes, crc32(header)), header.size() + bytes.size(), file_name.size());
  append_raw(directory_, kEntry);
  append_raw(directory_, std::uint16_t{20});
  directory_ += facts;
  directory_.append(2 + 2 + 2 + 4, '\0');  // Comment's length, disk, attributes within and without.
  append_raw(directory_, static_cast<std::uint32_t>(bytes_.size()));
  directory_ += file_name;
  append_raw(bytes_, kMember);
  bytes_ += facts;
  bytes_ += file_name;
  bytes_ += header;
  bytes_ += bytes;
  ++count_;
}

void NpzWriter::add_texts(std::string_view name, std::span<const std::string> texts) {
  std::vector<std::u32string> codes;
  std::size_t longest = 1;
  for (const std::string& text : texts) longest = std::max(longest, codes.emplace_back(decode_utf8(text)).size());
  std::string bytes;
  bytes.reserve(sizeof(char32_t) * longest * codes.size());
  for (std::u32string& text : codes) {
    text.resize(longest, U'\0');
    for (const char32_t code : text) append_raw(bytes, code);
  }
  add_array(name, "<U" + std::to_string(longest), {texts.size()}, bytes);
}

std::string NpzWriter::take() {
  constexpr std::uint32_t kEnd = 0x06054B50;
  if (bytes_.size() + directory_.size() > kMostBytes)
    throw IoError("the arrays take more than the 4 GB that a .npz file can hold");
  const std::size_t begin = bytes_.size();
  bytes_ += directory_;
  append_raw(bytes_, kEnd);
  append_raw(bytes_, std::uint32_t{0});  // Disks.
  for (int i = 0; i < 2; ++i) append_raw(bytes_, static_cast<std::uint16_t>(count_));
  append_raw(bytes_, static_cast<std::uint32_t>(directory_.size()));
  append_raw(bytes_, static_cast<std::uint32_t>(begin));
  append_raw(bytes_, std::uint16_t{0});
  return std::move(bytes_);
}

}  // namespace tetsoup
