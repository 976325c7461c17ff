// What the writers put into files, judged by the rules of those who read them.
#include <algorithm>
#include <cstring>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tet_file_fixtures.h"
#include "tetsoup/io.h"

namespace tetsoup {

namespace fs = std::filesystem;

namespace {

using WriteTetsTest = FolderTest;

std::vector<std::string> lines_of(const fs::path& path) {
  std::istringstream text(bytes_of(path));
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

// Lines between $Name and $EndName.
std::vector<std::string> section(const std::vector<std::string>& lines, const std::string& name) {
  const auto begin = std::find(lines.begin(), lines.end(), "$" + name);
  const auto end = std::find(lines.begin(), lines.end(), "$End" + name);
  if (begin == lines.end() || end == lines.end()) return {};
  return {begin + 1, end};
}

template <class Number>
Number raw_at(const std::string& bytes, std::size_t at) {
  Number value{};
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

constexpr std::size_t kFirstCoordinate = 84 + 12;  // Of an STL file: header, count, normal.

}  // namespace

TEST_F(WriteTetsTest, msh_4_1_is_one_node_block_and_one_element_block_with_sequential_tags) {
  const TetMesh mesh = block_of_tets(3);
  EXPECT_EQ(write_tets(folder_ / "m.msh", mesh), std::vector<fs::path>{folder_ / "m.msh"});
  const auto lines = lines_of(folder_ / "m.msh");
  EXPECT_EQ(section(lines, "MeshFormat"), std::vector<std::string>{"4.1 0 8"});
  EXPECT_EQ(section(lines, "Entities").at(0), "0 0 0 1");
  const auto nodes = section(lines, "Nodes");
  ASSERT_EQ(nodes.size(), 2 + 2 * 64U);
  EXPECT_EQ(nodes[0], "1 64 1 64");
  EXPECT_EQ(nodes[1], "3 1 0 64");
  for (std::size_t i = 0; i < 64; ++i) EXPECT_EQ(nodes[2 + i], std::to_string(i + 1));
  const auto elements = section(lines, "Elements");
  ASSERT_EQ(elements.size(), 2 + 162U);
  EXPECT_EQ(elements[0], "1 162 1 162");
  EXPECT_EQ(elements[1], "3 1 4 162");
  EXPECT_EQ(elements[2].substr(0, 4), "1 1 ");
}

TEST_F(WriteTetsTest, msh_4_1_names_the_box_of_its_entity) {
  TetMesh mesh = few_tets();
  mesh.vertices = {{0, 0, 0}, {1.5F, 0, 0}, {0, 2, 0}, {0, 0, 3}, {-1, -1, -1}};
  write_tets(folder_ / "m.msh", mesh);
  EXPECT_EQ(section(lines_of(folder_ / "m.msh"), "Entities").at(1), "1 -1 -1 -1 1.5 2 3 0 0");
}

TEST_F(WriteTetsTest, msh_2_2_has_a_physical_and_an_entity_tag_per_tet) {
  write_tets(folder_ / "m.msh", few_tets(), TetFormat::Msh22);
  const auto lines = lines_of(folder_ / "m.msh");
  EXPECT_EQ(section(lines, "MeshFormat"), std::vector<std::string>{"2.2 0 8"});
  EXPECT_EQ(section(lines, "Elements"), (std::vector<std::string>{"2", "1 4 2 1 1 1 2 3 4", "2 4 2 1 1 1 3 2 5"}));
  EXPECT_EQ(section(lines, "Nodes").at(1).substr(0, 25), "1 0.10000000149011612 -0 ");
}

TEST_F(WriteTetsTest, legacy_vtk_is_version_3_with_one_point_and_one_tet_a_line) {
  write_tets(folder_ / "m.vtk", few_tets());
  const auto lines = lines_of(folder_ / "m.vtk");
  ASSERT_EQ(lines.size(), 5 + 6 + 1 + 2 + 1 + 2U);
  EXPECT_EQ(lines[0], "# vtk DataFile Version 3.0");
  EXPECT_EQ(lines[2], "ASCII");
  EXPECT_EQ(lines[3], "DATASET UNSTRUCTURED_GRID");
  EXPECT_EQ(lines[4], "POINTS 6 float");
  EXPECT_EQ(lines[11], "CELLS 2 10");
  EXPECT_EQ(lines[12], "4 0 1 2 3");
  EXPECT_EQ(lines[14], "CELL_TYPES 2");
  EXPECT_EQ(lines[16], "10");
}

TEST_F(WriteTetsTest, medit_ends_every_entity_with_a_reference) {
  write_tets(folder_ / "m.mesh", few_tets());
  const auto lines = lines_of(folder_ / "m.mesh");
  EXPECT_EQ(lines[1], "Dimension 3");
  const auto tets = std::find(lines.begin(), lines.end(), "Tetrahedra");
  ASSERT_NE(tets, lines.end());
  EXPECT_EQ(tets[1], "2");
  EXPECT_EQ(tets[2], "1 2 3 4 1");
  EXPECT_EQ(lines.back(), "End");
}

TEST_F(WriteTetsTest, tetgen_files_stand_side_by_side_whichever_of_them_is_named) {
  const std::vector<fs::path> set{folder_ / "m.node", folder_ / "m.ele", folder_ / "m.face"};
  for (const char* name : {"m.node", "m.ele", "m.face"}) EXPECT_EQ(write_tets(folder_ / name, few_tets()), set);
  EXPECT_EQ(write_tets(folder_ / "m", few_tets(), TetFormat::Tetgen), set);
  EXPECT_EQ(lines_of(set[0]).at(0), "6 3 0 0");
  EXPECT_EQ(lines_of(set[1]), (std::vector<std::string>{"2 4 0", "0 0 1 2 3", "1 0 2 1 4"}));
  EXPECT_EQ(lines_of(set[2]), (std::vector<std::string>{"6 1", "0 1 2 3 1", "1 0 3 2 1", "2 0 1 3 1", "3 2 1 4 1",
                                                        "4 0 4 1 1", "5 0 2 4 1"}));
}

TEST_F(WriteTetsTest, if_one_of_tetgens_files_cannot_be_written_the_others_stay_as_they_were) {
  put_file(folder_ / "m.node", "old");
  fs::create_directory(folder_ / "m.ele");
  EXPECT_NE(io_error_of([&] { write_tets(folder_ / "m.node", few_tets()); }).find("m.ele"), std::string::npos);
  EXPECT_EQ(bytes_of(folder_ / "m.node"), "old");
  EXPECT_EQ(files(), (std::vector<std::string>{"m.ele", "m.node"}));
}

TEST_F(WriteTetsTest, every_format_reports_a_full_disk_and_a_missing_folder) {
  for (const TetFormatInfo& info : tet_formats()) {
    EXPECT_THROW(write_tets(folder_ / "none" / ("m" + info.extension), few_tets(), info.format), IoError) << info.name;
    if (info.format == TetFormat::Tetgen || info.format == TetFormat::Surface || !fs::exists("/dev/full")) continue;
    EXPECT_THROW(write_tets("/dev/full", few_tets(), info.format), IoError) << info.name;
  }
  EXPECT_TRUE(files().empty());
}

TEST_F(WriteTetsTest, indices_beyond_the_vertices_are_refused_before_a_file_is_touched) {
  TetMesh mesh = few_tets();
  mesh.tets.push_back({0, 1, 2, 6});
  for (const TetFormatInfo& info : tet_formats())
    EXPECT_THROW(write_tets(folder_ / ("m" + info.extension), mesh, info.format), InvalidInput) << info.name;
  EXPECT_TRUE(files().empty());
}

TEST_F(WriteTetsTest, a_mesh_that_leaves_as_surface_has_its_boundary_only) {
  write_tets(folder_ / "m.obj", block_of_tets(2));
  std::map<char, int> count;
  for (const std::string& line : lines_of(folder_ / "m.obj")) ++count[line.at(0)];
  EXPECT_EQ(count['v'], 26);  // All but the one in the middle.
  EXPECT_EQ(count['f'], 6 * 8);
}

TEST(TetFormats, are_told_by_extension_whatever_its_case) {
  EXPECT_EQ(tet_format_of("a.msh"), TetFormat::Msh41);
  EXPECT_EQ(tet_format_of("a.VTK"), TetFormat::Vtk);
  EXPECT_EQ(tet_format_of("a.b.vtu"), TetFormat::Vtu);
  EXPECT_EQ(tet_format_of("a.mesh"), TetFormat::Medit);
  EXPECT_EQ(tet_format_of("a.ele"), TetFormat::Tetgen);
  EXPECT_EQ(tet_format_of("a.stl"), TetFormat::Surface);
  EXPECT_EQ(tet_format_of("a.obj"), TetFormat::Surface) << "OBJ is tets only where that is asked for";
  for (const char* name : {"a.xyz", "msh", ""}) {
    const std::string text = io_error_of([&] { tet_format_of(name); });
    for (const TetFormatInfo& info : tet_formats()) EXPECT_NE(text.find(info.extension), text.npos) << text;
  }
}

TEST(TetFormats, have_names_of_their_own) {
  std::set<std::string> names;
  for (const TetFormatInfo& info : tet_formats()) {
    names.insert(info.name);
    EXPECT_EQ(tet_format_named(info.name), info.format);
  }
  EXPECT_EQ(names.size(), tet_formats().size());
  EXPECT_THROW(tet_format_named("gltf"), InvalidInput);
}

TEST_F(WriteTetsTest, surfaces_leave_out_vertices_that_no_triangle_uses) {
  const std::vector<Vec3> vertices{{9, 9, 9}, {0, 0, 0}, {1, 0, 0}, {8, 8, 8}, {0, 1, 0.5F}};
  const std::vector<Triangle> triangles{{1, 2, 4}};
  write_surface(folder_ / "s.obj", vertices, triangles);
  EXPECT_EQ(bytes_of(folder_ / "s.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0.5\nf 1 2 3\n");
  write_surface(folder_ / "s.ply", vertices, triangles);
  const std::string ply = bytes_of(folder_ / "s.ply");
  EXPECT_NE(ply.find("element vertex 3\n"), ply.npos);
  EXPECT_EQ(ply.size() - ply.find("end_header\n") - 11, 3 * 12 + 13U);
  EXPECT_EQ(raw_at<std::int32_t>(ply, ply.size() - 4), 2);
}

TEST_F(WriteTetsTest, binary_stl_does_not_pass_for_text_and_has_unit_normals) {
  const std::vector<Vec3> vertices{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}};
  write_surface(folder_ / "s.stl", vertices, std::vector<Triangle>{{0, 1, 2}, {0, 0, 1}});
  const std::string stl = bytes_of(folder_ / "s.stl");
  ASSERT_EQ(stl.size(), 84 + 2 * 50U);
  EXPECT_FALSE(stl.starts_with("solid"));
  EXPECT_EQ(raw_at<std::uint32_t>(stl, 80), 2U);
  EXPECT_EQ(raw_at<float>(stl, 84 + 8), 1.0F);
  EXPECT_EQ(raw_at<float>(stl, kFirstCoordinate + 12), 2.0F);
  EXPECT_EQ(raw_at<float>(stl, 84 + 50 + 8), 0.0F) << "a triangle without area has no normal";
}

TEST_F(WriteTetsTest, surfaces_of_unknown_kind_or_with_wild_indices_are_refused) {
  const std::vector<Vec3> vertices(3);
  EXPECT_THROW(write_surface(folder_ / "s.off", vertices, std::vector<Triangle>{{0, 1, 2}}), IoError);
  EXPECT_THROW(write_surface(folder_ / "s.obj", vertices, std::vector<Triangle>{{0, 1, 3}}), InvalidInput);
  EXPECT_TRUE(files().empty());
}

}  // namespace tetsoup
