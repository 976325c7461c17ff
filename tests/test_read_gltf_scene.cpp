// What moves the vertices of a glTF file: joints of skins, instances of a node; and packed geometry.
#include "gltf_files.h"

#ifdef TETSOUP_WITH_MESHOPT
#include <meshoptimizer.h>
#endif
#ifdef TETSOUP_WITH_DRACO
#include <draco/compression/expert_encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#endif

namespace tetsoup {
namespace {

using namespace test;

constexpr SoupFormat kGltf = SoupFormat::Gltf;
const std::vector<float> kTriangle = {0, 0, 0, 100, 0, 0, 0, 100, 0};

std::vector<float> scaling(float s, float x) {
  return {s, 0, 0, 0, 0, s, 0, 0, 0, 0, s, 0, x, 0, 0, 1};
}

/// A triangle on two joints: the first vertex hangs on one, the second on the other, the third on both.
std::string skinned(const std::string& weights_of_third = "", bool wild = false) {
  GltfFile file;
  file.add_floats(kTriangle, "VEC3", 3);
  std::string joints;
  for (const int joint : {0, 1, 0, 0, 1, 0, 0, 0, 0, 1, wild ? 7 : 0, 0}) joints += static_cast<char>(joint);
  file.add_accessor(file.add_view(joints), 5121, "VEC4", 3);
  std::vector<float> weights = {1, 0, 0, 0, 1, 0, 0, 0, .5F, .5F, 0, 0};
  if (!weights_of_third.empty()) weights[8] = weights[9] = std::stof(weights_of_third);
  if (wild) weights[10] = .5F;
  file.add_floats(weights, "VEC4", 4);
  std::vector<float> inverses = scaling(.01F, 0);
  const std::vector<float> second = scaling(.01F, 1);
  inverses.insert(inverses.end(), second.begin(), second.end());
  file.add_floats(inverses, "MAT4", 16);
  file.add_floats({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", 3);
  return file.text(
      R"("scene":0,"scenes":[{"nodes":[0,1]}],"nodes":[{"mesh":0,"skin":0,"scale":[50,50,50]},
{"translation":[0,0,3],"children":[2,3]},{},{"translation":[0,2,0]}],
"skins":[{"joints":[2,3],"inverseBindMatrices":3}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":2,"NORMAL":4}}]}])");
}

TEST(ReadGltfScene, a_skin_stands_where_its_joints_are_and_its_node_does_not_move_it) {
  for (const char* weights : {"0.5", "0.25"}) {  // relative to their sum
    const TriangleSoup soup = parse(skinned(weights), kGltf);
    ASSERT_EQ(soup.vertices.size(), 3U);
    EXPECT_EQ(soup.vertices[0], (Vec3{0, 0, 3}));
    EXPECT_EQ(soup.vertices[1], (Vec3{2, 2, 3}));
    EXPECT_EQ(soup.vertices[2], (Vec3{.5F, 2, 3}));
  }
  EXPECT_EQ(parse_mesh(skinned(), kGltf).normals, (std::vector<Vec3>{{0, 0, 1}, {0, 0, 1}, {0, 0, 1}}));
}

TEST(ReadGltfScene, a_vertex_without_a_share_stays_with_the_node) {
  EXPECT_EQ(parse(skinned("0"), kGltf).vertices[2], (Vec3{0, 5000, 0}));
}

TEST(ReadGltfScene, joints_that_do_not_exist_are_errors) {
  EXPECT_ERROR(skinned("", true), kGltf, "a vertex hangs on a joint that its skin does not have");
  std::string text = skinned();
  text.replace(text.find(R"("joints":[2,3])"), 14, R"("joints":[2,9])");
  EXPECT_ERROR(text, kGltf, "node 9: does not exist");
  text = skinned();
  text.replace(text.find(R"("joints":[2,3])"), 14, R"("joints":[2,3,1])");
  EXPECT_ERROR(text, kGltf, "skin 0: has fewer inverse bind matrices than joints");
  text = skinned();
  text.replace(text.find(R"("skin":0)"), 8, R"("skin":4)");
  EXPECT_ERROR(text, kGltf, "skin 4: does not exist");
  text = skinned();
  text.replace(text.find(R"({},{"tr)"), 2, R"({"children":[1]})");
  text.replace(text.find(R"("nodes":[0,1])"), 13, R"("nodes":[0])");
  EXPECT_ERROR(text, kGltf, "is its own ancestor");
}

TEST(ReadGltfScene, instances_of_a_node_stand_within_it) {
  GltfFile file;
  file.add_floats(kTriangle, "VEC3", 3);
  file.add_floats({0, 0, 0, 7, 0, 0}, "VEC3", 3);
  file.add_floats({1, 1, 1, .01F, .02F, 1}, "VEC3", 3);
  const std::string rest = R"("nodes":[{"mesh":0,"translation":[0,0,4],
"extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":1,"SCALE":2}}}}],
"extensionsRequired":["EXT_mesh_gpu_instancing"],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}])";
  const TriangleSoup soup = parse(file.text(rest), kGltf);
  ASSERT_EQ(soup.vertices.size(), 6U);
  EXPECT_EQ(soup.vertices[1], (Vec3{100, 0, 4}));
  EXPECT_EQ(soup.vertices[4], (Vec3{8, 0, 4}));
  EXPECT_EQ(soup.vertices[5], (Vec3{7, 2, 4}));
  file.add_floats({1, 1, 1}, "VEC3", 3);
  std::string uneven = rest;
  uneven.replace(uneven.find(R"("SCALE":2)"), 9, R"("SCALE":3)");
  EXPECT_ERROR(file.text(uneven), kGltf, "node 0: its instances have different numbers of places, turns and scales");
}

