// Surfaces with polygons, texture coordinates, normals and names: what each format gives, and writing them again.
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include "soup_files.h"
#include "tetsoup/samples.h"

namespace tetsoup {
namespace {

using namespace test;
namespace fs = std::filesystem;

constexpr std::uint32_t kNone = RenderMesh::kNone;
const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

RenderMesh mesh_of_obj(std::string_view text) {
  return parse_mesh(text, SoupFormat::Obj);
}

TEST(RenderMesh, obj_keeps_polygons_texture_coordinates_and_normals) {
  const RenderMesh mesh =
      mesh_of_obj(kSquare + "vt 0 1\nvt 0.5\nvn 0 0 -2\nf 1 2 3\nf 1/2/1 2/1 3//-1 4\nf 1/-2/1 2/2 3/ \n");
  EXPECT_EQ(mesh.face_sizes, (std::vector<std::uint32_t>{3, 4, 3}));
  EXPECT_EQ(mesh.corners, (std::vector<std::uint32_t>{0, 1, 2, 0, 1, 2, 3, 0, 1, 2}));
  EXPECT_EQ(mesh.texcoords, (std::vector<Vec2>{{0, 1}, {0.5F, 0}}));
  EXPECT_EQ(mesh.corner_texcoords, (std::vector<std::uint32_t>{kNone, kNone, kNone, 1, 0, kNone, kNone, 0, 1, kNone}));
  EXPECT_EQ(mesh.normals, (std::vector<Vec3>{{0, 0, -2}}));
  EXPECT_EQ(mesh.corner_normals,
            (std::vector<std::uint32_t>{kNone, kNone, kNone, 0, kNone, 0, kNone, 0, kNone, kNone}));
  EXPECT_EQ(mesh.parts, std::vector<RenderMesh::Part>(1));
}

TEST(RenderMesh, obj_names_hold_until_the_next_and_come_in_the_order_of_their_faces) {
  const RenderMesh mesh =
      mesh_of_obj(kSquare +
                  "o unused\no  My  Car\nf 1 2 3\ng wheel  left\tfront\nusemtl rubber #2\nf 1 2 3\ng\n"
                  "f 1 2 3\nusemtl\nf 1 2 3\no Box\\\nf 1 2 3\n");
  EXPECT_EQ(mesh.parts, (std::vector<RenderMesh::Part>{{"My Car", "", ""},
                                                       {"My Car", "wheel left front", "rubber #2"},
                                                       {"My Car", "", "rubber #2"},
                                                       {"Box\\", "", ""}}));
  EXPECT_EQ(mesh.face_parts, (std::vector<std::uint32_t>{0, 1, 2, 0, 3}));
}

TEST(RenderMesh, wild_texture_indices_are_none_and_wild_vertices_stay) {
  const RenderMesh mesh = mesh_of_obj(kSquare + "vt 0 0\nf 1/2 9/-2 0/1\nf 1/99999999999999999999 2/0 -9/1\n");
  EXPECT_EQ(mesh.corner_texcoords, (std::vector<std::uint32_t>{kNone, kNone, 0, kNone, kNone, 0}));
  EXPECT_EQ(mesh.corners, (std::vector<std::uint32_t>{0, 8, kNone, 0, 1, kNone}));
  EXPECT_TRUE(mesh_of_obj(kSquare + "vt 0 0\nf 1/2 2/2 3/2\n").corner_texcoords.empty());
}

TEST(RenderMesh, faces_of_less_than_three_corners_leave_nothing) {
  const RenderMesh mesh = mesh_of_obj(kSquare + "vt 0 0\ng a\nf 1/1 2/1\nf\ng b\nf 1 2/1 3\ng c\nf 1\n");
  EXPECT_EQ(mesh.face_sizes, (std::vector<std::uint32_t>{3}));
  EXPECT_EQ(mesh.corner_texcoords, (std::vector<std::uint32_t>{kNone, 0, kNone}));
  EXPECT_EQ(mesh.parts, (std::vector<RenderMesh::Part>{{"", "b", ""}}));
}

TEST(RenderMesh, details_that_are_no_numbers_do_not_shift_the_others_or_swallow_lines) {
  const RenderMesh mesh = mesh_of_obj(kSquare + "vt\nvt x 1\nvt 1 \\\nf 1 2 3\nvn 1 2\nf 1/3/1 2 3\n");
  EXPECT_EQ(mesh.texcoords, (std::vector<Vec2>{{0, 0}, {0, 0}, {1, 0}}));
  EXPECT_EQ(mesh.normals, (std::vector<Vec3>{{1, 2, 0}}));
  EXPECT_EQ(mesh.face_sizes.size(), 2U);
  EXPECT_EQ(mesh.corner_texcoords.at(3), 2U);
}

TEST(RenderMesh, a_long_name_before_many_groups_takes_no_memory_beyond_bounds) {
  std::string text = kSquare + "o " + std::string(100'000, 'x') + "\n";
  for (int i = 0; i < 2000; ++i) text += "g " + std::to_string(i) + "\nf 1 2 3\n";
  try {
    mesh_of_obj(text);
    ADD_FAILURE();
  } catch (const IoError& error) {
    EXPECT_NE(std::string(error.what()).find("sample: the names"), std::string::npos) << error.what();
  }
  EXPECT_EQ(parse(text, SoupFormat::Obj).triangles.size(), 2000U);
}

TEST(RenderMesh, stl_solids_are_objects) {
  const std::string facet =
      "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nvertex 0 1 0\n"
      "endloop\nendfacet\n";
  const RenderMesh mesh =
      parse_mesh("solid  left  part \n" + facet + "endsolid left\nsolid\n" + facet + "endsolid\n", SoupFormat::Stl);
  EXPECT_EQ(mesh.parts, (std::vector<RenderMesh::Part>{{"left part", "", ""}, {}}));
  EXPECT_EQ(mesh.face_sizes, (std::vector<std::uint32_t>{4, 4}));
  EXPECT_EQ(mesh.face_parts, (std::vector<std::uint32_t>{0, 1}));
}

TEST(RenderMesh, ply_vertices_have_texture_coordinates_and_normals) {
  for (const char* names : {"s t", "u v", "texture_u texture_v"}) {
    const std::string u(names, std::strchr(names, ' ')), v(std::strchr(names, ' ') + 1);
    const RenderMesh mesh = parse_mesh(
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float nx\nproperty float ny\nproperty float nz\nproperty "
        "float "
        "x\nproperty float y\nproperty float z\nproperty float " +
            u + "\nproperty float " + v +
            "\nelement face 1\nproperty list uchar int vertex_index\nend_header\n0 0 1 1 2 3 .5 .25\n0 1 0 4 5 6 1 0\n"
            "1 0 0 7 8 9 0 1\n4 2 1 0 7\n",
        SoupFormat::Ply);
    EXPECT_EQ(mesh.vertices[2], (Vec3{7, 8, 9}));
    EXPECT_EQ(mesh.face_sizes, (std::vector<std::uint32_t>{4}));
    EXPECT_EQ(mesh.texcoords, (std::vector<Vec2>{{.5F, .25F}, {1, 0}, {0, 1}}));
    EXPECT_EQ(mesh.corner_texcoords, (std::vector<std::uint32_t>{2, 1, 0, kNone}));
    EXPECT_EQ(mesh.normals[1], (Vec3{0, 1, 0}));
    EXPECT_EQ(mesh.corner_normals, mesh.corner_texcoords);
  }
}

TEST(RenderMesh, every_triangle_knows_its_face) {
  const RenderMesh mesh = mesh_of_obj(kSquare + "f 1 2 3 4 1\nf 1 2\nf 4 3 2 1\n");
  EXPECT_EQ(triangle_faces(mesh), (std::vector<std::uint32_t>{0, 0, 0, 1, 1}));
  EXPECT_EQ(triangles_of(mesh).triangles,
            (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 3, 0}, {3, 2, 1}, {3, 1, 0}}));
}

TEST(RenderMesh, sizes_that_do_not_fit_together_are_refused) {
  RenderMesh mesh = mesh_of_obj(kSquare + "f 1 2 3 4\n");
  mesh.face_sizes = {3};
  EXPECT_THROW(triangles_of(mesh), InvalidInput);
  mesh.face_sizes = {4};
  mesh.face_parts = {1};
  EXPECT_THROW(triangle_faces(mesh), InvalidInput);
}

TEST(RenderMesh, part_names_are_counted_by_kind_in_triangles) {
  const RenderMesh mesh = mesh_of_obj(
      kSquare + "o body\nusemtl red\nf 1 2 3 4\ng lid\nf 1 2 3\no body 2\nusemtl blue\nf 1 2 3\nusemtl red\nf 1 2 3\n");
  std::ostringstream text;
  for (const PartName& part : part_names(mesh))
    text << static_cast<int>(part.kind) << ' ' << part.name << ' ' << part.triangle_count << '\n';
  EXPECT_EQ(text.str(), "0 body 3\n0 body 2 2\n1 lid 3\n2 red 4\n2 blue 1\n");
}

class WriteRenderMesh : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder); }
  void TearDown() override { fs::remove_all(folder); }
  const fs::path folder = fs::temp_directory_path() / ("tetsoup-render-" + std::to_string(std::random_device()()));
};

