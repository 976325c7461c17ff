// STL: telling text from binary, and damage.
#include "soup_files.h"

namespace tetsoup {
namespace {

using namespace test;

constexpr SoupFormat kStl = SoupFormat::Stl;

std::string binary_stl(std::string title, std::uint32_t promised, std::uint32_t there) {
  title.resize(80, ' ');
  std::string bytes = title + raw(promised);
  for (std::uint32_t t = 0; t < there; ++t) {
    for (int i = 0; i < 12; ++i) bytes += raw(static_cast<float>(t) + 0.25F * static_cast<float>(i));
    bytes += raw(std::uint16_t{7});
  }
  return bytes;
}

std::string text_stl(int triangles) {
  std::string text = "solid a b c\n";
  for (int t = 0; t < triangles; ++t) {
    const std::string n = std::to_string(t);
    text += "  facet normal 0 0 1e0\n    outer loop\n      vertex 0 0 " + n + "\n      vertex 1.5 0 " + n +
            "\n      vertex 0 -2 " + n + "\n    endloop\n  endfacet\n";
  }
  return text + "endsolid a b c\n";
}

TEST(ReadStl, text_and_binary_give_three_vertices_a_triangle) {
  for (const std::string& bytes : {text_stl(3), binary_stl("made by formula", 3, 3), binary_stl("solid thing", 3, 3)}) {
    const TriangleSoup soup = parse(bytes, kStl);
    EXPECT_EQ(soup.vertices.size(), 9U);
    EXPECT_EQ(soup.triangles, (std::vector<Triangle>{{0, 1, 2}, {3, 4, 5}, {6, 7, 8}}));
  }
  EXPECT_EQ(parse(text_stl(3), kStl).vertices[8], (Vec3{0, -2, 2}));
  EXPECT_EQ(parse(binary_stl("", 3, 3), kStl).vertices[3], (Vec3{1.75F, 2, 2.25F}));
}

TEST(ReadStl, a_truncated_binary_that_begins_with_solid_is_not_read_as_text) {
  EXPECT_ERROR(binary_stl("solid thing", 3, 2), kStl, "byte 80: the header promises 3 triangles, but the file holds 2");
}

TEST(ReadStl, bytes_behind_the_last_triangle_are_passed_over) {
  EXPECT_EQ(parse(binary_stl("solid thing", 3, 3) + "abc", kStl).triangles.size(), 3U);
}

TEST(ReadStl, a_count_of_zero_before_triangles_is_an_error) {
  EXPECT_ERROR(binary_stl("stream", 0, 3), kStl, "promises 0 triangles, but the file holds 3");
  EXPECT_TRUE(parse(binary_stl("empty", 0, 0), kStl).triangles.empty());
}

TEST(ReadStl, a_huge_count_takes_no_memory) {
  largest_allocation = 0;
  EXPECT_ERROR(binary_stl("", 0xffffffff, 1), kStl, "promises 4294967295 triangles");
  EXPECT_LT(largest_allocation, 1000U);
}

TEST(ReadStl, text_may_be_upper_case_have_several_solids_and_any_line_layout) {
  std::string text = text_stl(1) + text_stl(2);
  for (char& c : text) c = c == 'e' ? 'E' : c;
  EXPECT_EQ(parse(text, kStl).triangles.size(), 3U);
  EXPECT_EQ(
      parse("solid\nfacet normal nan 0 0 outer loop vertex 0 0 0\rvertex 1 0 0 vertex 0 1 0 endloop endfacet endsolid",
            kStl)
          .triangles.size(),
      1U);
}

TEST(ReadStl, errors_name_the_line_of_text_and_the_byte_of_binary) {
  EXPECT_ERROR("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0\nendloop\n", kStl, "line 5: expected a number");
  EXPECT_ERROR("solid a\nfacet normal 0 0 1\nouter hoop\n", kStl, "line 3: expected 'loop', found 'hoop'");
  EXPECT_ERROR("solid a\n", kStl, "the file ends before 'endsolid'");
  EXPECT_ERROR("nonsense", kStl, "byte 8");
}

TEST(ReadStl, every_truncation_throws) {
  const std::string text = text_stl(3);
  expect_truncations_throw(text, kStl, text.rfind("endsolid") + 8);
  for (const char* title : {"binary", "solid binary"}) {
    const std::string binary = binary_stl(title, 6, 6);
    expect_truncations_throw(binary, kStl, binary.size());
  }
}

TEST(ReadStl, a_hundred_thousand_flipped_bytes_are_survived) {
  expect_damage_survived(text_stl(3), kStl, 50'000, 2);
  expect_damage_survived(binary_stl("solid binary", 6, 6), kStl, 25'000, 3);
  expect_damage_survived(binary_stl("binary", 6, 6), kStl, 25'000, 4);
}

}  // namespace
}  // namespace tetsoup
