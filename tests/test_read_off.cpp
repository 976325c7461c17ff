// OFF and its variants, and damage.
#include "soup_files.h"

namespace tetsoup {
namespace {

using namespace test;

constexpr SoupFormat kOff = SoupFormat::Off;
const std::vector<Triangle> kQuad = {{0, 1, 2}, {0, 2, 3}};

std::string square(const std::string& header, const std::string& vertex_extra, const std::string& face_extra) {
  std::string text = header;
  for (const char* xyz : {"0 0 0", "1 0 0", "1 1 0", "0 1 0"}) text += xyz + vertex_extra + "\n";
  return text + "4 0 1 2 3" + face_extra + "\n";
}

TEST(ReadOff, all_variants_put_the_position_first) {
  for (const char* name : {"OFF", "COFF", "NOFF", "STOFF", "STCNOFF", "CNOFF"}) {
    const TriangleSoup soup = parse(square(std::string(name) + "\n4 1 4\n", " 0.5 0.5 1 255", " 3 255 0 0"), kOff);
    EXPECT_EQ(soup.triangles, kQuad) << name;
    EXPECT_EQ(soup.vertices[2], (Vec3{1, 1, 0})) << name;
  }
}

TEST(ReadOff, counts_may_follow_the_keyword_or_lack_it_or_lack_the_edges) {
  for (const char* header : {"OFF 4 1 4\n", "OFF\r\n4 1\r\n", "4 1 0\n", "OFF4 1 4\n",
                             "# made by hand\n\nOFF # here\n# counts\n4 1 0 # so\n", "\xEF\xBB\xBFOFF\n\n4\n1 0\n"}) {
    EXPECT_EQ(parse(square(header, "", ""), kOff).triangles, kQuad) << header;
  }
}

TEST(ReadOff, wild_indices_stay_wild_and_short_polygons_leave_nothing) {
  const TriangleSoup soup = parse("OFF\n3 3 0\n0 0 0\n1 0 0\n0 1 0\n3 -1 3 4294967296\n2 0 1\n0\n", kOff);
  ASSERT_EQ(soup.triangles.size(), 1U);
  for (const std::uint32_t corner : soup.triangles[0]) EXPECT_GE(corner, 3U);
}

TEST(ReadOff, what_is_not_supported_says_so) {
  EXPECT_ERROR("OFF BINARY\n1234", kOff, "binary OFF is not supported");
  EXPECT_ERROR("4OFF\n1 0 0\n0 0 0 1\n", kOff, "3 dimensions");
}

TEST(ReadOff, a_word_that_only_begins_like_the_keyword_is_none) {
  EXPECT_ERROR("OFFICE 4 1 4\n", kOff, "expected a whole number, found 'OFFICE'");
}

TEST(ReadOff, errors_name_the_line) {
  EXPECT_ERROR("OFF\n2 0 0\n0 0 0\n0 zero 0\n", kOff, "sample, line 4: expected a number, found 'zero'");
  EXPECT_ERROR("OFF\n-2 0 0\n", kOff, "line 2: the number of vertices is negative");
  EXPECT_ERROR("ply\n", kOff, "line 1: expected a whole number, found 'ply'");
}

TEST(ReadOff, huge_counts_take_no_memory) {
  largest_allocation = 0;
  EXPECT_ERROR("OFF\n4000000000 1 0\n0 0 0\n", kOff, "promises 4000000000 vertices");
  EXPECT_ERROR("OFF\n1 9223372036854775807 0\n0 0 0\n", kOff, "more than the file has room for");
  EXPECT_ERROR("OFF\n1 1 0\n0 0 0\n9223372036854775807 0 0 0 0\n", kOff, "the file ends");
  EXPECT_LT(largest_allocation, 1000U);
}

std::string fan_sample() {
  std::string text = "COFF # a fan\n20 18 0\n";
  for (int i = 0; i < 20; ++i) text += std::to_string(i * 0.1) + " " + std::to_string(i * i) + " -1e-2 255 0 0 255\n";
  for (int i = 0; i < 18; ++i) text += "3 0 " + std::to_string(i + 1) + " " + std::to_string(i + 2) + "\n";
  return text;
}

TEST(ReadOff, every_truncation_throws) {
  const std::string text = fan_sample();
  expect_truncations_throw(text, kOff, text.size() - 2);
}

TEST(ReadOff, a_hundred_thousand_flipped_bytes_are_survived) {
  expect_damage_survived(fan_sample(), kOff, 100'000, 5);
}

}  // namespace
}  // namespace tetsoup
