// OBJ: the oddities of the wild, and damage.
#include <cmath>

#include "soup_files.h"

namespace tetsoup {
namespace {

using namespace test;

constexpr SoupFormat kObj = SoupFormat::Obj;
const std::vector<Triangle> kQuad = {{0, 1, 2}, {0, 2, 3}};
const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TriangleSoup parse_obj(std::string_view text) {
  return parse(text, kObj);
}

TEST(ReadObj, polygons_become_fans) {
  const TriangleSoup soup = parse_obj(kSquare + "f 1 2 3 4\n");
  EXPECT_EQ(soup.triangles, kQuad);
  ASSERT_EQ(soup.vertices.size(), 4U);
  EXPECT_EQ(soup.vertices[2], (Vec3{1, 1, 0}));
}

TEST(ReadObj, corners_may_name_texture_and_normal) {
  for (const char* face : {"f 1/1 2/2 3/3 4/4", "f 1//1 2//2 3//3 4//4", "f 1/1/1 2/2/2 3/3/3 4/4/4", "f 1/ 2/ 3/ 4/",
                           "f 1/-1/-1 2/-2 3 4//7"}) {
    EXPECT_EQ(parse_obj(kSquare + face).triangles, kQuad) << face;
  }
}

TEST(ReadObj, negative_indices_count_from_the_latest_vertex) {
  EXPECT_EQ(parse_obj(kSquare + "f -4 -3 -2 -1\nv 9 9 9\n").triangles, kQuad);
}

TEST(ReadObj, faces_may_come_before_their_vertices) {
  EXPECT_EQ(parse_obj("f 1 2 3 4\n" + kSquare).triangles, kQuad);
}

TEST(ReadObj, line_ends_of_every_system_count_alike) {
  const std::string unix_text = kSquare + "f 1 2 3 4\nf 1 x\n";
  for (const std::string& end : {std::string("\n"), std::string("\r\n"), std::string("\r")}) {
    std::string text;
    for (const char c : unix_text) text += c == '\n' ? end : std::string(1, c);
    EXPECT_ERROR(text, kObj, "line 6");
  }
}

TEST(ReadObj, backslashes_continue_lines) {
  EXPECT_EQ(parse_obj("v 0 0 \\\n 0\nv 1 0 0\r\nv 1 1 0\nv 0 \\\r\n1 0\nf 1 2\\\n 3 \\\n 4").triangles, kQuad);
}

TEST(ReadObj, a_comment_ending_in_a_backslash_does_not_swallow_the_next_line) {
  EXPECT_EQ(parse_obj("# C:\\models\\\n" + kSquare + "f 1 2 3 4").triangles, kQuad);
}

TEST(ReadObj, tabs_weights_colours_and_a_byte_order_mark_do_no_harm) {
  const TriangleSoup soup =
      parse_obj("\xEF\xBB\xBFv\t0 0 0 1.0\n  v 1 0 0 .5 .5 .5\nv 1 1 0 # top\nv 0 1 0\nf\t1 2  3 4 # all");
  EXPECT_EQ(soup.vertices.size(), 4U);
  EXPECT_EQ(soup.triangles, kQuad);
}

TEST(ReadObj, other_statements_are_passed_over) {
  const std::string others = "mtllib a.mtl\no thing\ng a b\ns off\nusemtl red\nvn 0 0 1\nvt 0 0\nl 1 2\np 1\nvp 1\n\n";
  EXPECT_EQ(parse_obj(others + kSquare + others + "f 1 2 3 4\n" + others).triangles, kQuad);
}

TEST(ReadObj, numbers_that_are_none_are_passed_on) {
  const TriangleSoup soup = parse_obj("v nan -inf 1e999\nv -1.#IND 1.#INF00 1.#QNAN\nv 1e-999 -0 +3E+2\nf 1 2 3");
  EXPECT_TRUE(std::isnan(soup.vertices[0].x));
  EXPECT_EQ(soup.vertices[0].y, -INFINITY);
  EXPECT_EQ(soup.vertices[0].z, INFINITY);
  EXPECT_TRUE(std::isnan(soup.vertices[1].x));
  EXPECT_EQ(soup.vertices[1].y, INFINITY);
  EXPECT_TRUE(std::isnan(soup.vertices[1].z));
  EXPECT_EQ(soup.vertices[2], (Vec3{0, -0.0F, 300}));
}

TEST(ReadObj, wild_indices_stay_wild) {
  const TriangleSoup soup =
      parse_obj(kSquare + "f 0 -5 5\nf 4294967297 99999999999999999999999 -99999999999999999999\n");
  ASSERT_EQ(soup.triangles.size(), 2U);
  for (const Triangle& triangle : soup.triangles) {
    for (const std::uint32_t corner : triangle) EXPECT_GE(corner, soup.vertices.size());
  }
}

TEST(ReadObj, polygons_of_less_than_three_corners_leave_nothing) {
  EXPECT_TRUE(parse_obj(kSquare + "f\nf 1\nf 1 2\n").triangles.empty());
}

TEST(ReadObj, a_point_cloud_has_no_triangles) {
  const TriangleSoup soup = parse_obj(kSquare);
  EXPECT_EQ(soup.vertices.size(), 4U);
  EXPECT_TRUE(soup.triangles.empty());
}

TEST(ReadObj, errors_name_file_line_and_word) {
  EXPECT_ERROR("v 1 2 3\nv 1 two 3\n", kObj, "sample, line 2: expected a number, found 'two'");
  EXPECT_ERROR("v 1 2\n", kObj, "line 1: expected a number, but the line ends");
  EXPECT_ERROR("v 1 2 3\n\nf 1 2 3;\n", kObj, "line 3: expected a corner");
  EXPECT_ERROR("v 1,5 2 3", kObj, "found '1,5'");
  EXPECT_ERROR("hello\nworld\n", kObj, "not an OBJ file");
}

std::string sample() {
  std::string text = "# strip\r\no strip\n";
  for (int i = 0; i < 12; ++i) {
    text += "v " + std::to_string(i * 0.37 - 1) + " " + std::to_string(i % 2) + "e-1 -" + std::to_string(i) + "\n";
  }
  text +=
      "vt 0 .5\no a b\nvn 0 0 1\nf 1/2/3 2//3 3\ng c\nusemtl d\nf 1/1/1 2/-1/-1 3/1\nf -12 -1 -2 -3\nf 5 \\\n 6 7 8 "
      "9\n";
  for (int i = 1; i <= 10; ++i) text += "f " + std::to_string(i) + " " + std::to_string(i + 1) + " 12\n";
  return text;
}

TEST(ReadObj, every_truncation_parses_or_throws) {
  expect_truncations_throw(sample(), kObj, 0);
}

TEST(ReadObj, a_hundred_thousand_flipped_bytes_are_survived) {
  expect_damage_survived(sample(), kObj, 100'000, 1);
}

}  // namespace
}  // namespace tetsoup
