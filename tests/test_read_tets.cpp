// Tet meshes back from files: ours to the bit, those of others, and damaged ones.
#include <cstring>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "io/number_text.h"
#include "io/tet_readers.h"
#include "tet_file_dialects.h"
#include "tet_file_fixtures.h"
#include "tetsoup/io.h"

namespace tetsoup {

namespace fs = std::filesystem;

namespace {

using ReadTetsTest = FolderTest;
using Parse = std::function<TetMesh(std::string_view, const std::string&)>;

struct Dialect {
  std::string name;
  std::string bytes;
  Parse parse;
};

std::string written(const TetMesh& mesh, TetFormat format, const char* ending = ".x") {
  const fs::path path = fs::temp_directory_path() / ("tetsoup-" + std::to_string(::getpid()) + "-dialect");
  const auto files = write_tets(path, mesh, format);
  const std::string bytes = bytes_of(std::string_view(ending) == ".ele" ? files[1] : files[0]);
  for (const fs::path& file : files) fs::remove(file);
  return bytes;
}

std::vector<Dialect> all_dialects(const TetMesh& mesh) {
  const std::string nodes = tetgen_nodes_from_one(mesh), tets = tetgen_tets_from_one(mesh);
  const std::string own_nodes = written(mesh, TetFormat::Tetgen), own_tets = written(mesh, TetFormat::Tetgen, ".ele");
  const auto with_tets = [](std::string second) {
    return [second](std::string_view b, const std::string& name) { return parse_tetgen(b, name, second, "t.ele"); };
  };
  const auto with_nodes = [](std::string first) {
    return [first](std::string_view b, const std::string& name) { return parse_tetgen(first, "t.node", b, name); };
  };
  return {{"msh41", written(mesh, TetFormat::Msh41), parse_msh},
          {"msh41_binary", msh41_binary(mesh), parse_msh},
          {"msh22", written(mesh, TetFormat::Msh22), parse_msh},
          {"msh22_binary", msh22_binary(mesh), parse_msh},
          {"vtk", written(mesh, TetFormat::Vtk), parse_vtk},
          {"vtk_binary", vtk_binary(mesh), parse_vtk},
          {"vtk51", vtk51(mesh, false), parse_vtk},
          {"vtk51_binary", vtk51(mesh, true), parse_vtk},
          {"vtu", written(mesh, TetFormat::Vtu), parse_vtu},
          {"vtu_text", vtu(mesh, VtuData::Text), parse_vtu},
          {"vtu_raw", vtu(mesh, VtuData::AppendedRaw), parse_vtu},
          {"vtu_base64", vtu(mesh, VtuData::AppendedBase64), parse_vtu},
          {"vtu_big_endian", vtu(mesh, VtuData::BigEndian), parse_vtu},
          {"medit", written(mesh, TetFormat::Medit), parse_medit},
          {"npz", written(mesh, TetFormat::Npz), parse_npz},
          {"medit_with_extras", medit_with_extras(mesh), parse_medit},
          {"node", own_nodes, with_tets(own_tets)},
          {"node_from_one", nodes, with_tets(tets)},
          {"ele", own_tets, with_nodes(own_nodes)},
          {"ele_from_one", tets, with_nodes(nodes)}};
}

void expect_same_bits(const TetMesh& a, const TetMesh& b) {
  ASSERT_EQ(a.vertices.size(), b.vertices.size());
  EXPECT_EQ(std::memcmp(a.vertices.data(), b.vertices.data(), a.vertices.size() * sizeof(Vec3)), 0);
  EXPECT_EQ(a.tets, b.tets);
}

// Parsed or refused with an IoError that names the file and a line or byte; what was parsed must be sound.
bool parses(const Dialect& dialect, std::string_view bytes) {
  try {
    const TetMesh mesh = dialect.parse(bytes, "the file");
    for (const Tet& tet : mesh.tets)
      for (const std::uint32_t vertex : tet) EXPECT_LT(vertex, mesh.vertices.size()) << dialect.name;
    EXPECT_LE(mesh.vertices.size() + mesh.tets.size(), bytes.size()) << dialect.name;
    return true;
  } catch (const IoError& error) {
    const std::string text = error.what();
    EXPECT_TRUE(text.find("the file: ") == 0 || text.find("t.") == 0) << text;
    EXPECT_TRUE(text.find(": line ") != text.npos || text.find(": byte ") != text.npos) << text;
    return false;
  }
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, text.npos) << from;
  return text.replace(at, from.size(), to);
}

}  // namespace

