// glTF and GLB: transforms, modes, accessors nobody may trust, and damage.
#include <cmath>
#include <filesystem>
#include <fstream>

#include "soup_files.h"

namespace tetsoup {
namespace {

using namespace test;
namespace fs = std::filesystem;

constexpr SoupFormat kGltf = SoupFormat::Gltf;

/// Buffer: 4 float positions of a square (48 bytes), 4 normalised short positions at stride 8 (32), 6 ushort indices
/// (12), 1 ushort sparse index (2) and padding (2), one float position (12): 108 bytes.
std::string buffer_bytes() {
  const int xy[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  std::string bytes;
  for (const auto& p : xy) bytes += raw(static_cast<float>(p[0])) + raw(static_cast<float>(p[1])) + raw(0.0F);
  for (const auto& p : xy) {
    for (const int c : {p[0], p[1], -1, 0}) bytes += raw(static_cast<std::int16_t>(32767 * c));
  }
  for (const int i : {0, 1, 2, 0, 2, 3}) bytes += raw(static_cast<std::uint16_t>(i));
  return bytes + raw(std::uint16_t{3}) + raw(std::uint16_t{0}) + raw(5.0F) + raw(6.0F) + raw(7.0F);
}

const std::string kViews =
    R"("bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":32,"byteStride":8},
{"buffer":0,"byteOffset":80,"byteLength":12},{"buffer":0,"byteOffset":92,"byteLength":2},{"buffer":0,"byteOffset":96,"byteLength":12}])";
const std::string kAccessors = R"("accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},
{"bufferView":1,"componentType":5122,"normalized":true,"count":4,"type":"VEC3"},{"bufferView":2,"componentType":5123,"count":6,"type":"SCALAR"},
{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","sparse":{"count":1,"indices":{"bufferView":3,"componentType":5123},"values":{"bufferView":4}}}])";
const std::string kOneNode = R"("scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}])";

std::string mesh(const std::string& primitive) {
  return R"("meshes":[{"primitives":[)" + primitive + "]}]";
}
const std::string kSquare = R"({"attributes":{"POSITION":0},"indices":2})";

std::string glb(const std::string& nodes, const std::string& meshes, const std::string& accessors = kAccessors,
                const std::string& extra = "") {
  std::string text = R"({"asset":{"version":"2.0"},)" + extra + nodes + "," + meshes + "," + accessors + "," + kViews +
                     R"(,"buffers":[{"byteLength":108}]})";
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const std::string binary = buffer_bytes();
  const auto u32 = [](std::size_t value) { return raw(static_cast<std::uint32_t>(value)); };
  return "glTF" + u32(2) + u32(28 + text.size() + binary.size()) + u32(text.size()) + "JSON" + text +
         u32(binary.size()) + std::string("BIN\0", 4) + binary;
}

std::string base64(const std::string& bytes) {
  static constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {  // a multiple of 3 bytes
    const auto byte = [&](std::size_t k) { return static_cast<unsigned>(static_cast<unsigned char>(bytes[i + k])); };
    const unsigned bits = byte(0) << 16 | byte(1) << 8 | byte(2);
    for (const int shift : {18, 12, 6, 0}) text += kDigits[bits >> shift & 63];
  }
  return text;
}

std::string gltf(const std::string& uri) {
  return "{\n\"asset\":{\"version\":\"2.0\"},\n" + kOneNode + "," + mesh(kSquare) + "," + kAccessors + "," + kViews +
         R"(,"buffers":[{"byteLength":108,"uri":")" + uri + "\"}]}\n";
}
std::string embedded_gltf() {
  return gltf("data:application/octet-stream;base64," + base64(buffer_bytes()));
}

TriangleSoup parse_gltf(const std::string& bytes) {
  return parse(bytes, kGltf);
}
const std::vector<Triangle> kTriangles = {{0, 1, 2}, {0, 2, 3}};
const std::vector<Vec3> kCorners = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};