TEST(ReadGltfScene, every_damage_of_a_skin_is_survived) {
  expect_damage_survived(skinned(), kGltf, 20'000, 11);
}

constexpr const char* kDraco =
    R"("extensions":{"KHR_draco_mesh_compression":{"bufferView":0,"attributes":{"POSITION":0}}})";

/// A cube by Draco if `bytes` are its; accessors without bytes of their own, as exporters write them.
std::string draco_file(const std::string& bytes) {
  GltfFile file;
  file.add_view(bytes);
  file.add_accessor(-1, 5126, "VEC3", 24);
  file.add_accessor(-1, 5123, "SCALAR", 36);
  return file.text(R"("extensionsUsed":["KHR_draco_mesh_compression"],"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,)" +
                   std::string(kDraco) + "}]}]");
}

TEST(ReadGltfScene, where_draco_has_a_copy_beside_it_the_copy_is_read) {
  GltfFile file;
  file.add_floats(kTriangle, "VEC3", 3);
  EXPECT_EQ(parse(file.text(R"("nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},)" +
                            std::string(kDraco) + "}]}]"),
                  kGltf)
                .triangles.size(),
            1U);
}

#ifdef TETSOUP_WITH_DRACO

/// Two triangles of a square by Draco's own encoder, positions to 14 bits.
std::string draco_square() {
  const float corners[2][3][3] = {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, {{0, 0, 0}, {1, 1, 0}, {0, 1, 0}}};
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(2);
  const int positions = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  for (unsigned f = 0; f < 2; ++f) {
    builder.SetAttributeValuesForFace(positions, draco::FaceIndex(f), corners[f][0], corners[f][1], corners[f][2]);
  }
  const auto mesh = builder.Finalize();
  draco::ExpertEncoder encoder(*mesh);
  encoder.SetAttributeQuantization(0, 14);
  draco::EncoderBuffer buffer;
  EXPECT_TRUE(encoder.EncodeToBuffer(&buffer).ok());
  return {buffer.data(), buffer.size()};
}

TEST(ReadGltfScene, draco_gives_the_surface_that_was_packed) {
  const TriangleSoup soup = parse(draco_file(draco_square()), kGltf);
  ASSERT_EQ(soup.vertices.size(), 4U);
  ASSERT_EQ(soup.triangles.size(), 2U);
  double area = 0;
  for (const Triangle& t : soup.triangles) {
    const Vec3 a = soup.vertices.at(t[0]), b = soup.vertices.at(t[1]), c = soup.vertices.at(t[2]);
    area += static_cast<double>((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)) / 2;
  }
  EXPECT_NEAR(area, 1, 1e-3);
}