TEST(ReadTets, every_dialect_gives_back_the_mesh_to_the_bit) {
  for (const TetMesh& mesh : {few_tets(), block_of_tets(4)})
    for (const Dialect& dialect : all_dialects(mesh)) {
      SCOPED_TRACE(dialect.name);
      expect_same_bits(dialect.parse(dialect.bytes, "the file"), mesh);
    }
}

TEST_F(ReadTetsTest, what_was_written_is_read_back_through_the_file_system) {
  const TetMesh mesh = block_of_tets(3);
  for (const auto& [name, format] : std::vector<std::pair<std::string, TetFormat>>{{"m.msh", TetFormat::Msh41},
                                                                                   {"m.msh", TetFormat::Msh22},
                                                                                   {"m.vtk", TetFormat::Vtk},
                                                                                   {"m.vtu", TetFormat::Vtu},
                                                                                   {"m.mesh", TetFormat::Medit},
                                                                                   {"m.npz", TetFormat::Npz},
                                                                                   {"m.node", TetFormat::Tetgen}}) {
    SCOPED_TRACE(name);
    for (const fs::path& path : write_tets(folder_ / name, mesh, format)) {
      EXPECT_TRUE(is_tet_file(path));
      expect_same_bits(read_tets(path), mesh);
    }
  }
  expect_same_bits(read_tets(folder_ / "m"), mesh);  // The TetGen pair by its common name.
}

TEST_F(ReadTetsTest, formats_that_are_only_written_are_refused_as_such) {
  for (const char* name : {"m.tet", "m.veg", "m.inp", "m.vol", "m.json"}) {
    write_tets(folder_ / name, few_tets());
    EXPECT_TRUE(is_tet_file(folder_ / name));
    const std::string text = io_error_of([&] { read_tets(folder_ / name); });
    EXPECT_NE(text.find(name), text.npos) << text;
    EXPECT_NE(text.find("writes such files but does not read them"), text.npos) << text;
  }
}

TEST_F(ReadTetsTest, the_first_bytes_tell_what_the_extension_does_not) {
  const TetMesh mesh = few_tets();
  for (const TetFormat format :
       {TetFormat::Msh41, TetFormat::Msh22, TetFormat::Vtk, TetFormat::Vtu, TetFormat::Medit}) {
    write_tets(folder_ / "m.txt", mesh, format);
    EXPECT_TRUE(is_tet_file(folder_ / "m.txt"));
    expect_same_bits(read_tets(folder_ / "m.txt"), mesh);
  }
  write_tets(folder_ / "m.obj", mesh);
  EXPECT_FALSE(is_tet_file(folder_ / "m.obj"));
  EXPECT_FALSE(is_tet_file(folder_ / "none.obj"));
  EXPECT_TRUE(is_tet_file(folder_ / "none.VTK"));
  EXPECT_NE(io_error_of([&] { read_tets(folder_ / "m.obj"); }).find(".mesh"), std::string::npos);
}

TEST_F(ReadTetsTest, a_file_that_cannot_be_read_is_named_with_the_reason) {
  const std::string text = io_error_of([&] { read_tets(folder_ / "none.msh"); });
  EXPECT_NE(text.find("none.msh': No such file"), text.npos) << text;
  fs::create_directory(folder_ / "sub.msh");
  EXPECT_NE(io_error_of([&] { read_tets(folder_ / "sub.msh"); }).find("directory"), std::string::npos);
  put_file(folder_ / "m.node", tetgen_nodes_from_one(few_tets()));
  EXPECT_NE(io_error_of([&] { read_tets(folder_ / "m.node"); }).find("m.ele"), std::string::npos);
}

TEST(ReadTets, every_truncation_parses_or_names_its_place) {
  for (const Dialect& dialect : all_dialects(few_tets())) {
    std::size_t refused = 0;
    for (std::size_t length = 0; length < dialect.bytes.size(); ++length)
      refused += parses(dialect, std::string_view(dialect.bytes).substr(0, length)) ? 0 : 1;
    EXPECT_GT(refused, dialect.bytes.size() / 4) << dialect.name;
  }
}

