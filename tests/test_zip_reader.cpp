// Zip files: what DEFLATE packed, and what lies about itself.
#include "io/inflate.h"

#include <gtest/gtest.h>

#include <string>

#include "io/zip_reader.h"
#include "tetsoup/error.h"
#include "zip_files.h"

namespace tetsoup {
namespace {

using namespace test;

std::string from_hex(std::string_view hex) {
  std::string bytes;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2)
    bytes += static_cast<char>(std::stoi(std::string(hex.substr(i, 2)), nullptr, 16));
  return bytes;
}

/// Numbers and their squares, a line each.
std::string squares() {
  std::string text;
  for (int i = 0; i < 40; ++i) text += std::to_string(i) + " " + std::to_string(i * i) + "\n";
  return text;
}

// The squares as zlib packs them, with codes of their own and with the fixed ones, and five thousand times "ab".
const std::string kOwnCodes = from_hex(
    "158fb9110031080373aa50097cc6a6ffc66e2ff268d0b376b985c2526da5b5568c1de5b1518d5df5dad3b4ad5e58b8c20990"
    "48542aba2d8acc5a10ddb1204c3a860ed4553e6e4f9538974eb65c4d4b86ba514cbfb62c9d5ccbd6b9637934b4e4687e7575"
    "ffdbd3fd9da0902bd7d252a1a5b36071260a1867b1a00900ea804a530d2f787515056dbd9f1dff2a0e7ff900");
const std::string kFixedCodes = from_hex(
    "335030e0325430e4325230e13256b0e432513034e332553032e532533036e3325730b1e4b2503033e1b254b030e432345030"
    "34006a00ea3002f28c140c4d4cb80c8d817a2cb90c815a2dcdb80c819a81ba0dcd80660079e60a461640390b056323a04a4b"
    "a09940bb0c144c80a618192a9898007940ab2d4cb88c8c154c8d2cb98c4c144ccdcdb88c4c15cc80a6189929988178e60ae6"
    "20390b0573904aa05380fa8c0d142c81a6181b2a5802cd3406bac500688531d03106401b8d81ae31043ac0d814e854a049c6"
    "66401ae83c6373054363a06b8d2d406e07aab754303405fa0500");
const std::string kRepeated = from_hex("edc2010900000002a0adf57f443b02d134000000000000000000706f");

TEST(ZipReader, what_zlib_packed_is_unpacked) {
  EXPECT_EQ(inflate(kOwnCodes, 1000), squares());
  EXPECT_EQ(inflate(kFixedCodes, 1000), squares());
  const auto repeated = inflate(kRepeated, 10'000);
  ASSERT_TRUE(repeated);
  EXPECT_EQ(repeated->size(), 10'000U);
  EXPECT_EQ(repeated->substr(9'996), "abab");
  EXPECT_EQ(inflate(std::string("\x01\x03\x00\xfc\xff", 5) + "abc", 3), "abc");
}

TEST(ZipReader, no_more_is_unpacked_than_asked_for) {
  EXPECT_EQ(inflate(kRepeated, 9'999), std::nullopt);
  EXPECT_EQ(inflate(kOwnCodes, squares().size() - 1), std::nullopt);
}

TEST(ZipReader, every_truncation_is_noticed_and_every_damage_is_survived) {
  for (const std::string& packed : {kOwnCodes, kFixedCodes, kRepeated}) {
    for (std::size_t length = 0; length < packed.size(); ++length)
      EXPECT_EQ(inflate(packed.substr(0, length), 10'000), std::nullopt) << length;
    for (std::size_t bit = 0; bit < 8 * packed.size(); ++bit) {
      std::string damaged = packed;
      damaged[bit / 8] = static_cast<char>(damaged[bit / 8] ^ (1 << bit % 8));
      const auto unpacked = inflate(damaged, 10'000);
      EXPECT_LE(unpacked.value_or("").size(), 10'000U);
    }
  }
}

TEST(ZipReader, members_are_found_unpacked_and_checked) {
  const std::string name = "sample";
  const std::string bytes = zip_of({{"a.txt", "stored", ""}, {"b/c.txt", squares(), kOwnCodes}});
  const auto members = read_zip_directory(bytes, name, "a zip file");
  ASSERT_EQ(members.size(), 2U);
  EXPECT_EQ(members[1].name, "b/c.txt");
  EXPECT_EQ(unpacked_member(bytes, name, members[0], 1000), "stored");
  EXPECT_EQ(unpacked_member(bytes, name, members[1], 1000), squares());
  EXPECT_THROW(unpacked_member(bytes, name, members[1], 100), IoError);
  std::string damaged = bytes;
  damaged[damaged.find("stored")] = 'S';
  EXPECT_THROW(unpacked_member(damaged, name, members[0], 1000), IoError);
  EXPECT_THROW(read_zip_directory("no zip", name, "a zip file"), IoError);
}

}  // namespace
}  // namespace tetsoup
