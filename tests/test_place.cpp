// Models that lie far from zero: the same mesh as near it, moved, and everybody agrees on the place.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>

#include "base/origin.h"
#include "base/vec.h"
#include "io/number_text.h"
#include "soup_files.h"
#include "tet_models.h"
#include "tetsoup/engines.h"
#include "tetsoup/io.h"
#include "tetsoup/pipeline.h"
#include "tetsoup/quality.h"
#include "tetsoup/regions.h"
#include "tetsoup/simulate.h"
#include "tetsoup/tetsoup.h"

namespace tetsoup::test {
namespace {

namespace fs = std::filesystem;

const Vec3d kMap{5e5, 4.6e6, 300};  // m: east, north, height

struct WideSoup {
  std::vector<Vec3d> points;
  std::vector<Triangle> triangles;
};

/// Radii 0.5 and 0.2; coordinates are multiples of 2^-12, so that they are whole at map coordinates too.
WideSoup torus_at(const Vec3d& centre) {
  constexpr std::uint32_t kAround = 48, kAcross = 20;
  WideSoup torus;
  const auto round = [](double x) { return std::floor(x * 4096 + 0.5) / 4096; };
  for (std::uint32_t i = 0; i < kAround; ++i) {
    for (std::uint32_t j = 0; j < kAcross; ++j) {
      const double u = 2 * std::numbers::pi * i / kAround, v = 2 * std::numbers::pi * j / kAcross;
      const double out = 0.5 + 0.2 * std::cos(v);
      torus.points.push_back(centre +
                             Vec3d{round(out * std::cos(u)), round(out * std::sin(u)), round(0.2 * std::sin(v))});
      const auto at = [&](std::uint32_t a, std::uint32_t b) { return a % kAround * kAcross + b % kAcross; };
      torus.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      torus.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return torus;
}

TriangleSoup soup_of(const WideSoup& wide) {
  return make_soup(wide.points, wide.triangles);
}

std::string obj_of(const WideSoup& soup) {
  std::string text;
  for (const Vec3d& p : soup.points) append_line(text += "v ", p.x, p.y, p.z);
  for (const Triangle& t : soup.triangles) append_line(text += "f ", t[0] + 1, t[1] + 1, t[2] + 1);
  return text;
}

void expect_same_soup(const TriangleSoup& read, const WideSoup& wanted) {
  ASSERT_EQ(read.vertices.size(), wanted.points.size());
  EXPECT_EQ(read.triangles, wanted.triangles);
  for (std::size_t i = 0; i < wanted.points.size(); ++i)
    ASSERT_EQ(placed(read.vertices[i], read.origin), wanted.points[i]) << i;
}

MeshOptions coarse() {
  MeshOptions options;
  options.lattice.tets = 300;
  options.distance.voxels = 48;
  return options;
}

/// A folder that goes with the test.
class PlaceFiles : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("tetsoup_place_" + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  static std::string text_of(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  fs::path folder_;
};

TEST(Place, a_torus_anywhere_gives_the_mesh_of_the_torus_at_zero_moved) {
  const TetMesh here = mesh_soup(soup_of(torus_at({})), coarse());
  EXPECT_EQ(here.origin, Vec3d{});
  for (const Vec3d& centre : {Vec3d{1e4, 0, 0}, kMap, Vec3d{-4e8, 1e9, 2}}) {
    const TetMesh there = mesh_soup(soup_of(torus_at(centre)), coarse());
    EXPECT_EQ(there.origin, centre);
    EXPECT_EQ(there.vertices, here.vertices);
    EXPECT_EQ(there.tets, here.tets);
  }
}

TEST(Place, near_zero_points_are_the_floats_they_always_were) {
  WideSoup torus = torus_at({0.1, 5, -7});
  for (Vec3d& p : torus.points) p = p * (1.0 / 3);
  const TriangleSoup soup = soup_of(torus);
  EXPECT_EQ(soup.origin, Vec3d{});
  for (std::size_t i = 0; i < torus.points.size(); ++i) ASSERT_EQ(soup.vertices[i], to_float(torus.points[i]));
}

TEST(Place, few_points_elsewhere_and_such_as_no_triangle_uses_do_not_decide) {
  WideSoup torus = torus_at(kMap);
  const auto used = static_cast<std::uint32_t>(torus.points.size());
  for (int i = 0; i < 5000; ++i) torus.points.push_back({0, 0, 0});
  torus.points.push_back({std::nan(""), 1e300, 0});
  torus.triangles.push_back({used, used, used});
  torus.triangles.push_back({0, 1, used + 5000});
  const TriangleSoup soup = soup_of(torus);
  EXPECT_EQ(soup.origin, kMap);
  EXPECT_EQ(clean_soup(soup).report.non_finite, 1U);
}

TEST(Place, every_format_of_surfaces_is_read_with_all_its_digits) {
  const WideSoup torus = torus_at(kMap);
  expect_same_soup(parse(obj_of(torus), SoupFormat::Obj), torus);
  std::string off = "OFF\n", ply = "ply\nformat ascii 1.0\n", binary = "ply\nformat binary_little_endian 1.0\n";
  append_line(off, torus.points.size(), torus.triangles.size(), 0);
  const std::string header = "element vertex " + std::to_string(torus.points.size()) +
                             "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
                             std::to_string(torus.triangles.size()) +
                             "\nproperty list uchar uint vertex_indices\nend_header\n";
  ply += header;
  binary += header;
  for (const Vec3d& p : torus.points) {
    append_line(off, p.x, p.y, p.z);
    append_line(ply, p.x, p.y, p.z);
    binary += raw(p.x) + raw(p.y) + raw(p.z);
  }
  for (const Triangle& t : torus.triangles) {
    append_line(off, 3, t[0], t[1], t[2]);
    append_line(ply, 3, t[0], t[1], t[2]);
    binary += raw(std::uint8_t{3}) + raw(t[0]) + raw(t[1]) + raw(t[2]);
  }
  expect_same_soup(parse(off, SoupFormat::Off), torus);
  expect_same_soup(parse(ply, SoupFormat::Ply), torus);
  expect_same_soup(parse(binary, SoupFormat::Ply), torus);
  expect_same_surface(parse_mesh(ply, SoupFormat::Ply), parse(ply, SoupFormat::Ply));
  EXPECT_EQ(parse_mesh(ply, SoupFormat::Ply).origin, kMap);
}

TEST(Place, stl_text_has_digits_and_binary_stl_its_floats) {
  const WideSoup torus = torus_at({5e5, 5e5, 0});
  std::string text = "solid t\n", binary(80, ' ');
  binary += raw(static_cast<std::uint32_t>(torus.triangles.size()));
  std::vector<Vec3> stored;
  for (const Triangle& t : torus.triangles) {
    text += "facet normal 0 0 0 outer loop\n";
    binary += raw(0.0F) + raw(0.0F) + raw(0.0F);
    for (const std::uint32_t v : t) {
      const Vec3d& p = torus.points[v];
      append_line(text += "vertex ", p.x, p.y, p.z);
      stored.push_back(to_float(p));
      binary += raw(stored.back().x) + raw(stored.back().y) + raw(stored.back().z);
    }
    text += "endloop endfacet\n";
    binary += "  ";
  }
  text += "endsolid t\n";
  const TriangleSoup exact = parse(text, SoupFormat::Stl), rounded = parse(binary, SoupFormat::Stl);
  for (std::size_t i = 0; i < exact.vertices.size(); ++i) {
    const Vec3d& p = torus.points[torus.triangles[i / 3][i % 3]];
    ASSERT_EQ(placed(exact.vertices[i], exact.origin), p);
    ASSERT_EQ(placed(rounded.vertices[i], rounded.origin), placed(stored[i], {}));
  }
}

TEST(Place, nodes_of_gltf_move_in_double_precision) {
  const std::string json =
      R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0,"translation":[500000.0625,4600000.5,300.125]}],"meshes":[{
      "primitives":[{"attributes":{"POSITION":0}}]}],"accessors":[{"bufferView":0,"componentType":5126,"count":3,
      "type":"VEC3"}],"bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,"uri":
      "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";
  const TriangleSoup soup = parse(json, SoupFormat::Gltf);
  ASSERT_EQ(soup.vertices.size(), 3U);
  EXPECT_EQ(placed(soup.vertices[0], soup.origin), (Vec3d{500000.0625, 4600000.5, 300.125}));
  EXPECT_EQ(placed(soup.vertices[1], soup.origin), (Vec3d{500001.0625, 4600000.5, 300.125}));
}

TEST_F(PlaceFiles, tets_come_back_from_every_format_where_they_were) {
  const TetMesh mesh = mesh_soup(soup_of(torus_at(kMap)), coarse());
  for (const char* name : {"a.msh", "a.vtk", "a.vtu", "a.mesh", "a.node", "a.npz"}) {
    write_tets(folder_ / name, mesh);
    const TetMesh read = read_tets(folder_ / name);
    ASSERT_EQ(read.vertices.size(), mesh.vertices.size()) << name;
    EXPECT_EQ(read.tets, mesh.tets);
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
      ASSERT_EQ(placed(read.vertices[i], read.origin), placed(mesh.vertices[i], mesh.origin)) << name;
  }
}

TEST_F(PlaceFiles, boundaries_are_exact_as_obj_and_ply_and_within_floats_as_stl) {
  const TetMesh mesh = mesh_soup(soup_of(torus_at(kMap)), coarse());
  const Box3 box = clean_soup({mesh.vertices, boundary_triangles(mesh), mesh.origin}).report.box;
  for (const auto& [name, step] : {std::pair{"a.obj", 0.0}, {"a.ply", 0.0}, {"a.stl", 0.25}}) {
    write_tets(folder_ / name, mesh);
    const SoupReport read = clean_soup(read_soup(folder_ / name)).report;
    EXPECT_NEAR(read.origin.y + read.box.lo.y, mesh.origin.y + box.lo.y, step) << name;
    EXPECT_NEAR(read.origin.x + read.box.hi.x, mesh.origin.x + box.hi.x, step) << name;
  }
}

TEST_F(PlaceFiles, usd_has_the_offset_as_a_translation_and_what_is_recentred_has_none) {
  TetModel model;
  model.mesh = mesh_soup(soup_of(torus_at(kMap)), coarse());
  model.render = render_mesh_of(soup_of(torus_at(kMap)));
  write_tets(folder_ / "a.usda", model);
  EXPECT_NE(text_of(folder_ / "a.usda").find("double3 xformOp:translate = (5e+05, 4600000, 300)"), std::string::npos);
  recentre(model);
  write_tets(folder_ / "a.usda", model);
  EXPECT_EQ(text_of(folder_ / "a.usda").find("xformOp"), std::string::npos);
  EXPECT_EQ(model.render.vertices.size(), torus_at(kMap).points.size());
}

TEST(Place, boxes_planes_labels_and_embeddings_agree_across_origins) {
  const TriangleSoup soup = soup_of(torus_at(kMap));
  const TetMesh mesh = mesh_soup(soup, coarse());
  const TetMesh here = mesh_soup(soup_of(torus_at({})), coarse());
  EXPECT_EQ(vertices_in_box(mesh, {kMap - Vec3d{1, 1, 1}, kMap + Vec3d{0, 1, 1}}),
            vertices_in_box(here, {{-1, -1, -1}, {0, 1, 1}}));
  EXPECT_EQ(vertices_below(mesh, {0, 0, 1}, 300.05), vertices_below(here, {0, 0, 1}, 0.05));
  // The same soup counted from elsewhere.
  const Vec3d other = kMap + Vec3d{8, -16, 4};
  const TriangleSoup moved{recounted(soup.vertices, soup.origin, other), soup.triangles, other};
  EXPECT_EQ(embed_points(mesh, moved).tets, embed_points(mesh, soup).tets);
  EXPECT_LT(embed_points(mesh, moved).report.max_distance, 0.1);
  std::vector<std::uint32_t> labels;
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) labels.push_back(t < soup.triangles.size() / 2 ? 0 : 1);
  EXPECT_EQ(label_tets(mesh, moved, labels), label_tets(mesh, soup, labels));
  EXPECT_EQ(boundary_distance(mesh, moved, 1).mean, boundary_distance(mesh, soup, 1).mean);
}

TEST(Place, grids_and_boxes_to_cover_are_in_the_inputs_place) {
  const CleanSoup soup = clean_soup(soup_of(torus_at(kMap)));
  DistanceOptions options;
  options.box = Box3{kMap - Vec3d{1, 1, 1}, kMap + Vec3d{1, 1, 1}};
  options.voxels = 20;
  const GridFrame frame = make_grid(soup, options);
  EXPECT_EQ(frame.size[2], 24);
  EXPECT_NEAR((frame.origin + frame.soup_origin).y, kMap.y - 1 + 0.05 - 0.2, 1e-9);
}

TEST(Place, a_simulated_body_starts_where_its_pose_puts_its_place) {
  const TetMesh mesh = mesh_soup(soup_of(torus_at(kMap)), coarse());
  Simulation simulation;
  const Vec3d back = kMap * -1 + Vec3d{0, 0, 2};
  simulation.add_body(mesh, SimMaterial{}, Pose{.translate = back});
  const auto positions = simulation.positions(0);
  for (std::size_t i = 0; i < positions.size(); ++i)
    ASSERT_EQ(positions[i], to_float(to_double(mesh.vertices[i]) + Vec3d{0, 0, 2}));
}

TEST_F(PlaceFiles, scenes_of_engines_move_the_body_back_with_all_digits) {
  TetModel model;
  model.mesh = mesh_soup(soup_of(torus_at({5e5, 4.6e6 + 0.25, 300})), coarse());
  const auto files = write_for_engine(find_engine("pybullet"), folder_ / "a", model, true);
  const std::string text = text_of(files.back()), before = "MESH, basePosition=[";
  const std::size_t at = text.find(before);
  ASSERT_NE(at, std::string::npos) << text;
  EXPECT_NEAR(std::stod(text.substr(at + before.size())), -5e5, 0.01);  // the middle of the mesh, not quite the torus's
}

}  // namespace
}  // namespace tetsoup::test