TEST(ReadTets, byte_flips_parse_or_name_their_place) {
  constexpr int kCopies = 6'000;  // With two bytes flipped on average, in two dialects or more per format.
  std::mt19937 random(20061);
  for (const Dialect& dialect : all_dialects(few_tets())) {
    int refused = 0;
    for (int copy = 0; copy < kCopies; ++copy) {
      std::string bytes = dialect.bytes;
      for (auto bad = random() % 3 + 1; bad > 0; --bad) bytes[random() % bytes.size()] = static_cast<char>(random());
      refused += parses(dialect, bytes) ? 0 : 1;
    }
    EXPECT_GT(refused, kCopies / 20) << dialect.name;
  }
}

TEST(ReadTets, huge_counts_are_refused_before_memory_is_taken) {
  const TetMesh mesh = few_tets();
  const auto refused = [](const Parse& parse, const std::string& bytes) {
    const std::string text = io_error_of([&] { parse(bytes, "f"); });
    EXPECT_NE(text.find("f: "), text.npos);
  };
  for (const char* huge : {"4000000000", "9223372036854775807", "-1", "99999999999999999999"}) {
    const std::string n = huge;
    refused(parse_msh, replaced(written(mesh, TetFormat::Msh41), "3 1 0 6", "3 1 0 " + n));
    refused(parse_msh, replaced(written(mesh, TetFormat::Msh41), "1 6 1 6", "1 " + n + " 1 6"));
    refused(parse_msh, replaced(written(mesh, TetFormat::Msh41), "3 1 4 2", "3 1 4 " + n));
    refused(parse_msh, replaced(written(mesh, TetFormat::Msh22), "$Nodes\n6", "$Nodes\n" + n));
    refused(parse_vtk, replaced(written(mesh, TetFormat::Vtk), "POINTS 6", "POINTS " + n));
    refused(parse_vtk, replaced(written(mesh, TetFormat::Vtk), "CELLS 2", "CELLS " + n));
    refused(parse_vtk, replaced(written(mesh, TetFormat::Vtk), "CELLS 2 10", "CELLS 2 " + n));
    refused(parse_vtk, replaced(vtk_binary(mesh), "POINTS 6", "POINTS " + n));
    refused(parse_vtk, replaced(vtk_binary(mesh), "TIME 1 1", "TIME " + n + " 2"));
    refused(parse_vtk, replaced(vtk51(mesh, true), "CELLS 3", "CELLS " + n));
    refused(parse_vtu, replaced(vtu(mesh, VtuData::Text), "Points=\"6", "Points=\"" + n));
    refused(parse_medit, replaced(written(mesh, TetFormat::Medit), "Vertices\n6", "Vertices\n" + n));
    refused(parse_medit, replaced(written(mesh, TetFormat::Medit), "Tetrahedra\n2", "Tetrahedra\n" + n));
  }
}

TEST(ReadTets, indices_beyond_the_vertices_name_their_line) {
  const TetMesh mesh = few_tets();
  const auto error_of = [](const Parse& parse, const std::string& bytes) {
    return io_error_of([&] { parse(bytes, "f"); });
  };
  EXPECT_EQ(error_of(parse_vtk, replaced(written(mesh, TetFormat::Vtk), "4 0 2 1 4", "4 0 2 6 4")),
            "f: line 14: the corner of a cell is 6, but there are 6 vertices");
  EXPECT_NE(error_of(parse_msh, replaced(written(mesh, TetFormat::Msh22), "1 3 2 5", "1 3 7 5")).find("f: line 16: "),
            std::string::npos);
  EXPECT_NE(error_of(parse_msh, replaced(written(mesh, TetFormat::Msh41), "1 3 2 5", "1 3 0 5")).find("node 0"),
            std::string::npos);
  EXPECT_NE(error_of(parse_medit, replaced(written(mesh, TetFormat::Medit), "1 2 3 4 1", "1 2 3 0 1")).find("line 15"),
            std::string::npos);
  EXPECT_NE(error_of(parse_vtu, replaced(vtu(mesh, VtuData::Text), "0 1 2 3 0", "0 1 2 9 0")).find("f: line 14: "),
            std::string::npos);
}