TEST(ReadGltf, binary_and_embedded_text_say_the_same) {
  for (const std::string& bytes : {glb(kOneNode, mesh(kSquare)), embedded_gltf()}) {
    const TriangleSoup soup = parse_gltf(bytes);
    EXPECT_EQ(soup.vertices, kCorners);
    EXPECT_EQ(soup.triangles, kTriangles);
  }
}

TEST(ReadGltf, transforms_multiply_down_the_hierarchy_and_meshes_repeat) {
  const std::string nodes =
      R"("nodes":[{"translation":[10,0,0],"children":[1,2]},{"mesh":0,"scale":[2,3,1],"rotation":[0,0,0.70710678,0.70710678]},
      {"mesh":0,"matrix":[1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,5,1]}])";
  const TriangleSoup soup = parse_gltf(glb(nodes, mesh(kSquare)));
  ASSERT_EQ(soup.vertices.size(), 8U);
  EXPECT_NEAR(soup.vertices[2].x, 10 - 3, 1e-5);
  EXPECT_NEAR(soup.vertices[2].y, 2, 1e-5);
  EXPECT_EQ(soup.vertices[6], (Vec3{11, 1, 5}));
  EXPECT_EQ(soup.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}}));
}

TEST(ReadGltf, only_the_chosen_scene_is_read) {
  const std::string nodes =
      R"("scene":1,"scenes":[{"nodes":[0]},{"nodes":[1]}],"nodes":[{"mesh":0},{"translation":[0,0,9],"mesh":0}])";
  const TriangleSoup soup = parse_gltf(glb(nodes, mesh(kSquare)));
  ASSERT_EQ(soup.vertices.size(), 4U);
  EXPECT_EQ(soup.vertices[0].z, 9);
}

TEST(ReadGltf, all_triangle_modes_work_with_and_without_indices) {
  const auto read = [](const std::string& primitive) { return parse_gltf(glb(kOneNode, mesh(primitive))).triangles; };
  EXPECT_EQ(read(R"({"attributes":{"POSITION":0}})"), (std::vector<Triangle>{{0, 1, 2}}));
  EXPECT_EQ(read(R"({"attributes":{"POSITION":0},"mode":5})"), (std::vector<Triangle>{{0, 1, 2}, {2, 1, 3}}));
  EXPECT_EQ(read(R"({"attributes":{"POSITION":0},"mode":6})"), kTriangles);
  EXPECT_EQ(read(R"({"attributes":{"POSITION":0},"mode":6,"indices":2})").size(), 4U);
  EXPECT_TRUE(read(R"({"attributes":{"POSITION":0},"mode":1})").empty());
  EXPECT_ERROR(glb(kOneNode, mesh(R"({"attributes":{"POSITION":0},"mode":7})")), kGltf,
               "mesh 0, primitive 0: is of an unknown mode");
}

TEST(ReadGltf, normalised_strided_and_sparse_accessors_are_resolved) {
  const auto read = [](int accessor) {
    return parse_gltf(glb(kOneNode, mesh(R"({"attributes":{"POSITION":)" + std::to_string(accessor) + "}}"))).vertices;
  };
  EXPECT_EQ(read(1), (std::vector<Vec3>{{0, 0, -1}, {1, 0, -1}, {1, 1, -1}, {0, 1, -1}}));
  EXPECT_EQ(read(3), (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {5, 6, 7}}));
}

TEST(ReadGltf, an_index_beyond_its_primitive_does_not_reach_the_next) {
  const std::string accessors =
      R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},{},{"bufferView":2,"componentType":5123,"count":6,"type":"SCALAR"}])";
  std::string fixed = accessors;
  fixed.replace(fixed.find("{}"), 2, R"({"componentType":5126,"count":3,"type":"VEC3"})");
  const TriangleSoup soup = parse_gltf(glb(kOneNode, mesh(kSquare + R"(,{"attributes":{"POSITION":1}})"), fixed));
  EXPECT_EQ(soup.vertices.size(), 6U);
  EXPECT_EQ(soup.triangles[1], (Triangle{0, 2, 0xffffffff}));
}