std::string content_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST_F(WriteRenderMesh, the_same_mesh_is_read_again) {
  const std::string text =
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0.5\nvt 0 0.25\nvt 1 1\nvn 0 0 1\nf 1/1/1 2/2/1 3 4//1\no lid\ng a b\n"
      "usemtl red\nf 1/2 2 0 9\no\nf 1 2 3\n";
  const RenderMesh mesh = mesh_of_obj(text);
  write_render_mesh(folder / "again.OBJ", mesh);
  EXPECT_EQ(content_of(folder / "again.OBJ"), text);
  EXPECT_EQ(read_render_mesh(folder / "again.OBJ"), mesh);
}

TEST_F(WriteRenderMesh, names_cannot_break_out_of_their_line) {
  RenderMesh mesh = mesh_of_obj(kSquare + "f 1 2 3\n");
  mesh.parts[0].object = "a\nf 1 2 3";
  write_render_mesh(folder / "a.obj", mesh);
  EXPECT_EQ(read_render_mesh(folder / "a.obj").parts[0].object, "a f 1 2 3");
}

TEST_F(WriteRenderMesh, other_extensions_are_refused) {
  EXPECT_THROW(write_render_mesh(folder / "a.stl", {}), IoError);
}

TEST_F(WriteRenderMesh, samples_are_the_same_as_soup_and_as_render_mesh) {
  for (const std::string& name : sample_names()) {
    SCOPED_TRACE(name);
    const TriangleSoup soup = make_sample(name);
    for (const char* extension : {".obj", ".stl", ".ply"}) {
      const fs::path path = folder / ("sample" + std::string(extension));
      write_surface(path, soup.vertices, soup.triangles);
      expect_same_surface(read_render_mesh(path), read_soup(path));
    }
  }
}

TEST_F(WriteRenderMesh, models_are_the_same_as_soup_and_as_render_mesh_and_written_again) {
  if (!fs::is_directory(TETSOUP_MODELS_DIR)) GTEST_SKIP() << "no models in " << TETSOUP_MODELS_DIR;
  for (const auto& entry : fs::directory_iterator(TETSOUP_MODELS_DIR)) {
    if (entry.path().extension() == ".md") continue;
    SCOPED_TRACE(entry.path().filename());
    const RenderMesh mesh = read_render_mesh(entry.path());
    expect_same_surface(mesh, read_soup(entry.path()));
    write_render_mesh(folder / "again.obj", mesh);
    EXPECT_TRUE(read_render_mesh(folder / "again.obj") == mesh);
  }
}

}  // namespace
}  // namespace tetsoup