TEST(ReadTets, a_number_has_one_sign) {
  const std::string cube = "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 1 float\n";
  for (const char* word : {"+-1", "-+1", "++1", "--1"}) {
    try {
      parse_vtk(cube + word + " 0 0\n", "sample");
      ADD_FAILURE() << word;
    } catch (const IoError& error) {
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
  }
  double value = 0;
  EXPECT_TRUE(parse_real("+1.5", value));
  EXPECT_EQ(value, 1.5);
  EXPECT_FALSE(parse_real("+-1.5", value));
}

TEST(ReadTets, doubles_are_rounded_to_the_nearest_float) {
  const std::string text =
      replaced(written(few_tets(), TetFormat::Medit), "0.10000000149011612 -0 1.0000000031710769e-30 0",
               "+0.1000000000000000055511151231257827 1e-400 -1e39 0");
  const Vec3 v = parse_medit(text, "f").vertices[0];
  EXPECT_EQ(v.x, 0.1F);
  EXPECT_EQ(v.y, 0.0F);
  EXPECT_EQ(v.z, -std::numeric_limits<float>::infinity());
}

TEST(ReadTets, coordinates_that_are_no_numbers_survive_the_round_trip) {
  TetMesh mesh = few_tets();
  mesh.vertices[0] = {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 0};
  for (const Dialect& dialect : all_dialects(mesh)) {
    if (dialect.name == "medit_with_extras") continue;
    const TetMesh back = dialect.parse(dialect.bytes, "f");
    EXPECT_TRUE(back.vertices[0].x != back.vertices[0].x) << dialect.name;
    EXPECT_EQ(back.vertices[0].y, mesh.vertices[0].y) << dialect.name;
  }
}

TEST(ReadTets, a_mesh_without_tets_is_read_as_such) {
  TetMesh mesh = few_tets();
  mesh.tets.clear();
  for (const Dialect& dialect : all_dialects(mesh)) expect_same_bits(dialect.parse(dialect.bytes, "f"), mesh);
  for (const Dialect& dialect : all_dialects({})) {
    if (dialect.name.find('_') == std::string::npos) {
      EXPECT_TRUE(dialect.parse(dialect.bytes, "f").vertices.empty()) << dialect.name;
    }
  }
}

TEST(ReadTets, what_is_not_supported_says_so) {
  const TetMesh mesh = few_tets();
  const auto expect_error = [](const Parse& parse, const std::string& bytes, const std::string& part) {
    const std::string text = io_error_of([&] { parse(bytes, "f"); });
    EXPECT_NE(text.find(part), text.npos) << text;
  };
  expect_error(parse_msh, replaced(written(mesh, TetFormat::Msh41), "4.1 0 8", "4 0 8"), "MSH version '4'");
  expect_error(parse_vtk, replaced(written(mesh, TetFormat::Vtk), "UNSTRUCTURED_GRID", "POLYDATA"), "no tets");
  expect_error(parse_vtu,
               replaced(written(mesh, TetFormat::Vtu), "byte_order", "compressor=\"vtkZLibDataCompressor\" byte_order"),
               "compressed");
  expect_error(parse_vtu, replaced(written(mesh, TetFormat::Vtu), "\"UnstructuredGrid", "\"PolyData"), "PolyData");
  expect_error(parse_medit, replaced(written(mesh, TetFormat::Medit), "Dimension 3", "Dimension 2"), "dimension");
}

TEST(ReadTets, arrays_that_share_their_bytes_cannot_multiply_the_memory) {
  const std::string one = vtu(few_tets(), VtuData::AppendedRaw);
  const std::size_t begin = one.find("<Piece NumberOf"), end = one.find("</Piece>") + 8;
  std::string pieces;
  for (int i = 0; i < 3; ++i) pieces += one.substr(begin, end - begin);
  std::string small_file = one.substr(0, begin) + pieces + one.substr(end);
  EXPECT_EQ(parse_vtu(small_file, "f").tets.size(), 6U) << "the tags take more bytes than the arrays here";
  for (int i = 0; i < 100; ++i)
    small_file.insert(begin,
                      "<Piece NumberOfPoints=\"6\" NumberOfCells=\"3\"><Points>"
                      "<DataArray type=\"Int8\" format=\"appended\" offset=\"0\"/></Points></Piece>");
  EXPECT_THROW(parse_vtu(small_file, "f"), IoError);
}

}  // namespace tetsoup
