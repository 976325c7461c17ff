// From a path to a soup: which format it is, what cannot be read, numbers, and the model collection.
#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "io/parse_number.h"
#include "soup_files.h"

namespace tetsoup {
namespace {

using namespace test;
namespace fs = std::filesystem;

class ReadSoup : public ::testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path write(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return folder_ / name;
  }
  static std::string error_at(const fs::path& path) {
    try {
      read_soup(path);
    } catch (const IoError& error) {
      EXPECT_TRUE(std::string_view(error.what()).starts_with(path.string())) << error.what();
      return error.what();
    }
    return "no error";
  }
  void expect_error(const fs::path& path, const std::string& text) const {
    EXPECT_NE(error_at(path).find(text), std::string::npos) << error_at(path);
  }

  fs::path folder_ = fs::temp_directory_path() / ("tetsoup_read_soup_" + std::to_string(std::random_device{}()));
};

const std::string kObj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
const std::string kOff = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
const std::string kStl =
    "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n";
const std::string kPly =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
    "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
const std::string kGltf = R"({"asset":{"version":"2.0"},"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],"bufferViews":[{"buffer":0,"byteLength":36}],
"buffers":[{"byteLength":36,"uri":"data:;base64,AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA"}]})";

TEST_F(ReadSoup, the_extension_tells_the_format_in_any_case) {
  for (const auto& [name, bytes] : {std::pair{"a.obj", kObj},
                                    {"a.OBJ", kObj},
                                    {"a.stl", kStl},
                                    {"a.STL", kStl},
                                    {"a.ply", kPly},
                                    {"a.off", kOff},
                                    {"a.gltf", kGltf}}) {
    const TriangleSoup soup = read_soup(write(name, bytes));
    EXPECT_EQ(soup.vertices.size(), 3U) << name;
    EXPECT_EQ(soup.triangles, (std::vector<Triangle>{{0, 1, 2}})) << name;
  }
}

TEST_F(ReadSoup, content_that_is_certain_overrules_the_extension) {
  for (const std::string& bytes : {kStl, kPly, kOff}) {
    for (const char* name : {"a.obj", "a.gltf", "noext", "a.xyz"}) {
      EXPECT_EQ(read_soup(write(name, bytes)).triangles.size(), 1U) << name << bytes.substr(0, 5);
    }
  }
}

TEST_F(ReadSoup, what_cannot_be_read_says_why) {
  expect_error(folder_ / "missing.obj", "No such file or directory");
  expect_error(folder_, "Is a directory");
  expect_error(write("empty.obj", ""), "is empty");
  expect_error("/dev/null", "is a device");
  expect_error(write("scene.foo", kObj),
               "unknown extension '.foo' and unknown content; known: .obj .stl .ply .off .gltf .glb .3mf .dae");
  expect_error(write("scene", kObj), "no extension and unknown content");
  const fs::path locked = write("locked.obj", kObj);
  fs::permissions(locked, fs::perms::none);
  if (!std::ifstream(locked)) expect_error(locked, "Permission denied");
}

TEST_F(ReadSoup, empty_bytes_are_an_error_in_every_format) {
  for (const SoupFormat format :
       {SoupFormat::Obj, SoupFormat::Stl, SoupFormat::Ply, SoupFormat::Off, SoupFormat::Gltf}) {
    EXPECT_ERROR("", format, "sample: is empty");
  }
}

TEST(ParseNumber, floats_equal_those_of_the_standard_library) {
  std::mt19937_64 random(11);
  for (int i = 0; i < 200'000; ++i) {
    char text[64];
    const int digits = static_cast<int>(random() % 21) + 1;
    const auto bits = static_cast<std::uint32_t>(random());
    const double value = i % 2 == 0 ? static_cast<double>(std::bit_cast<float>(bits)) : std::bit_cast<double>(random());
    std::snprintf(text, sizeof text, i % 3 == 0 ? "%.*f" : "%.*e", digits, i % 3 == 0 ? std::fmod(value, 1e6) : value);
    const char* at = text;
    double parsed = 0;
    ASSERT_TRUE(readers::parse_number(at, text + std::strlen(text), parsed)) << text;
    EXPECT_EQ(*at, '\0') << text;
    const double expected = std::strtod(text, nullptr);
    if (std::isnan(expected)) {
      EXPECT_TRUE(std::isnan(parsed)) << text;
    } else {
      EXPECT_EQ(static_cast<float>(parsed), static_cast<float>(expected)) << text;
    }
  }
}

TEST(ParseNumber, hard_cases_are_rounded_right) {
  for (const std::string& text :
       {std::string("1.00000005960464477539062500001"), std::string("1.000000059604644775390625"),
        std::string("16777217"), std::string("16777219.0000000000000000000001"), std::string("1e-45"),
        std::string("0.") + std::string(400, '0') + "1e400", "1" + std::string(400, '0') + "e-400",
        std::string("3.4028235677973366e38"), std::string(5000, '9'), std::string("1e99999999999999999999"),
        std::string("1e-99999999999999999999"), std::string("0e99999999999999999999")}) {
    const char* at = text.data();
    double parsed = 0;
    ASSERT_TRUE(readers::parse_number(at, at + text.size(), parsed));
    EXPECT_EQ(static_cast<float>(parsed), static_cast<float>(std::strtod(text.c_str(), nullptr))) << text;
  }
}

TEST_F(ReadSoup, what_is_not_read_says_what_to_do_instead) {
  const auto expect = [&](const std::string& name, const std::string& bytes, const char* what) {
    EXPECT_NE(error_at(write(name, bytes)).find(what), std::string::npos) << error_at(folder_ / name);
  };
  expect("a.STP", "x", "export it as STL or 3MF, for instance from FreeCAD");
  expect("part", "ISO-10303-21;\nHEADER;", "FreeCAD");
  expect("a.usda", "#usda 1.0", "is USD, of which no surface is read");
  expect("a.splat", "x", "holds points, not triangles");
  expect("a.fbx", "x", "Blender");
}

TEST(Models, all_load_with_the_triangle_counts_their_page_states) {
  const fs::path models = TETSOUP_MODELS_DIR;
  if (!fs::exists(models)) GTEST_SKIP() << "no model collection at " << models;
  const std::vector<std::pair<const char*, std::size_t>> counts = {
      {"one-triangle.stl", 1},   {"kenney-tile.obj", 30},       {"moebius.obj", 448},
      {"bonsai-tree.obj", 8128}, {"robot-knee-cad.stl", 17044}, {"bunny-69k.ply", 69451},
      {"dragon-47k.ply", 47794}, {"chandelier.obj", 133112},    {"dragon-202k.ply", 202520},
      {"palm-tree.obj", 43323},  {"armadillo-29k.obj", 29170},  {"towel-doubled.obj", 7524}};
  for (const auto& [name, count] : counts) EXPECT_EQ(read_soup(models / name).triangles.size(), count) << name;
  std::size_t files = 0;
  for (const auto& entry : fs::directory_iterator(models)) {
    if (entry.path().extension() == ".md") continue;
    ++files;
    const TriangleSoup soup = read_soup(entry.path());
    EXPECT_FALSE(soup.triangles.empty()) << entry.path();
    for (const Triangle& t : soup.triangles) {
      EXPECT_LT(std::max({t[0], t[1], t[2]}), soup.vertices.size()) << entry.path();
    }
  }
  EXPECT_EQ(files, 30U);
}

}  // namespace
}  // namespace tetsoup