TEST(ReadGltf, cycles_and_shared_children_are_errors_not_hangs) {
  EXPECT_ERROR(glb(R"("scenes":[{"nodes":[0]}],"nodes":[{"children":[1]},{"children":[0]}])", mesh(kSquare)), kGltf,
               "node 0: has two parents or is its own ancestor");
  EXPECT_ERROR(glb(R"("nodes":[{"children":[1,1],"mesh":0},{"mesh":0}])", mesh(kSquare)), kGltf,
               "node 1: has two parents");
  EXPECT_ERROR(glb(R"("nodes":[{"mesh":4}])", mesh(kSquare)), kGltf, "node 0: shows a mesh that does not exist");
}

TEST(ReadGltf, accessors_beyond_their_bytes_are_refused) {
  const auto error = [](const std::string& accessor) {
    return error_of(glb(kOneNode, mesh(R"({"attributes":{"POSITION":0}})"), R"("accessors":[)" + accessor + "]"),
                    kGltf);
  };
  EXPECT_NE(error(R"({"bufferView":0,"componentType":5126,"count":5,"type":"VEC3"})")
                .find("promises 5 elements, its bufferView 0 has room for 4"),
            std::string::npos);
  EXPECT_NE(
      error(R"({"bufferView":0,"byteOffset":99,"componentType":5126,"count":1,"type":"VEC3"})").find("room for 0"),
      std::string::npos);
  EXPECT_NE(error(R"({"bufferView":9,"componentType":5126,"count":1,"type":"VEC3"})")
                .find("bufferView 9, which does not exist"),
            std::string::npos);
  EXPECT_NE(
      error(R"({"componentType":5126,"count":4000000000000,"type":"VEC3"})").find("more zeros than the file has bytes"),
      std::string::npos);
  EXPECT_NE(
      error(R"({"bufferView":0,"componentType":5126,"count":18446744073709551615,"type":"VEC3"})").find("promises"),
      std::string::npos);
  EXPECT_NE(error(R"({"bufferView":0,"componentType":5126,"count":4,"type":"VEC2"})").find("another kind"),
            std::string::npos);
}

TEST(ReadGltf, instances_may_not_multiply_without_limit) {
  // 3000 indices from a few bytes, 4000 nodes: 12 million corners.
  std::string text =
      R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":3012,"uri":"data:;base64,)" + std::string(4016, 'A') +
      R"("}],"bufferViews":[{"buffer":0,"byteLength":12},{"buffer":0,"byteOffset":12,"byteLength":3000}],"accessors":[{"bufferView":0,"componentType":5126,"count":1,"type":"VEC3"},{"bufferView":1,"componentType":5121,"count":3000,"type":"SCALAR"}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"mode":5}]}],"nodes":[{"mesh":0})";
  for (int i = 1; i < 4000; ++i) text += R"(,{"mesh":0})";
  EXPECT_ERROR(text + "]}", kGltf, "its instances add up to more than");
}

TEST(ReadGltf, what_is_not_supported_says_so) {
  const auto with = [](const std::string& extension) { return glb(kOneNode, mesh(kSquare), kAccessors, extension); };
  EXPECT_EQ(parse_gltf(with(R"("extensionsRequired":["KHR_texture_transform"],)")).triangles, kTriangles);
  EXPECT_ERROR(R"({"asset":{"version":"1.0"}})", kGltf, "only glTF 2 is supported, not 1.0");
}

