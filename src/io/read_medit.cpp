// MEDIT .mesh (ASCII) and TetGen's .node with .ele.
#include <cctype>
#include <cstdint>
#include <string>
#include <utility>

#include "io/tet_readers.h"
#include "io/tet_scanner.h"

namespace tetsoup {

namespace {

std::uint32_t read_vertex(TetScanner& in, std::int64_t base, std::size_t count) {
  const std::int64_t index = in.integer("vertex of a tet");
  if (index < base || static_cast<std::uint64_t>(index - base) >= count)
    in.fail("a tet names vertex " + std::to_string(index) + ", but there are " + std::to_string(count) +
            ", counted from " + std::to_string(base));
  return static_cast<std::uint32_t>(index - base);
}

Vec3d read_point(TetScanner& in) {
  Vec3d point;
  point.x = in.real("x coordinate");
  point.y = in.real("y coordinate");
  point.z = in.real("z coordinate");
  return point;
}

Tet read_tet(TetScanner& in, std::int64_t base, std::size_t vertex_count) {
  Tet tet;
  for (std::uint32_t& vertex : tet) vertex = read_vertex(in, base, vertex_count);
  return tet;
}

void read_medit_vertices(TetScanner& in, WideTetMesh& mesh) {
  const std::size_t count = in.count("number of vertices", 8);
  mesh.vertices.reserve(mesh.vertices.size() + count);
  for (std::size_t i = 0; i < count; ++i) {
    mesh.vertices.push_back(read_point(in));
    in.real("reference of a vertex");
  }
}

void read_medit_tets(TetScanner& in, WideTetMesh& mesh) {
  const std::size_t count = in.count("number of tets", 10);
  mesh.tets.reserve(mesh.tets.size() + count);
  for (std::size_t i = 0; i < count; ++i) {
    mesh.tets.push_back(read_tet(in, 1, mesh.vertices.size()));
    in.real("reference of a tet");
  }
}

// Other keywords hold numbers only, so whatever follows one ends at the next word that begins with a letter.
void skip_numbers(TetScanner& in) {
  while (!in.at_end() && std::isalpha(static_cast<unsigned char>(in.peek_word().front())) == 0) in.word();
}

// "count dimension attributes markers", then per node "index x y z attributes... marker".
// Returns what the first is numbered.
std::int64_t read_tetgen_nodes(TetScanner& in, WideTetMesh& mesh) {
  const std::int64_t claimed = in.integer("number of nodes");
  if (in.integer("dimension") != 3) in.fail("the dimension is not 3");
  const std::size_t extras = in.count("number of attributes", 1) + in.count("number of boundary markers", 1);
  if (extras > in.left()) in.fail("there are more attributes than bytes in the file");
  const std::size_t count = in.checked_count(claimed, "number of nodes", 8 + 2 * extras);
  mesh.vertices.reserve(count);
  std::int64_t base = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::int64_t index = in.integer("node's number");
    if (i == 0) base = index;
    if (base != 0 && base != 1) in.fail("nodes are numbered from " + std::to_string(index) + ", not 0 or 1");
    if (index - base != static_cast<std::int64_t>(i)) in.fail("nodes are not numbered one by one");
    mesh.vertices.push_back(read_point(in));
    for (std::size_t extra = 0; extra < extras; ++extra) in.real("attribute of a node");
  }
  return base;
}

// "count corners attributes", then per tet "index corners... attributes...".
void read_tetgen_tets(TetScanner& in, std::int64_t base, WideTetMesh& mesh) {
  const std::int64_t claimed = in.integer("number of tets");
  const std::int64_t corners = in.integer("number of corners of a tet");
  if (corners != 4 && corners != 10) in.fail("tets with " + std::to_string(corners) + " corners are not read");
  const std::size_t extras = static_cast<std::size_t>(corners - 4) + in.count("number of attributes", 1);
  const std::size_t count = in.checked_count(claimed, "number of tets", 10 + 2 * extras);
  mesh.tets.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    in.integer("tet's number");
    mesh.tets.push_back(read_tet(in, base, mesh.vertices.size()));
    for (std::size_t extra = 0; extra < extras; ++extra) in.real("attribute of a tet");
  }
}

}  // namespace

TetMesh parse_medit(std::string_view text, const std::string& name) {
  TetScanner in(text, name, '#');
  WideTetMesh mesh;
  if (in.word() != "MeshVersionFormatted") in.fail("not a MEDIT mesh: it does not begin MeshVersionFormatted");
  in.integer("version");
  while (!in.at_end()) {
    const std::string_view keyword = in.word();
    if (keyword == "End") break;
    if (keyword == "Dimension") {
      if (in.integer("dimension") != 3) in.fail("the dimension is not 3");
    } else if (keyword == "Vertices") {
      read_medit_vertices(in, mesh);
    } else if (keyword == "Tetrahedra") {
      read_medit_tets(in, mesh);
    } else if (std::isalpha(static_cast<unsigned char>(keyword.front())) != 0) {
      skip_numbers(in);
    } else {
      in.fail("expected a keyword such as Vertices");
    }
  }
  return std::move(mesh).narrowed();
}

TetMesh parse_tetgen(std::string_view nodes, const std::string& nodes_name, std::string_view tets,
                     const std::string& tets_name) {
  WideTetMesh mesh;
  TetScanner node_scanner(nodes, nodes_name, '#');
  const std::int64_t base = read_tetgen_nodes(node_scanner, mesh);
  TetScanner tet_scanner(tets, tets_name, '#');
  read_tetgen_tets(tet_scanner, base, mesh);
  return std::move(mesh).narrowed();
}

}  // namespace tetsoup
