// Zip files, member by member.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/crc32.h"
#include "io/raw_numbers.h"

namespace tetsoup::test {

struct ZipContent {
  std::string name, content;
  std::string packed;  ///< By DEFLATE; empty: stored as it is.
};

inline std::string zip_of(const std::vector<ZipContent>& contents) {
  std::string bytes, directory;
  const auto number = [](std::string& to, auto value) { append_raw(to, value); };
  for (const ZipContent& member : contents) {
    const std::string& lying = member.packed.empty() ? member.content : member.packed;
    std::string common;  // what both headers say
    number(common, std::uint16_t{20});
    number(common, std::uint16_t{0});
    number(common, static_cast<std::uint16_t>(member.packed.empty() ? 0 : 8));
    number(common, std::uint32_t{0});
    number(common, crc32(member.content));
    number(common, static_cast<std::uint32_t>(lying.size()));
    number(common, static_cast<std::uint32_t>(member.content.size()));
    number(common, static_cast<std::uint16_t>(member.name.size()));
    number(common, std::uint16_t{0});
    directory += "PK\x01\x02";
    number(directory, std::uint16_t{20});
    directory += common + std::string(10, '\0');
    number(directory, static_cast<std::uint32_t>(bytes.size()));
    directory += member.name;
    bytes += "PK\x03\x04" + common + member.name + lying;
  }
  const std::size_t begin = bytes.size();
  bytes += directory + "PK\x05\x06" + std::string(4, '\0');
  for (int i = 0; i < 2; ++i) number(bytes, static_cast<std::uint16_t>(contents.size()));
  number(bytes, static_cast<std::uint32_t>(directory.size()));
  number(bytes, static_cast<std::uint32_t>(begin));
  number(bytes, std::uint16_t{0});
  return bytes;
}

}  // namespace tetsoup::test