TEST(ReadGltfScene, damaged_draco_is_survived) {
  EXPECT_ERROR(draco_file("1234"), kGltf, "mesh 0, primitive 0: its packed bytes are damaged");
  expect_damage_survived(draco_file(draco_square()), kGltf, 10'000, 13);
}

#else

TEST(ReadGltfScene, without_draco_the_message_says_what_to_do) {
  EXPECT_ERROR(draco_file("1234"), kGltf, "which this build cannot read: export without compression");
}

#endif

/// A file as gltfpack makes it: the views' own buffer is a promise.
std::string meshopt_file(const std::string& positions, const std::string& indices, std::size_t count = 4,
                         const std::string& filter = "NONE") {
  GltfFile file;
  const int first = file.add_view(positions);
  const std::size_t offset = (file.size() + 3) / 4 * 4;
  file.add_view(indices);
  const auto packed = [](std::size_t at, std::size_t size, std::size_t stride, std::size_t elements,
                         const std::string& mode) {
    return R"({"buffer":1,"byteOffset":0,"byteLength":)" + std::to_string(stride * elements) +
           R"(,"extensions":{"EXT_meshopt_compression":{"buffer":0,"byteOffset":)" + std::to_string(at) +
           R"(,"byteLength":)" + std::to_string(size) + R"(,"byteStride":)" + std::to_string(stride) + R"(,"count":)" +
           std::to_string(elements) + R"(,"mode":")" + mode + "}}}";
  };
  EXPECT_EQ(first, 0);
  file.add_accessor(
      file.add_described_view(packed(0, positions.size(), 12, count, R"(ATTRIBUTES","filter":")" + filter + "\"")),
      5126, "VEC3", count);
  file.add_accessor(file.add_described_view(packed(offset, indices.size(), 2, 6, "TRIANGLES\"")), 5123, "SCALAR", 6);
  return file.text(R"("extensionsRequired":["EXT_meshopt_compression"],"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}])",
                   R"(,{"byteLength":200,"extensions":{"EXT_meshopt_compression":{"fallback":true}}})");
}

#ifdef TETSOUP_WITH_MESHOPT

const std::vector<float> kSquare = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};

std::string packed_positions() {
  std::vector<unsigned char> bytes(meshopt_encodeVertexBufferBound(4, 12));
  bytes.resize(meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), kSquare.data(), 4, 12));
  return {bytes.begin(), bytes.end()};
}

std::string packed_indices() {
  const unsigned corners[6] = {0, 1, 2, 0, 2, 3};
  std::vector<unsigned char> bytes(meshopt_encodeIndexBufferBound(6, 4));
  bytes.resize(meshopt_encodeIndexBuffer(bytes.data(), bytes.size(), corners, 6));
  return {bytes.begin(), bytes.end()};
}

TEST(ReadGltfScene, meshopt_gives_the_surface_that_was_packed) {
  const TriangleSoup soup = parse(meshopt_file(packed_positions(), packed_indices()), kGltf);
  EXPECT_EQ(soup.vertices, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
  EXPECT_EQ(soup.triangles.size(), 2U);
}

TEST(ReadGltfScene, meshopt_that_lies_is_refused_without_taking_memory) {
  const std::string positions = packed_positions(), indices = packed_indices();
  largest_allocation = 0;
  EXPECT_ERROR(meshopt_file(positions, indices, 1'000'000'000), kGltf,
               "bufferView 2: promises more than its packed bytes can hold");
  EXPECT_ERROR(meshopt_file("12345678901234567890", indices), kGltf, "its packed bytes are damaged");
  EXPECT_ERROR(meshopt_file(positions, indices, 4, "OCTAHEDRAL"), kGltf, "has an unknown filter");
  EXPECT_LT(largest_allocation, 100'000U);
  expect_damage_survived(meshopt_file(positions, indices), kGltf, 10'000, 12);
}

#else

TEST(ReadGltfScene, without_meshopt_the_message_says_what_to_do) {
  EXPECT_ERROR(meshopt_file("1234", "1234"), kGltf,
               "uses EXT_meshopt_compression, which this build cannot read: export without compression");
}

#endif

}  // namespace
}  // namespace tetsoup