TEST(ReadGltf, a_required_extension_is_refused_only_where_it_may_change_geometry) {
  const std::string required = R"("extensionsRequired":["ACME_shapes","ACME_shine"],)";
  const std::string shine = R"("materials":[{"extensions":{"ACME_shine":{}}}],)";
  EXPECT_EQ(parse_gltf(glb(kOneNode, mesh(kSquare), kAccessors, required + shine)).triangles, kTriangles);
  const std::string shaped = R"({"attributes":{"POSITION":0},"extensions":{"ACME_shapes":{}}})";
  EXPECT_ERROR(glb(kOneNode, mesh(shaped), kAccessors, required + shine), kGltf,
               "uses ACME_shapes, which is not supported");
  EXPECT_EQ(parse_gltf(glb(kOneNode, mesh(shaped))).triangles.size(), 1U);
}

TEST(ReadGltf, errors_name_the_line_of_text_and_the_byte_of_binary) {
  EXPECT_ERROR("{\n\"asset\":\n}", kGltf, "sample, line 3: not valid JSON");
  std::string bytes = glb(kOneNode, mesh(kSquare));
  bytes[20] = '?';
  EXPECT_ERROR(bytes, kGltf, "sample, byte 20: not valid JSON");
  EXPECT_ERROR(std::string(1000, '['), kGltf, "nested too deeply");
  EXPECT_ERROR("[1, 2]", kGltf, "not glTF");
}

TEST(ReadGltf, a_chunk_that_ends_beyond_the_file_is_refused) {
  std::string bytes = glb(kOneNode, mesh(kSquare));
  bytes[bytes.size() - 108 - 8] = 116;  // the binary chunk says 8 bytes more than there are
  EXPECT_ERROR(bytes, kGltf, "a chunk reaches beyond the file's end");
}

/// A folder of its own that goes away again.
struct Folder {
  fs::path path = fs::temp_directory_path() / ("tetsoup_read_gltf_" + std::to_string(std::random_device{}()));
  Folder() { fs::create_directories(path / "parts"); }
  ~Folder() { fs::remove_all(path); }
  fs::path write(const std::string& name, const std::string& bytes) const {
    std::ofstream(path / name, std::ios::binary) << bytes;
    return path / name;
  }
};

TEST(ReadGltf, external_buffers_are_followed_below_the_files_folder_only) {
  const Folder folder;
  folder.write("parts/a b.bin", buffer_bytes() + "more");
  EXPECT_EQ(read_soup(folder.write("good.gltf", gltf("parts/a%20b.bin"))).triangles, kTriangles);
  EXPECT_ERROR(gltf("parts/a%20b.bin"), kGltf, "buffer 0: lies in another file, which is not followed from memory");
  const auto error = [&](const std::string& uri) {
    try {
      read_soup(folder.write("parts/bad.gltf", gltf(uri)));
    } catch (const IoError& e) {
      return std::string(e.what());
    }
    return std::string("no error");
  };
  folder.write("outside.bin", buffer_bytes());
  fs::create_symlink(folder.path / "outside.bin", folder.path / "parts/link.bin");
  EXPECT_NE(error("../outside.bin").find("lies outside the file's folder"), std::string::npos);
  EXPECT_NE(error("%2e%2e/outside.bin").find("lies outside the file's folder"), std::string::npos);
  EXPECT_NE(error("link.bin").find("lies outside the file's folder"), std::string::npos);
  EXPECT_NE(error("/etc/hostname").find("is not a path relative to the file"), std::string::npos);
  EXPECT_NE(error("http://example.org/a.bin").find("is not a path relative"), std::string::npos);
  EXPECT_NE(error("missing.bin").find("'missing.bin': No such file"), std::string::npos);
  folder.write("parts/short.bin", "1234");
  EXPECT_NE(error("short.bin").find("buffer 0: promises 108 bytes, there are 4"), std::string::npos);
}

