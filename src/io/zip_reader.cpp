#include "io/zip_reader.h"

#include "io/crc32.h"
#include "io/inflate.h"
#include "tetsoup/error.h"

namespace tetsoup {
namespace {

/// The directory's place stands at the very end, before a comment.
ByteCursor open_directory(std::string_view bytes, const std::string& name, const char* what, std::size_t& count) {
  constexpr std::size_t kEndBytes = 22, kLongestComment = 65535;
  const std::size_t first = bytes.size() > kEndBytes + kLongestComment ? bytes.size() - kEndBytes - kLongestComment : 0;
  const std::size_t found = bytes.substr(first).rfind("PK\x05\x06");
  if (found == bytes.npos)
    fail_in_file(name, bytes.size(), "not " + std::string(what) + ": it does not end in the directory of a zip file");
  ByteCursor end(bytes, name, first + found + 10);
  count = end.number<std::uint16_t>();
  end.take(4);
  const std::size_t begin = end.number<std::uint32_t>();
  end.take(2);
  return {bytes, name, begin};
}

ZipMember read_entry(ByteCursor& directory) {
  ZipMember member;
  member.entry_at = directory.at();
  directory.expect("PK\x01\x02", "an entry of the zip file's directory");
  directory.take(4);
  const auto flags = directory.number<std::uint16_t>(), method = directory.number<std::uint16_t>();
  const bool encrypted = (flags & 1U) != 0;
  member.stored = method == 0 && !encrypted;
  member.deflated = method == 8 && !encrypted;
  directory.take(4);
  member.checksum = directory.number<std::uint32_t>();
  member.packed_size = directory.number<std::uint32_t>();
  member.size = directory.number<std::uint32_t>();
  const std::size_t name_size = directory.number<std::uint16_t>(), extra = directory.number<std::uint16_t>(),
                    comment = directory.number<std::uint16_t>();
  directory.take(8);
  member.header_at = directory.number<std::uint32_t>();
  member.name = directory.take(name_size);
  directory.take(extra + comment);
  return member;
}

}  // namespace

void fail_in_file(const std::string& name, std::size_t byte, const std::string& what) {
  throw IoError(name + ": byte " + std::to_string(byte) + ": " + what);
}

ByteCursor::ByteCursor(std::string_view bytes, const std::string& name, std::size_t at, std::size_t begin)
    : bytes_(bytes), name_(name), at_(at), begin_(begin) {
  if (at > bytes.size()) fail_in_file(name, bytes.size(), "the file ends before byte " + std::to_string(at));
}

std::string_view ByteCursor::take(std::size_t count) {
  if (count > bytes_.size() - at_) fail_in_file(name_, begin_ + bytes_.size(), "the bytes end within a record");
  at_ += count;
  return bytes_.substr(at_ - count, count);
}

void ByteCursor::expect(std::string_view mark, const char* what) {
  const std::size_t begin = at_;
  if (take(mark.size()) != mark) fail_in_file(name_, begin_ + begin, std::string("expected ") + what);
}

std::vector<ZipMember> read_zip_directory(std::string_view bytes, const std::string& name, const char* what) {
  std::size_t count = 0;
  ByteCursor directory = open_directory(bytes, name, what, count);
  std::vector<ZipMember> members;
  for (std::size_t i = 0; i < count; ++i) members.push_back(read_entry(directory));
  return members;
}

std::string_view packed_bytes(std::string_view bytes, const std::string& name, const ZipMember& member,
                              std::size_t& offset) {
  ByteCursor header(bytes, name, member.header_at);
  header.expect("PK\x03\x04", "a member of the zip file");
  header.take(22);
  const std::size_t name_size = header.number<std::uint16_t>(), extra = header.number<std::uint16_t>();
  header.take(name_size + extra);
  offset = header.at();
  return header.take(member.packed_size);
}

std::string unpacked_member(std::string_view bytes, const std::string& name, const ZipMember& member,
                            std::size_t most) {
  std::size_t offset = 0;
  const std::string_view packed = packed_bytes(bytes, name, member, offset);
  if (!member.stored && !member.deflated)
    fail_in_file(name, member.entry_at, "a part is encrypted, or packed in an unusual way");
  if (member.size > most) fail_in_file(name, member.entry_at, "a part unpacks to far more than the file's size");
  std::optional<std::string> content =
      member.stored ? std::optional<std::string>(packed) : inflate(packed, member.size);
  if (!content || content->size() != member.size) fail_in_file(name, offset, "a part is damaged");
  if (crc32(*content) != member.checksum) fail_in_file(name, offset, "a part's checksum is wrong");
  return std::move(*content);
}

}  // namespace tetsoup
