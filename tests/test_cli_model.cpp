// The command-line tool, run as a user runs it: render surface, regions and pins.
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/vec.h"
#include "run_tool.h"
#include "tetsoup/io.h"

namespace tetsoup::test {

namespace {

using Json = nlohmann::json;
using Words = std::vector<std::string>;

/// A plate and a pillar on it, of quads, with names.
class ModelTool : public Tool {
 protected:
  void SetUp() override {
    Tool::SetUp();
    std::string text;
    const auto add_box = [&](int first, const char* names, double x, double lo, double hi) {
      text += names;
      for (int i = 0; i < 8; ++i) {
        const auto at = [&](int bit, double low, double high) { return std::to_string((i >> bit) & 1 ? high : low); };
        text += "v " + at(0, -x, x) + " " + at(1, lo, hi) + " " + at(2, -x, x) + "\n";
      }
      for (const auto& f :
           {std::array{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
        text += "f";
        for (const int v : f) text += " " + std::to_string(first + v);
        text += "\n";
      }
    };
    add_box(1, "o Base plate\nusemtl steel\n", 1, 0, 0.3);
    add_box(9, "o Pillar\nusemtl foam\n", 0.3, 0.2, 2);
    write_text(in_folder("lamp.obj"), text);
  }
  Outcome mesh(Words more) {
    Words words{"mesh", "lamp.obj", "--voxels", "48", "--tets", "600"};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
  }
};

TEST_F(ModelTool, materials_become_regions_with_their_own_numbers) {
  const Outcome outcome = mesh({"-o", "lamp.json", "--regions", "material", "--region", "foam=80,2e4,0.1", "--region",
                                "steel=,2e11", "--json", "report.json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("Regions: steel ("), std::string::npos) << outcome.out;
  const Json regions = Json::parse(read_text(in_folder("report.json"))).at("regions");
  ASSERT_EQ(regions.size(), 2U);
  EXPECT_EQ(regions[0].at("name"), "steel");
  EXPECT_EQ(regions[0].at("density"), 1000);
  EXPECT_EQ(regions[0].at("young"), 2e11);
  EXPECT_EQ(regions[1].at("name"), "foam");
  EXPECT_EQ(regions[1].at("density"), 80);
  EXPECT_EQ(regions[1].at("poisson"), 0.1);
  // Tets above the plate are the pillar's.
  const Json lamp = Json::parse(read_text(in_folder("lamp.json")));
  const auto& tets = lamp.at("tets");
  std::size_t foam = 0;
  for (std::size_t t = 0; 4 * t < tets.size(); ++t) {
    double height = 0;
    for (std::size_t i = 0; i < 4; ++i)
      height += lamp.at("vertices")[3 * tets[4 * t + i].get<std::size_t>() + 1].get<double>() / 4;
    const int region = lamp.at("tet_regions")[t];
    if (height > 0.6 || height < 0.1) {
      EXPECT_EQ(region, height > 0.6);
    }
    foam += region == 1;
  }
  EXPECT_EQ(regions[1].at("tet_count"), foam);
  const double volume = regions[1].at("volume");
  EXPECT_GT(volume, 0);
  EXPECT_NEAR(regions[1].at("mass").get<double>(), 80 * volume, 1e-9 * volume);
  EXPECT_NE(outcome.out.find(" kg)"), std::string::npos) << outcome.out;
}

TEST_F(ModelTool, pins_by_box_plane_and_part_are_written_and_counted) {
  const Outcome outcome = mesh({"-o", "lamp.json", "--pin-below", "y:0.05", "--pin-box", "-2,1.5,-2,2,3,2",
                                "--pin-part", "Base plate", "--pin-below", "-y:-100", "--json", "report.json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json lamp = Json::parse(read_text(in_folder("lamp.json")));
  const auto height = [&](const Json& v) { return lamp.at("vertices")[3 * v.get<std::size_t>() + 1].get<double>(); };
  Json pins;
  for (const Json& set : lamp.at("pins")) pins[set.at("name")] = set.at("vertices");
  ASSERT_EQ(pins.size(), 4U);
  for (const Json& v : pins.at("below")) EXPECT_LE(height(v), 0.05);
  for (const Json& v : pins.at("box")) EXPECT_GE(height(v), 1.5);
  EXPECT_FALSE(pins.at("below").empty());
  EXPECT_FALSE(pins.at("box").empty());
  EXPECT_GT(pins.at("Base plate").size(), pins.at("below").size() / 2);
  EXPECT_TRUE(pins.at("below_2").empty());
  EXPECT_NE(outcome.out.find("Note: 'below_2' holds nothing"), std::string::npos) << outcome.out;
  const Json report = Json::parse(read_text(in_folder("report.json"))).at("pins");
  EXPECT_EQ(report[0].at("name"), "box");
  EXPECT_EQ(report[0].at("vertex_count"), pins.at("box").size());
}

TEST_F(ModelTool, the_embedding_has_a_row_for_every_vertex_of_the_file) {
  for (const char* name : {"lamp.npz", "lamp.embedding"}) {
    const Outcome outcome = mesh({"-o", "lamp.msh", "--embed", name, "--enclose", "--json", "report.json"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("Embedding: 16 vertices of the model in the tets, 0 outside.\n"), std::string::npos);
    const Json report = Json::parse(read_text(in_folder("report.json")));
    EXPECT_EQ(report.at("embedding").at("inside"), 16);
    EXPECT_EQ(report.at("outputs"), Json({"lamp.msh", name}));
    const Embedding embedding = read_embedding(in_folder(name));
    ASSERT_EQ(embedding.tets.size(), 16U);
    const TetMesh mesh = read_tets(in_folder("lamp.msh"));
    const std::vector<Vec3> points = deform_points(embedding, mesh.tets, mesh.vertices);
    const TriangleSoup soup = read_soup(in_folder("lamp.obj"));
    for (std::size_t i = 0; i < points.size(); ++i) {
      EXPECT_NEAR(points[i].x, soup.vertices[i].x, 1e-5);
      EXPECT_NEAR(points[i].y, soup.vertices[i].y, 1e-5);
    }
  }
}

TEST_F(ModelTool, wrong_names_and_numbers_are_refused_before_the_work_and_say_what_there_is) {
  const auto fails = [&](Words words, const std::string& part) {
    words.insert(words.begin(), {"-o", "lamp.msh"});
    const Outcome outcome = mesh(words);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
    EXPECT_EQ(files(), (Words{"cube.obj", "lamp.obj"}));
  };
  fails({"--pin-part", "Top"},
        "no part 'Top'; it has object 'Base plate', object 'Pillar', material 'steel', material "
        "'foam', connected part_1 to part_2");
  fails({"--regions", "object", "--region", "steel=5"}, "no object 'steel'");
  fails({"--region", "steel=5"}, "needs --regions");
  fails({"--regions", "part", "--region", "part_3=5"}, "no part 'part_3'");
  fails({"--regions", "colour"}, "must be object, group, material or part");
  fails({"--regions", "material", "--region", "steel"}, "must be NAME=DENSITY,YOUNG,POISSON");
  fails({"--regions", "material", "--region", "steel="}, "must be NAME=");
  fails({"--regions", "material", "--region", "steel=-5"}, "above 0");
  fails({"--regions", "material", "--region", "steel=5,1e5,0.5"}, "below 0.5");
  fails({"--pin-box", "0,0,0,1,1"}, "two corners");
  fails({"--pin-box", "0,0,0,1,1,nan"}, "finite");
  fails({"--pin-below", "0.5"}, "AXIS:OFFSET");
  fails({"--pin-below", "q:1"}, "AXIS:OFFSET");
  fails({"--pin-below", "0,0,0:1"}, "must not be zero");
  fails({"--embed", "lamp.txt"}, ".npz or .embedding");
  fails({"--embed", "lamp.obj"}, ".npz or .embedding");
}

TEST_F(ModelTool, a_model_without_names_is_one_region_and_says_so) {
  const Outcome outcome = run({"mesh", "cube.obj", "-o", "cube.msh", "--voxels", "24", "--regions", "group"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("Note: nothing in the model tells regions apart that way"), std::string::npos)
      << outcome.out;
}

TEST_F(ModelTool, regions_and_pins_may_be_connected_parts) {
  const Outcome outcome = mesh({"-o", "lamp.json", "--regions", "part", "--region", "part_2=80", "--pin-part", "part_1",
                                "--pin-part", "Base plate"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json by_part = Json::parse(read_text(in_folder("lamp.json")));
  EXPECT_EQ(by_part.at("regions")[0].at("name"), "part_1");
  EXPECT_EQ(by_part.at("regions")[1].at("density"), 80);
  EXPECT_EQ(by_part.at("pins")[0].at("vertices"), by_part.at("pins")[1].at("vertices"));
  ASSERT_EQ(mesh({"-o", "lamp.json", "--regions", "object"}).exit_code, 0);
  EXPECT_EQ(Json::parse(read_text(in_folder("lamp.json"))).at("tet_regions"), by_part.at("tet_regions"));
}

TEST_F(ModelTool, parts_without_tets_are_no_regions) {
  // A crumb on a box: the box has all tets.
  write_text(in_folder("crumb.obj"),
             read_text(in_folder("cube.obj")) + "v 0.5 1 0.5\nv 0.51 1 0.5\nv 0.5 1 0.51\nf -1 -2 -3\n");
  const Outcome outcome = run({"mesh", "crumb.obj", "-o", "crumb.msh", "--voxels", "24", "--regions", "part"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("Regions: part_1 ("), std::string::npos) << outcome.out;
  EXPECT_EQ(outcome.out.find("part_2"), std::string::npos) << outcome.out;
}

TEST_F(ModelTool, inspect_lists_the_parts) {
  const std::string out = run({"inspect", "lamp.obj"}).out;
  for (const char* part : {"Base plate", "Pillar", "steel", "foam", "part_1", "part_2"})
    EXPECT_NE(out.find(part), std::string::npos) << out;
  EXPECT_NE(out.find("12  box from (-1, 0, -1) to (1, 0.3, 1)"), std::string::npos) << out;
  EXPECT_EQ(run({"inspect", "cube.obj"}).out.find("part_1"), std::string::npos);
}

TEST_F(ModelTool, closed_spaces_within_the_mesh_are_written_alone_or_their_lack_is_an_error) {
  std::string text = read_text(in_folder("cube.obj"));
  for (const double x : {0.25, 0.75})
    for (const double y : {0.25, 0.75})
      for (const double z : {0.25, 0.75})
        text += "v " + std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z) + "\n";
  const int first = 9;  // turned to the space within
  for (const auto& f : {std::array{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
    text += "f";
    for (const int v : f) text += " " + std::to_string(first + v);
    text += "\n";
  }
  write_text(in_folder("room.obj"), text);
  const Outcome room = run(
      {"mesh", "room.obj", "--voxels", "48", "--cavities", "keep", "-o", "room.msh", "--cavity-surface", "space.obj"});
  ASSERT_EQ(room.exit_code, 0) << room.err;
  const TriangleSoup space = read_soup(in_folder("space.obj"));
  double volume = 0;
  for (const Triangle& t : space.triangles)
    volume +=
        dot(to_double(space.vertices[t[0]]), cross(to_double(space.vertices[t[1]]), to_double(space.vertices[t[2]])));
  EXPECT_NEAR(volume / 6, -0.125, 0.02) << "it is turned to the space";

  const Outcome solid = run({"mesh", "cube.obj", "-o", "cube.msh", "--cavity-surface", "none.stl"});
  EXPECT_EQ(solid.exit_code, 2);
  EXPECT_NE(solid.err.find("--cavities keep"), std::string::npos) << solid.err;
  EXPECT_FALSE(fs::exists(in_folder("cube.msh")) || fs::exists(in_folder("none.stl")));
  const Outcome named = run({"mesh", "cube.obj", "-o", "cube.msh", "--cavity-surface", "space.msh"});
  EXPECT_NE(named.err.find(".obj, .stl or .ply"), std::string::npos) << named.err;
}

TEST_F(ModelTool, a_model_in_map_coordinates_is_the_same_there_and_recentred_without_the_offset) {
  std::string text;
  std::istringstream lines(read_text(in_folder("lamp.obj")));
  for (std::string line; std::getline(lines, line); text += "\n") {
    double x = 0, y = 0, z = 0;
    std::array<char, 100> moved{};
    if (std::sscanf(line.c_str(), "v %lf %lf %lf", &x, &y, &z) == 3)
      std::snprintf(moved.data(), moved.size(), "v %.6f %.6f %.6f", x + 4e5, y + 512, z - 5e6);
    text += moved[0] == 0 ? line : moved.data();
  }
  ASSERT_EQ(mesh({"-o", "near.json", "--pin-below", "y:0.2", "--regions", "object", "--no-regions-fit"}).exit_code, 0);
  write_text(in_folder("lamp.obj"), text);
  const Outcome there = mesh({"-o", "there.json", "--json", "report.json", "--pin-below", "y:512.2", "--regions",
                              "object", "--no-regions-fit"});
  ASSERT_EQ(there.exit_code, 0) << there.err;
  EXPECT_NE(there.out.find("--recentre"), std::string::npos);
  ASSERT_EQ(mesh({"-o", "zero.json", "--recentre", "--pin-below", "y:512.2", "--regions", "object", "--no-regions-fit"})
                .exit_code,
            0);
  const auto json = [&](const char* name) { return Json::parse(read_text(in_folder(name))); };
  const Json near = json("near.json"), far = json("there.json"), zero = json("zero.json"), report = json("report.json");
  EXPECT_EQ(report["recentred"], false);
  EXPECT_EQ(near["tets"], far["tets"]);
  EXPECT_EQ(near["tet_regions"], far["tet_regions"]);
  EXPECT_EQ(near["pins"], far["pins"]);
  EXPECT_EQ(zero["pins"], far["pins"]);
  for (std::size_t i = 0; i < far["vertices"].size(); ++i) {
    ASSERT_NEAR((near["vertices"][i].get<double>() + std::array{4e5, 512.0, -5e6}[i % 3]),
                far["vertices"][i].get<double>(), 1e-6);
    ASSERT_EQ(zero["vertices"][i].get<double>() + report["offset"][i % 3].get<double>(), far["vertices"][i]);
  }
}

TEST_F(ModelTool, a_file_of_points_is_told_so_and_meshed_with_a_size) {
  std::string text;
  for (int i = 0; i < 600; ++i) {  // Fibonacci's points on a ball.
    const double z = 1 - (2 * i + 1) / 600.0, turn = 2.399963 * i, r = std::sqrt(1 - z * z);
    text += "v " + std::to_string(r * std::cos(turn)) + " " + std::to_string(r * std::sin(turn)) + " " +
            std::to_string(z) + "\n";
  }
  write_text(in_folder("points.obj"), text);
  const Outcome refused = run({"mesh", "points.obj", "-o", "points.msh"});
  EXPECT_EQ(refused.exit_code, 4);
  EXPECT_NE(refused.err.find("holds points, not triangles (600 of them); --point-size 0.1"), std::string::npos)
      << refused.err;
  const Outcome meshed =
      run({"mesh", "points.obj", "-o", "points.npz", "--point-size", "0.15", "--tets", "600", "--json", "report.json"});
  ASSERT_EQ(meshed.exit_code, 0) << meshed.err;
  const Json report = Json::parse(read_text(in_folder("report.json")));
  EXPECT_EQ(report["components"], 1);
  EXPECT_NEAR(report["volume"].get<double>(), 4.19, 0.4);
  EXPECT_EQ(run({"field", "points.obj", "-o", "points.vti", "--point-size", "0.3", "--voxels", "24"}).exit_code, 0);
  const Outcome faces = run({"mesh", "lamp.obj", "-o", "lamp.msh", "--point-size", "0.3"});
  EXPECT_EQ(faces.exit_code, 2);
  EXPECT_NE(faces.err.find("holds faces"), std::string::npos) << faces.err;
  EXPECT_EQ(run({"mesh", "points.obj", "-o", "points.msh", "--point-size", "0"}).exit_code, 2);
}

TEST_F(ModelTool, ten_node_tets_are_written_where_a_format_has_them) {
  const Outcome outcome = mesh({"-o", "lamp.inp", "-o", "lamp.vtu", "--order", "2"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("Ten-node tets: "), std::string::npos) << outcome.out;
  EXPECT_NE(read_text(in_folder("lamp.inp")).find("C3D10"), std::string::npos);
  const Outcome refused = mesh({"-o", "lamp.npz", "--order", "2"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("msh, msh22, vtk, vtu, inp"), std::string::npos) << refused.err;
  EXPECT_EQ(mesh({"-o", "lamp.inp", "--order", "3"}).exit_code, 2);
}

TEST_F(ModelTool, labelled_voxels_are_meshed_with_their_labels_as_regions) {
  std::string text =
      "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 12 12 12\nencoding: ascii\nspacings: 1 1 1\n"
      "Segment0_Name:=bone\nSegment0_LabelValue:=2\n\n";
  for (int i = 0; i < 12 * 12 * 12; ++i) {
    const auto within = [&](int lo, int hi) {
      const auto in = [&](int c) { return c >= lo && c < hi; };
      return in(i % 12) && in(i / 12 % 12) && in(i / 144);
    };
    text += within(4, 8) ? "2 " : within(1, 11) ? "1 " : "0 ";
  }
  write_text(in_folder("scan.nrrd"), text);
  const Outcome outcome =
      run({"mesh", "scan.nrrd", "-o", "scan.json", "--json", "report.json", "--region", "bone=1800"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json report = Json::parse(read_text(in_folder("report.json")));
  const Json& regions = report["regions"];
  ASSERT_EQ(regions.size(), 2U);
  EXPECT_EQ(regions[0]["name"], "label_1");
  EXPECT_EQ(regions[1]["name"], "bone");
  EXPECT_EQ(regions[1]["density"], 1800);
  EXPECT_NEAR(regions[1]["volume"].get<double>(), 64, 5);
  EXPECT_NEAR(report["volume"].get<double>(), 1000, 30);
  write_text(in_folder("empty.nrrd"), "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 1 1 1\nencoding: ascii\n\n0");
  EXPECT_EQ(run({"mesh", "empty.nrrd", "-o", "scan.msh"}).exit_code, 4);
  write_text(in_folder("torn.nrrd"), "NRRD0004\ntype: uint8\n\n");
  EXPECT_EQ(run({"mesh", "torn.nrrd", "-o", "scan.msh"}).exit_code, 3);
}

}  // namespace

}  // namespace tetsoup::test
