// PLY: three encodings, foreign properties and elements, and damage.
#include <bit>
#include <cmath>

#include "soup_files.h"

namespace tetsoup {
namespace {

using namespace test;

constexpr SoupFormat kPly = SoupFormat::Ply;
const std::vector<Triangle> kQuadAndTriangle = {{0, 1, 2}, {0, 2, 3}, {3, 1, 0}};

/// A quad and a triangle among foreign properties of every type, a list before the position, and foreign elements.
std::string rich_header(const std::string& format) {
  return "ply\nformat " + format +
         " 1.0\ncomment element vertex 99\nobj_info x\n"
         "element camera 2\nproperty double f\nproperty list uint16 short pixels\n"
         "element vertex 4\nproperty uchar red\nproperty list uchar float weights\nproperty float32 z\nproperty double "
         "x\n"
         "property int y\nproperty int8 t\nproperty uint s\n"
         "element empty 1000000000000\n"
         "element face 2\nproperty ushort material\nproperty list uint8 int vertex_indices\nproperty list char uchar "
         "uv\n"
         "element tail 1\nproperty uint32 n\nend_header\n";
}

std::string rich_ascii() {
  std::string text = rich_header("ascii") + "0.5 2 -1 1\n1e3 0\n";
  const int xy[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (const auto& p : xy)
    text += "255 2 0.5 0.5 -7.5 " + std::to_string(p[0]) + " " + std::to_string(p[1]) + " -1 9\n";
  return text + "1 4 0 1 2 3 0\n2 3 3 1 0 2 8 9\n77\n";
}

std::string rich_binary(bool big) {
  const auto n = [big](auto value) { return raw(value, big); };
  std::string bytes = rich_header(big ? "binary_big_endian" : "binary_little_endian");
  bytes += n(0.5) + n(std::uint16_t{2}) + n(std::int16_t{-1}) + n(std::int16_t{1}) + n(1e3) + n(std::uint16_t{0});
  const int xy[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (const auto& p : xy) {
    bytes += n(std::uint8_t{255}) + n(std::uint8_t{2}) + n(0.5F) + n(0.5F) + n(-7.5F) + n(static_cast<double>(p[0])) +
             n(std::int32_t{p[1]}) + n(std::int8_t{-1}) + n(std::uint32_t{9});
  }
  bytes += n(std::uint16_t{1}) + n(std::uint8_t{4});
  for (std::int32_t i = 0; i < 4; ++i) bytes += n(i);
  bytes += n(std::int8_t{0}) + n(std::uint16_t{2}) + n(std::uint8_t{3});
  for (const std::int32_t i : {3, 1, 0}) bytes += n(i);
  return bytes + n(std::int8_t{2}) + n(std::uint8_t{8}) + n(std::uint8_t{9}) + n(std::uint32_t{77});
}

TEST(ReadPly, foreign_properties_and_elements_are_passed_over_in_all_encodings) {
  for (const std::string& bytes : {rich_ascii(), rich_binary(false), rich_binary(true)}) {
    const TriangleSoup soup = parse(bytes, kPly);
    EXPECT_EQ(soup.triangles, kQuadAndTriangle);
    EXPECT_EQ(soup.vertices, (std::vector<Vec3>{{0, 0, -7.5F}, {1, 0, -7.5F}, {1, 1, -7.5F}, {0, 1, -7.5F}}));
  }
}

std::string points(const std::string& format, int count) {
  return "ply\nformat " + format + " 1.0\nelement vertex " + std::to_string(count) +
         "\nproperty float x\nproperty float y\nproperty float z\n";
}

TEST(ReadPly, a_point_cloud_has_no_triangles) {
  EXPECT_EQ(parse(points("ascii", 1) + "end_header\n1 2 3", kPly).vertices.size(), 1U);
}

TEST(ReadPly, numbers_behind_a_record_that_the_header_does_not_tell_of_are_passed_over) {
  const std::string faces = "element face 2\nproperty list uchar int vertex_indices\n";
  const TriangleSoup soup = parse(
      points("ascii", 4) + faces + "end_header\n0 0 0 9\n1 0 0 9\n\n1 1 0 9\n0 1 0 9\n3 0 1 2 9 1 1 1\n3 0 2 3 7\n",
      kPly);
  EXPECT_EQ(soup.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(soup.vertices[3], (Vec3{0, 1, 0}));
}

TEST(ReadPly, records_need_no_line_of_their_own) {
  const std::string faces = "element face 2\nproperty list uchar int vertex_indices\n";
  for (const char* body : {"0 0 0 1 0 0 1 1 0 0 1 0\n3 0 1 2 3 0 2 3\n", "0 0\n0 1 0 0 1\n1 0 0 1 0 3 0 1 2\n3 0 2 3"})
    EXPECT_EQ(parse(points("ascii", 4) + faces + "end_header\n" + body, kPly).triangles,
              (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}))
        << body;
}

TEST(ReadPly, a_remark_without_the_word_comment_is_one_but_a_declaration_misspelt_is_not) {
  const std::string rest =
      "element vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n1 2 3\n";
  EXPECT_EQ(parse("ply\nformat ascii 1.0\nCreated by hand\n" + rest, kPly).vertices.size(), 1U);
  EXPECT_ERROR("ply\nformat ascii 1.0\n" + rest.substr(0, 17) + "propery float w\n" + rest.substr(17), kPly,
               "line 4: expected a header line of a PLY file, found 'propery'");
  EXPECT_ERROR("ply\nformat ascii 1.0\nelemnt vertex 1\n" + rest, kPly, "line 3: expected a header line");
}

TEST(ReadPly, numbers_that_are_none_and_wild_indices_are_passed_on) {
  const TriangleSoup soup = parse(points("ascii", 1) +
                                      "element face 3\nproperty list uchar double vertex_index\nend_header\nnan inf 3\n"
                                      "3 -1 1 4294967296\n3 0.5 nan 1e300\n2 0 0\n",
                                  kPly);
  EXPECT_TRUE(std::isnan(soup.vertices[0].x));
  ASSERT_EQ(soup.triangles.size(), 2U);
  for (const Triangle& triangle : soup.triangles) {
    for (const std::uint32_t corner : triangle) EXPECT_GE(corner, 1U);
  }
}

TEST(ReadPly, strips_alternate_and_end_at_negative_indices) {
  const TriangleSoup soup = parse(points("ascii", 1) +
                                      "element tristrips 1\nproperty list int int vertex_indices\nend_header\n0 0 0\n"
                                      "9 0 1 2 3 -1 4 5 6 7\n",
                                  kPly);
  EXPECT_EQ(soup.triangles, (std::vector<Triangle>{{0, 1, 2}, {2, 1, 3}, {4, 5, 6}, {6, 5, 7}}));
}

TEST(ReadPly, line_ends_of_every_system_lead_to_the_same_first_binary_byte) {
  // The first byte of the body is the line feed that a lone carriage return must not swallow.
  const float x = std::bit_cast<float>(std::uint32_t{0x0000000a});
  const std::string header = points("binary_little_endian", 1) + "end_header\n";
  for (const std::string& end : {std::string("\n"), std::string("\r\n"), std::string("\r")}) {
    std::string bytes;
    for (const char c : header) bytes += c == '\n' ? end : std::string(1, c);
    const TriangleSoup soup = parse(bytes + raw(x) + raw(2.0F) + raw(3.0F), kPly);
    EXPECT_EQ(soup.vertices.at(0), (Vec3{x, 2, 3})) << end.size();
  }
}

TEST(ReadPly, header_errors_name_the_line) {
  EXPECT_ERROR("plyx\n", kPly, "sample, line 1: expected 'ply'");
  EXPECT_ERROR("ply\nformat ascii2 1.0\n", kPly, "line 2: expected ascii");
  EXPECT_ERROR("ply\nformat ascii 1.0\nelement vertex -3\n", kPly, "line 3: the number of 'vertex' is negative");
  EXPECT_ERROR("ply\nformat ascii 1.0\nproperty float x\n", kPly, "line 3: a property before the first element");
  EXPECT_ERROR(points("ascii", 1) + "property string s\n", kPly, "line 7: expected a type");
  EXPECT_ERROR(points("ascii", 1), kPly, "the file ends before 'end_header'");
  EXPECT_ERROR("ply\nend_header\n", kPly, "without a format line");
  EXPECT_ERROR("ply\nformat ascii 1.0\nend_header\n", kPly, "without 'element vertex'");
  EXPECT_ERROR("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n", kPly,
               "line 3: the vertices have");
  EXPECT_ERROR(points("ascii", 0) + "element face 1\nproperty int a\nend_header\n0\n", kPly,
               "line 7: 'face' has no list property vertex_indices");
}

TEST(ReadPly, body_errors_name_the_line_of_text_and_the_byte_of_binary) {
  EXPECT_ERROR(points("ascii", 2) + "end_header\n1 2 3\n1 2 z\n", kPly, "line 9: expected a number, found 'z'");
  const std::string header =
      points("binary_big_endian", 0) + "element face 1\nproperty list int int vertex_indices\nend_header\n";
  EXPECT_ERROR(header + raw(-1, true), kPly,
               "byte " + std::to_string(header.size() + 4) + ": a list of negative length");
}

TEST(ReadPly, huge_counts_take_no_memory) {
  const std::string faces = "element face 1\nproperty list int int vertex_indices\nend_header\n";
  largest_allocation = 0;
  for (const char* format : {"ascii", "binary_little_endian"}) {
    EXPECT_ERROR(points(format, 2'000'000'000) + "end_header\n1 2 3\n", kPly, "promises 2000000000 times 'vertex'");
  }
  EXPECT_ERROR(points("ascii", 0) + faces + "2000000000 1 2 3", kPly, "the file ends");
  EXPECT_ERROR(points("binary_little_endian", 0) + faces + raw(2'000'000'000), kPly, "reaches beyond the file's end");
  EXPECT_LT(largest_allocation, 2000U);
}

TEST(ReadPly, every_truncation_throws) {
  const std::string text = rich_ascii();
  expect_truncations_throw(text, kPly, text.size() - 2);
  for (const bool big : {false, true}) expect_truncations_throw(rich_binary(big), kPly, rich_binary(big).size());
}

TEST(ReadPly, a_hundred_thousand_flipped_bytes_are_survived) {
  expect_damage_survived(rich_ascii(), kPly, 34'000, 6);
  expect_damage_survived(rich_binary(false), kPly, 33'000, 7);
  expect_damage_survived(rich_binary(true), kPly, 33'000, 8);
}

}  // namespace
}  // namespace tetsoup
