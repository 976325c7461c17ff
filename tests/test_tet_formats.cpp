// Formats that say more than a mesh: exact texts of two tets, and rules of those who read them on a larger block.
#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "io/model_parts.h"
#include "io/tet_writers.h"
#include "tet_models.h"
#include "tetsoup/io.h"
#include "tetsoup/quality.h"

namespace tetsoup {

namespace fs = std::filesystem;

namespace {

using TetFormatsTest = FolderTest;
using Json = nlohmann::json;

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// The text from `mark` on.
std::string from(const std::string& text, const std::string& mark) {
  const std::size_t at = text.find(mark);
  return at == text.npos ? "no " + mark : text.substr(at);
}

/// Numbers of a line, whatever stands between them.
std::vector<double> numbers_of(std::string line) {
  std::replace(line.begin(), line.end(), ',', ' ');
  std::istringstream stream(line);
  std::vector<double> numbers;
  for (double number = 0; stream >> number;) numbers.push_back(number);
  return numbers;
}

/// The rows behind the line `mark` and the line that counts them.
std::vector<std::vector<double>> counted_rows(const std::vector<std::string>& lines, const std::string& mark) {
  auto line = std::find(lines.begin(), lines.end(), mark) + 1;
  std::vector<std::vector<double>> rows(static_cast<std::size_t>(numbers_of(*line).at(0)));
  for (auto& row : rows) row = numbers_of(*++line);
  return rows;
}

double six_volumes(const TetMesh& mesh, const std::vector<std::vector<double>>& rows, std::size_t first_column) {
  TetMesh read{mesh.vertices, {}};
  for (const auto& row : rows) {
    Tet tet;
    for (std::size_t i = 0; i < 4; ++i) tet[i] = static_cast<std::uint32_t>(row.at(first_column + i)) - 1;
    read.tets.push_back(tet);
  }
  return 6 * measure_quality(read).volume;
}

}  // namespace

TEST(TetTexts, of_a_lone_region_without_pins_say_nothing_of_either) {
  TetModel model;
  model.mesh = two_tets();
  for (const std::string& text : {msh22_text(model), vtk_text(model), vtu_text(model)})
    for (const char* word : {"Physical", "CELL_DATA", "CellData", "PointData", "POINT_DATA"})
      EXPECT_EQ(text.find(word), text.npos) << word;
  EXPECT_EQ(tetgen_ele_text(model).substr(0, 6), "2 4 0\n");
}

TEST(TetTexts, msh_4_1_stays_one_block_whatever_the_regions) {
  TetModel plain;
  plain.mesh = two_tets();
  EXPECT_EQ(msh41_text(two_regions()), msh41_text(plain));
}

TEST(TetTexts, msh_2_2_has_physical_volumes_with_names) {
  EXPECT_EQ(from(msh22_text(two_regions()), "$Elements"),
            "$Elements\n2\n1 4 2 2 2 1 2 3 4\n2 4 2 1 1 2 3 4 5\n$EndElements\n"
            "$PhysicalNames\n3\n3 1 \"left_arm\"\n3 2 \"LEFT_ARM_2\"\n3 3 \"region\"\n$EndPhysicalNames\n");
}

TEST(TetTexts, legacy_vtk_has_its_data_behind_the_cells) {
  EXPECT_EQ(from(vtk_text(two_regions()), "CELL_TYPES"),
            "CELL_TYPES 2\n10\n10\nCELL_DATA 2\nSCALARS region int 1\nLOOKUP_TABLE default\n1\n0\n"
            "POINT_DATA 5\nSCALARS pin_floor int 1\nLOOKUP_TABLE default\n1\n0\n1\n0\n0\n"
            "SCALARS pin_wall int 1\nLOOKUP_TABLE default\n0\n0\n1\n0\n1\n");
}

TEST_F(TetFormatsTest, files_with_regions_and_pins_are_still_read_back) {
  const TetModel model = block_of_regions(3);
  for (const auto& [name, format] : std::map<std::string, TetFormat>{{"a.msh", TetFormat::Msh22},
                                                                     {"b.vtk", TetFormat::Vtk},
                                                                     {"c.vtu", TetFormat::Vtu},
                                                                     {"d.mesh", TetFormat::Medit},
                                                                     {"e.node", TetFormat::Tetgen}}) {
    write_tets(folder_ / name, model, format);
    const TetMesh read = read_tets(folder_ / name);
    EXPECT_EQ(read.vertices, model.mesh.vertices) << name;
    EXPECT_EQ(read.tets, model.mesh.tets) << name;
  }
}

TEST(TetTexts, medit_and_tetgen_number_regions_and_pin_sets_from_1) {
  EXPECT_EQ(from(medit_text(two_regions()), "Vertices"),
            "Vertices\n5\n0 0 0 1\n1 0 0 0\n0 1 0 1\n0 0 1 0\n1 1 1 2\n\n"
            "Tetrahedra\n2\n1 2 3 4 2\n2 3 4 5 1\n\nEnd\n");
  EXPECT_EQ(tetgen_node_text(two_regions()), "5 3 0 1\n0 0 0 0 1\n1 1 0 0 0\n2 0 1 0 1\n3 0 0 1 0\n4 1 1 1 2\n");
  EXPECT_EQ(tetgen_ele_text(two_regions()), "2 4 1\n0 0 1 2 3 2\n1 1 2 3 4 1\n");
}

TEST(TetTexts, isaac_gym_counts_from_0) {
  EXPECT_EQ(isaacgym_text(two_regions()),
            "# tetsoup\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 1 1 1\nt 0 1 2 3\nt 1 2 3 4\n");
}

TEST(TetTexts, obj_has_a_face_of_four_corners_for_every_tet) {
  EXPECT_EQ(from(obj_tets_text(two_regions()), "o "),
            "o two\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 1 1 1\ng left_arm\nf 2 3 4 5\ng LEFT_ARM_2\nf 1 2 3 4\n"
            "g region\n");
}

TEST(TetTexts, vega_has_a_material_a_set_and_a_region_each) {
  EXPECT_EQ(vega_text(two_regions()),
            "# tetsoup\n\n*VERTICES\n5 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 1 1 1\n"
            "\n*ELEMENTS\nTET\n2 4 0\n1 1 2 3 4\n2 2 3 4 5\n"
            "\n*MATERIAL left_arm\nENU, 1000, 2000, 0.25\n\n*MATERIAL LEFT_ARM_2\nENU, 500, 4000, 0.375\n"
            "\n*MATERIAL region\nENU, 1000, 1e+05, 0.4\n"
            "\n*SET left_arm\n2\n\n*SET LEFT_ARM_2\n1\n"
            "\n*REGION\nleft_arm, left_arm\n\n*REGION\nLEFT_ARM_2, LEFT_ARM_2\n");
  EXPECT_EQ(vega_pins_text(two_regions()), "1,3,5\n");
}

TEST(TetTexts, vega_takes_its_own_set_of_all_where_there_is_one_region) {
  TetModel model;
  model.mesh = two_tets();
  EXPECT_EQ(from(vega_text(model), "*REGION"), "*REGION\nallElements, region\n");
  EXPECT_EQ(vega_text(model).find("*SET"), std::string::npos);
}

TEST_F(TetFormatsTest, vegas_list_of_pins_stands_beside_its_mesh_if_there_are_any) {
  TetModel model = two_regions();
  EXPECT_EQ(write_tets(folder_ / "m.veg", model), (std::vector<fs::path>{folder_ / "m.veg", folder_ / "m.bou"}));
  EXPECT_EQ(tet_files(folder_ / "m.veg", TetFormat::Vega), write_tets(folder_ / "m.veg", model));
  model.pins = {{"none", {}}};
  EXPECT_EQ(write_tets(folder_ / "n.veg", model), std::vector<fs::path>{folder_ / "n.veg"});
}

TEST(TetTexts, vegas_lists_have_no_blanks_and_short_lines) {
  TetModel model;
  model.mesh = block_of_tets(2);
  model.pins = {{"all", {}}};
  for (std::uint32_t v = 0; v < model.mesh.vertices.size(); ++v) model.pins[0].vertices.push_back(v);
  EXPECT_EQ(vega_pins_text(model), "1,2,3,4,5,6,7,8,\n9,10,11,12,13,14,15,16,\n17,18,19,20,21,22,23,24,\n25,26,27\n");
}

TEST(TetTexts, abaqus_has_a_set_a_material_and_a_section_for_each_region_with_tets) {
  EXPECT_EQ(abaqus_text(two_regions()),
            "** tetsoup\n*NODE, NSET=NALL\n1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n4, 0, 0, 1\n5, 1, 1, 1\n"
            "*ELEMENT, TYPE=C3D4, ELSET=left_arm\n2, 2, 3, 4, 5\n"
            "*ELEMENT, TYPE=C3D4, ELSET=LEFT_ARM_2\n1, 1, 2, 3, 4\n"
            "*ELSET, ELSET=EALL\nleft_arm\nLEFT_ARM_2\n"
            "*NSET, NSET=floor\n1, 3\n*NSET, NSET=wall\n3, 5\n"
            "*SURFACE, NAME=HULL, TYPE=ELEMENT\n1, S1\n1, S2\n1, S4\n2, S2\n2, S4\n2, S3\n"
            "*MATERIAL, NAME=left_arm\n*ELASTIC\n2000, 0.25\n*DENSITY\n1000\n"
            "*SOLID SECTION, ELSET=left_arm, MATERIAL=left_arm\n"
            "*MATERIAL, NAME=LEFT_ARM_2\n*ELASTIC\n4000, 0.375\n*DENSITY\n500\n"
            "*SOLID SECTION, ELSET=LEFT_ARM_2, MATERIAL=LEFT_ARM_2\n");
}

TEST(TetTexts, the_faces_that_abaqus_is_told_are_the_boundary) {
  // As its manual numbers them: S1 is 1-2-3, S2 1-4-2, S3 2-4-3, S4 3-4-1.
  const std::map<std::string, std::array<std::size_t, 3>> corners{
      {"S1", {0, 1, 2}}, {"S2", {0, 3, 1}}, {"S3", {1, 3, 2}}, {"S4", {2, 3, 0}}};
  const TetModel model = block_of_regions(3);
  std::multiset<std::set<std::uint32_t>> listed, expected;
  const std::vector<std::string> lines = lines_of(from(abaqus_text(model), "*SURFACE"));
  for (std::size_t i = 1; !lines[i].starts_with('*'); ++i) {
    const Tet& tet = model.mesh.tets[static_cast<std::size_t>(numbers_of(lines[i]).at(0)) - 1];
    const auto& face = corners.at(lines[i].substr(lines[i].find('S')));
    listed.insert({tet[face[0]], tet[face[1]], tet[face[2]]});
  }
  for (const Triangle& t : boundary_triangles(model.mesh)) expected.insert({t[0], t[1], t[2]});
  EXPECT_EQ(listed, expected);
}

TEST(TetTexts, abaqus_gets_no_number_longer_than_its_fields_of_20_characters) {
  TetModel model;
  model.mesh = few_tets();
  model.mesh.vertices.push_back({-1.2345679e-5F, -12345.678F, -3.4028235e38F});
  model.regions.front().material = {1000.0 / 3, 1e-5 / 3, 0.1 + 0.2, 1};
  for (const std::string& line : lines_of(abaqus_text(model))) {
    if (line.starts_with('*')) continue;
    std::istringstream fields(line);
    for (std::string field; std::getline(fields, field, ',');)
      EXPECT_LE(field.size() - field.find_first_not_of(' '), 20U) << line;
  }
  const auto lines = lines_of(abaqus_text(model));
  for (std::size_t i = 0; i < model.mesh.vertices.size(); ++i) {
    const std::vector<double> row = numbers_of(lines.at(2 + i));
    const Vec3& v = model.mesh.vertices[i];
    EXPECT_EQ((Vec3{static_cast<float>(row.at(1)), static_cast<float>(row.at(2)), static_cast<float>(row.at(3))}), v);
  }
}

TEST(TetTexts, solvers_without_units_get_a_material_in_the_meshs_own) {
  TetModel model;
  model.mesh = two_tets();
  model.regions = {{"steel", {7800, 2e11, 0.25, 0.001}}};
  EXPECT_NE(abaqus_text(model).find("*ELASTIC\n2e+08, 0.25\n*DENSITY\n7.8"), std::string::npos) << abaqus_text(model);
  EXPECT_NE(vega_text(model).find("e-06, 2e+08, 0.25\n"), std::string::npos) << vega_text(model);
}

TEST(TetTexts, netgen_is_negative_and_names_both_sides_of_every_surface) {
  EXPECT_EQ(from(netgen_text(two_regions()), "surfaceelements"),
            "surfaceelements\n7\n2 2 2 0 3 1 3 2\n2 2 2 0 3 1 2 4\n2 2 2 0 3 1 4 3\n4 4 1 2 3 2 4 3\n"
            "1 1 1 0 3 2 3 5\n1 1 1 0 3 2 5 4\n1 1 1 0 3 3 4 5\n"
            "\n# matnr np p1 p2 p3 p4\nvolumeelements\n2\n2 4 2 1 3 4\n1 4 3 2 4 5\n"
            "\npoints\n5\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 1 1\n"
            "\nmaterials\n3\n1 left_arm\n2 LEFT_ARM_2\n3 region\n"
            "\nbcnames\n4\n1 outside_of_left_arm\n2 outside_of_LEFT_ARM_2\n3 outside_of_region\n"
            "4 left_arm_to_LEFT_ARM_2\n\nendmesh\n");
}

TEST(TetTexts, netgens_surface_encloses_its_tets) {
  const TetModel model = block_of_regions(4);
  const auto lines = lines_of(netgen_text(model));
  EXPECT_NEAR(six_volumes(model.mesh, counted_rows(lines, "volumeelements"), 2),
              -6 * measure_quality(model.mesh).volume, 1e-9);
  std::map<double, double> enclosed;
  for (const auto& row : counted_rows(lines, "surfaceelements")) {
    std::array<Vec3, 3> p;
    for (std::size_t i = 0; i < 3; ++i) p[i] = model.mesh.vertices[static_cast<std::size_t>(row.at(5 + i)) - 1];
    const double x = p[0].x * (double{p[1].y} * p[2].z - double{p[1].z} * p[2].y);
    const double y = p[0].y * (double{p[1].z} * p[2].x - double{p[1].x} * p[2].z);
    const double z = p[0].z * (double{p[1].x} * p[2].y - double{p[1].y} * p[2].x);
    enclosed[row.at(2)] += (x + y + z) / 6;  // Outwards of the inner domain, so inwards of the outer one.
    enclosed[row.at(3)] -= (x + y + z) / 6;
  }
  for (const std::uint32_t region : {0U, 1U}) {
    TetMesh part{model.mesh.vertices, {}};
    for (std::size_t t = 0; t < model.mesh.tets.size(); ++t)
      if (model.tet_regions[t] == region) part.tets.push_back(model.mesh.tets[t]);
    EXPECT_NEAR(enclosed[region + 1], measure_quality(part).volume, 1e-6);
  }
}

TEST(TetTexts, json_is_flat_arrays) {
  TetModel model = two_regions();
  model.name = "a \"b\"";
  model.up = UpAxis::Y;
  model.embedding.tets = {1, 0};
  model.embedding.weights = {{0.25F, 0.25F, 0.25F, 0.25F}, {1, 0, 0, 0}};
  model.render.vertices = {{0, 0, 0}, {0.5F, 0, 0}, {0.5F, 0.5F, 0}, {0, 0.5F, 0}};
  model.render.face_sizes = {4};
  model.render.corners = {0, 1, 2, 3};
  const Json json = Json::parse(json_text(model));
  EXPECT_EQ(json.at("name"), "a \"b\"");
  EXPECT_EQ(json.at("up"), "y");
  EXPECT_EQ(json.at("metres_per_unit"), 1.0);
  EXPECT_EQ(json.at("vertices"), (Json{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1}));
  EXPECT_EQ(json.at("tets"), (Json{0, 1, 2, 3, 1, 2, 3, 4}));
  EXPECT_EQ(json.at("edges"), (Json{0, 1, 0, 2, 0, 3, 1, 2, 1, 3, 1, 4, 2, 3, 2, 4, 3, 4}));
  EXPECT_EQ(json.at("surface").size(), 6 * 3U);
  EXPECT_EQ(json.at("tet_regions"), (Json{1, 0}));
  EXPECT_EQ(json.at("regions").at(1), Json::parse(R"({"name": "LEFT_ARM", "density": 500, "young": 4000,
                                                       "poisson": 0.375})"));
  EXPECT_EQ(json.at("pins").at(0), Json::parse(R"({"name": "floor", "vertices": [0, 2]})"));
  EXPECT_EQ(json.at("render").at("vertices").size(), 12U);
  EXPECT_EQ(json.at("render").at("triangles"), (Json{0, 1, 2, 0, 2, 3}));
  EXPECT_EQ(json.at("embedding").at("tets"), (Json{1, 0}));
  EXPECT_EQ(json.at("embedding").at("weights"), (Json{0.25, 0.25, 0.25, 0.25, 1, 0, 0, 0}));
}

TEST(TetTexts, json_without_a_surface_or_an_embedding_has_none_and_is_valid_with_any_number) {
  TetModel model;
  model.mesh = two_tets();
  model.mesh.vertices[4].x = std::numeric_limits<float>::infinity();
  const Json json = Json::parse(json_text(model));
  EXPECT_FALSE(json.contains("embedding"));
  EXPECT_FALSE(json.contains("render"));
  EXPECT_TRUE(json.at("vertices").at(12).is_null());
  EXPECT_TRUE(json.at("tet_regions").empty());
}

TEST(LegalNames, are_words_that_begin_with_a_letter_and_differ_in_more_than_case) {
  LegalNames names({"EALL"});
  EXPECT_EQ(names.make("Arm (left), 2", "region"), "Arm_left_2");
  EXPECT_EQ(names.make("arm left 2", "region"), "arm_left_2_2");
  EXPECT_EQ(names.make("eall", "region"), "eall_2");
  EXPECT_EQ(names.make("3d", "region"), "region_3d");
  EXPECT_EQ(names.make("_x_", "region"), "x");
  EXPECT_EQ(names.make("\xC3\xA4", "region"), "region");
  EXPECT_EQ(names.make("", "region"), "region_2");
  EXPECT_EQ(names.make(std::string(200, 'a'), "region").size(), 60U);
}

TEST_F(TetFormatsTest, models_whose_parts_do_not_fit_together_are_refused) {
  const auto refuses = [&](const auto& spoil) {
    TetModel model = two_regions();
    spoil(model);
    EXPECT_THROW(write_tets(folder_ / "m.msh", model), InvalidInput);
  };
  refuses([](TetModel& m) { m.regions.clear(); });
  refuses([](TetModel& m) { m.tet_regions.pop_back(); });
  refuses([](TetModel& m) { m.tet_regions[0] = 3; });
  refuses([](TetModel& m) { m.pins[0].vertices[0] = 5; });
  refuses([](TetModel& m) { m.embedding.tets = {0}; });
  refuses([](TetModel& m) {
    m.embedding.tets = {2};
    m.embedding.weights.resize(1);
  });
  EXPECT_TRUE(files().empty());
}

}  // namespace tetsoup
