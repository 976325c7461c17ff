// Tet meshes as text, one function per format. Corners stay in our order everywhere: all these formats take
// D = (b-a)x(c-a).(d-a) > 0 as positive. TetGen too: version 1.6 was seen to give only tets with D > 0.
#include <algorithm>
#include <limits>
#include <string>

#include "io/base64.h"
#include "io/number_text.h"
#include "io/raw_numbers.h"
#include "io/tet_writers.h"

namespace tetsoup {

namespace {

// Typical line lengths, to allocate once.
constexpr std::size_t kBytesPerVertex = 40, kBytesPerTet = 36;

std::string text_for(const TetMesh& mesh) {
  std::string text;
  text.reserve(1024 + kBytesPerVertex * mesh.vertices.size() + kBytesPerTet * mesh.tets.size());
  return text;
}

Box3 box_of(const TetMesh& mesh) {
  if (mesh.vertices.empty()) return {};
  constexpr double kHuge = std::numeric_limits<double>::max();
  Box3 box{{kHuge, kHuge, kHuge}, {-kHuge, -kHuge, -kHuge}};
  for (const Vec3& v : mesh.vertices) {
    box.lo = {std::min<double>(box.lo.x, v.x), std::min<double>(box.lo.y, v.y), std::min<double>(box.lo.z, v.z)};
    box.hi = {std::max<double>(box.hi.x, v.x), std::max<double>(box.hi.y, v.y), std::max<double>(box.hi.z, v.z)};
  }
  return box;
}

void append_data_array(std::string& text, const char* attributes, const std::string& bytes) {
  std::string raw;
  raw.reserve(bytes.size() + 8);
  append_raw(raw, static_cast<std::uint64_t>(bytes.size()));
  raw += bytes;
  text += "        <DataArray ";
  text += attributes;
  text += " format=\"binary\">";
  append_base64(text, raw);
  text += "</DataArray>\n";
}

}  // namespace

// One entity, so one node block and one element block: MuJoCo takes no other.
std::string msh41_text(const TetMesh& mesh) {
  std::string text = text_for(mesh);
  const std::size_t nodes = mesh.vertices.size(), tets = mesh.tets.size();
  const Box3 box = box_of(mesh);
  text += "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n0 0 0 1\n";
  append_line(text, 1, box.lo.x, box.lo.y, box.lo.z, box.hi.x, box.hi.y, box.hi.z, 0, 0);
  text += "$EndEntities\n$Nodes\n";
  append_line(text, 1, nodes, 1, nodes);
  append_line(text, 3, 1, 0, nodes);
  for (std::size_t i = 0; i < nodes; ++i) append_line(text, i + 1);
  for (const Vec3& v : mesh.vertices) append_line(text, v.x, v.y, v.z);
  text += "$EndNodes\n$Elements\n";
  append_line(text, 1, tets, 1, tets);
  append_line(text, 3, 1, 4, tets);
  for (std::size_t i = 0; i < tets; ++i) {
    const Tet& t = mesh.tets[i];
    append_line(text, i + 1, t[0] + 1, t[1] + 1, t[2] + 1, t[3] + 1);
  }
  text += "$EndElements\n";
  return text;
}

std::string msh22_text(const TetMesh& mesh) {
  std::string text = text_for(mesh);
  text += "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n";
  append_line(text, mesh.vertices.size());
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const Vec3& v = mesh.vertices[i];
    append_line(text, i + 1, v.x, v.y, v.z);
  }
  text += "$EndNodes\n$Elements\n";
  append_line(text, mesh.tets.size());
  for (std::size_t i = 0; i < mesh.tets.size(); ++i) {
    const Tet& t = mesh.tets[i];
    append_line(text, i + 1, 4, 2, 1, 1, t[0] + 1, t[1] + 1, t[2] + 1, t[3] + 1);  // Type 4; physical and entity 1.
  }
  text += "$EndElements\n";
  return text;
}

// Bullet reads this one line by line and nothing newer.
std::string vtk_text(const TetMesh& mesh) {
  std::string text = text_for(mesh);
  text += "# vtk DataFile Version 3.0\ntetsoup\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS ";
  append_number(text, mesh.vertices.size());
  text += " float\n";
  for (const Vec3& v : mesh.vertices) append_line(text, v.x, v.y, v.z);
  text += "CELLS ";
  append_line(text, mesh.tets.size(), 5 * mesh.tets.size());
  for (const Tet& t : mesh.tets) append_line(text, 4, t[0], t[1], t[2], t[3]);
  text += "CELL_TYPES ";
  append_line(text, mesh.tets.size());
  for (std::size_t i = 0; i < mesh.tets.size(); ++i) text += "10\n";
  return text;
}

std::string vtu_text(const TetMesh& mesh) {
  std::string points, corners, offsets;
  for (const Vec3& v : mesh.vertices)
    for (const float coordinate : {v.x, v.y, v.z}) append_raw(points, coordinate);
  for (std::size_t i = 0; i < mesh.tets.size(); ++i) {
    for (const std::uint32_t corner : mesh.tets[i]) append_raw(corners, std::int64_t{corner});
    append_raw(offsets, static_cast<std::int64_t>(4 * (i + 1)));
  }
  std::string text =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n"
      "  <UnstructuredGrid>\n    <Piece NumberOfPoints=\"";
  append_number(text, mesh.vertices.size());
  text += "\" NumberOfCells=\"";
  append_number(text, mesh.tets.size());
  text += "\">\n      <Points>\n";
  append_data_array(text, "type=\"Float32\" Name=\"Points\" NumberOfComponents=\"3\"", points);
  text += "      </Points>\n      <Cells>\n";
  append_data_array(text, "type=\"Int64\" Name=\"connectivity\"", corners);
  append_data_array(text, "type=\"Int64\" Name=\"offsets\"", offsets);
  append_data_array(text, "type=\"UInt8\" Name=\"types\"", std::string(mesh.tets.size(), '\x0A'));
  text += "      </Cells>\n    </Piece>\n  </UnstructuredGrid>\n</VTKFile>\n";
  return text;
}

std::string medit_text(const TetMesh& mesh) {
  std::string text = text_for(mesh);
  text += "MeshVersionFormatted 2\nDimension 3\n\nVertices\n";
  append_line(text, mesh.vertices.size());
  for (const Vec3& v : mesh.vertices) append_line(text, v.x, v.y, v.z, 0);
  text += "\nTetrahedra\n";
  append_line(text, mesh.tets.size());
  for (const Tet& t : mesh.tets) append_line(text, t[0] + 1, t[1] + 1, t[2] + 1, t[3] + 1, 1);
  text += "\nEnd\n";
  return text;
}

std::string tetgen_node_text(const TetMesh& mesh) {
  std::string text = text_for(mesh);
  append_line(text, mesh.vertices.size(), 3, 0, 0);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const Vec3& v = mesh.vertices[i];
    append_line(text, i, v.x, v.y, v.z);
  }
  return text;
}

std::string tetgen_ele_text(const TetMesh& mesh) {
  std::string text = text_for(mesh);
  append_line(text, mesh.tets.size(), 4, 0);
  for (std::size_t i = 0; i < mesh.tets.size(); ++i) {
    const Tet& t = mesh.tets[i];
    append_line(text, i, t[0], t[1], t[2], t[3]);
  }
  return text;
}

}  // namespace tetsoup
