// The members of a zip file held in memory. Nothing it says about offsets or sizes is believed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/raw_numbers.h"

namespace tetsoup {

/// "name: byte N: what". @throws IoError
[[noreturn]] void fail_in_file(const std::string& name, std::size_t byte, const std::string& what);

/// Bytes of a file from an offset on.
class ByteCursor {
 public:
  /// @param begin  Where the bytes begin in the file.
  ByteCursor(std::string_view bytes, const std::string& name, std::size_t at, std::size_t begin = 0);

  std::size_t at() const { return at_; }
  std::string_view take(std::size_t count);
  template <class Number>
  Number number() {
    return load_raw<Number>(take(sizeof(Number)));
  }
  void expect(std::string_view mark, const char* what);

 private:
  std::string_view bytes_;
  const std::string& name_;
  std::size_t at_, begin_;
};

struct ZipMember {
  std::string_view name;
  std::uint32_t checksum = 0;
  std::size_t packed_size = 0, size = 0;    ///< Bytes as they lie in the file, and once unpacked.
  std::size_t entry_at = 0, header_at = 0;  ///< In the file.
  bool stored = false, deflated = false;    ///< Neither: encrypted, or packed in another way.
};

/// @param what  What the file should be, for the message where it is no zip file: "a .npz file".
/// @throws IoError  naming the byte.
std::vector<ZipMember> read_zip_directory(std::string_view bytes, const std::string& name, const char* what);

/// The member's bytes as they lie in the file, from `offset` on.
std::string_view packed_bytes(std::string_view bytes, const std::string& name, const ZipMember& member,
                              std::size_t& offset);

/// The member, unpacked, its checksum compared.
/// @throws IoError  if it is damaged, packed in another way than usual, or larger than `most` bytes.
std::string unpacked_member(std::string_view bytes, const std::string& name, const ZipMember& member, std::size_t most);

}  // namespace tetsoup