/// Two nodes show a mesh whose primitives share their vertices; the first also has texture coordinates and normals.
std::string detailed_glb(const std::string& texcoords = "3") {
  const std::string nodes =
      R"("nodes":[{"name":"door","mesh":0,"scale":[2,1,-1]},{"mesh":0}],"materials":[{},{"name":"red"}])";
  const std::string meshes = R"("meshes":[{"name":"panel","primitives":[
{"attributes":{"POSITION":0,"NORMAL":0,"TEXCOORD_0":)" +
                             texcoords + R"(},"indices":2,"material":1},
{"attributes":{"POSITION":0},"mode":5,"material":7}]}])";
  std::string accessors = kAccessors;
  accessors.replace(accessors.rfind(R"({"bufferView":0)"), std::string::npos,
                    R"({"bufferView":0,"componentType":5126,"count":4,"type":"VEC2"}])");
  return glb(nodes, meshes, accessors);
}

TEST(ReadGltf, render_meshes_keep_texture_coordinates_normals_and_names) {
  const RenderMesh mesh = parse_mesh(detailed_glb(), kGltf);
  EXPECT_EQ(mesh.face_sizes, std::vector<std::uint32_t>(8, 3));
  EXPECT_EQ(mesh.parts, (std::vector<RenderMesh::Part>{
                            {"door", "", "red"}, {"door", "", ""}, {"panel", "", "red"}, {"panel", "", ""}}));
  EXPECT_EQ(mesh.face_parts, (std::vector<std::uint32_t>{0, 0, 1, 1, 2, 2, 3, 3}));
  const std::uint32_t none = RenderMesh::kNone;
  EXPECT_EQ(mesh.corner_texcoords, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3, none, none, none, none, none, none,  //
                                                               4, 5, 6, 4, 6, 7, none, none, none, none, none, none}));
  EXPECT_EQ(mesh.corner_normals, mesh.corner_texcoords);
  // v runs upwards.
  EXPECT_EQ(std::vector(mesh.texcoords.begin(), mesh.texcoords.begin() + 4),
            (std::vector<Vec2>{{0, 1}, {0, 0}, {0, 1}, {1, 0}}));
  // The plane x + y = 0, stretched along x, is x / 2 + y = 0.
  EXPECT_NEAR(mesh.normals[2].x, 1 / std::sqrt(5.0), 1e-6);
  EXPECT_NEAR(mesh.normals[2].y, 2 / std::sqrt(5.0), 1e-6);
  EXPECT_EQ(mesh.normals[1], (Vec3{1, 0, 0}));
  EXPECT_EQ(mesh.normals[0], (Vec3{0, 0, 0}));
}

TEST(ReadGltf, texture_coordinates_that_cannot_be_read_are_left_out) {
  for (const char* accessor : {"0", "2", "9", "-1"}) {
    const RenderMesh mesh = parse_mesh(detailed_glb(accessor), kGltf);
    EXPECT_EQ(mesh.face_sizes.size(), 8U);
    EXPECT_TRUE(mesh.texcoords.empty() && mesh.corner_texcoords.empty());
    EXPECT_FALSE(mesh.corner_normals.empty());
  }
}

TEST(ReadGltf, every_truncation_throws) {
  const std::string binary = glb(kOneNode, mesh(kSquare));
  expect_truncations_throw(binary, kGltf, binary.size());
  expect_truncations_throw(embedded_gltf(), kGltf, embedded_gltf().size() - 1);
  expect_truncations_throw(detailed_glb(), kGltf, detailed_glb().size());
}

TEST(ReadGltf, a_hundred_thousand_flipped_bytes_are_survived) {
  const std::string all =
      mesh(kSquare + R"(,{"attributes":{"POSITION":1},"mode":5},{"attributes":{"POSITION":3},"mode":6})");
  expect_damage_survived(glb(kOneNode, all), kGltf, 40'000, 9);
  expect_damage_survived(detailed_glb(), kGltf, 20'000, 11);
  expect_damage_survived(embedded_gltf(), kGltf, 40'000, 10);
}

}  // namespace
}  // namespace tetsoup
