// Tet meshes as text that lists vertices and tets, one function per format. Corners stay in our order everywhere: all
// these formats take D = (b-a)x(c-a).(d-a) > 0 as positive. TetGen too: version 1.6 was seen to give only tets with
// D > 0.
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "base/origin.h"
#include "base/vec.h"
#include "io/model_parts.h"
#include "io/number_text.h"
#include "io/text_capacity.h"
#include "io/tet_writers.h"
#include "tetsoup/quality.h"

namespace tetsoup {

namespace {

/// A blank before each number, and the end of the line.
template <class Numbers>
void append_row(std::string& text, const Numbers& numbers) {
  for (const std::uint32_t number : numbers) {
    text += ' ';
    append_number(text, number);
  }
  text += '\n';
}

std::uint32_t gmsh_type(const TetModel& model) {
  return model.midsides.edges.empty() ? 4 : 11;
}

/// From 1; Gmsh has the last two of ten the other way round.
std::vector<std::vector<std::uint32_t>> gmsh_nodes(const TetModel& model) {
  std::vector<std::vector<std::uint32_t>> nodes;
  if (model.midsides.edges.empty()) {
    for (const Tet& t : model.mesh.tets) nodes.push_back({t[0] + 1, t[1] + 1, t[2] + 1, t[3] + 1});
    return nodes;
  }
  for (auto tet : ten_nodes(model)) {
    std::swap(tet[8], tet[9]);
    for (std::uint32_t& node : tet) ++node;
    nodes.emplace_back(tet.begin(), tet.end());
  }
  return nodes;
}

}  // namespace

// One entity, so one node block and one element block: MuJoCo takes no other.
std::string msh41_text(const TetModel& model) {
  const TetMesh& mesh = model.mesh;
  std::string text = text_for(mesh);
  const std::size_t nodes = mesh.vertices.size() + model.midsides.places.size(), tets = mesh.tets.size();
  const Box3 around = box_of(mesh.vertices), box{around.lo + mesh.origin, around.hi + mesh.origin};
  text += "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n0 0 0 1\n";
  append_line(text, 1, box.lo.x, box.lo.y, box.lo.z, box.hi.x, box.hi.y, box.hi.z, 0, 0);
  text += "$EndEntities\n$Nodes\n";
  append_line(text, 1, nodes, 1, nodes);
  append_line(text, 3, 1, 0, nodes);
  for (std::size_t i = 0; i < nodes; ++i) append_line(text, i + 1);
  for (const Vec3d& v : placed_nodes(model)) append_line(text, v.x, v.y, v.z);
  text += "$EndNodes\n$Elements\n";
  append_line(text, 1, tets, 1, tets);
  append_line(text, 3, 1, gmsh_type(model), tets);
  const auto nodes_of_tets = gmsh_nodes(model);
  for (std::size_t i = 0; i < tets; ++i) {
    append_number(text, i + 1);
    append_row(text, nodes_of_tets[i]);
  }
  text += "$EndElements\n";
  return text;
}

// The names stand last: some readers want the nodes right behind the header. SOFA makes groups of the last tag.
std::string msh22_text(const TetModel& model) {
  const TetMesh& mesh = model.mesh;
  std::string text = text_for(mesh);
  text += "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n";
  const std::vector<Vec3d> nodes = placed_nodes(model);
  append_line(text, nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) append_line(text, i + 1, nodes[i].x, nodes[i].y, nodes[i].z);
  text += "$EndNodes\n$Elements\n";
  append_line(text, mesh.tets.size());
  const auto nodes_of_tets = gmsh_nodes(model);
  for (std::size_t i = 0; i < mesh.tets.size(); ++i) {
    const std::uint32_t tag = region_of(model, i) + 1;
    append_number(text, i + 1);
    append_row(text, std::array{gmsh_type(model), 2U, tag, tag});
    text.pop_back();
    append_row(text, nodes_of_tets[i]);
  }
  text += "$EndElements\n";
  if (!has_regions(model)) return text;
  text += "$PhysicalNames\n";
  append_line(text, model.regions.size());
  LegalNames names;
  std::size_t tag = 0;
  for (const std::string& name : region_names(model, names)) {
    text += "3 ";
    append_number(text, ++tag);
    text += " \"" + name + "\"\n";
  }
  return text + "$EndPhysicalNames\n";
}

std::string medit_text(const TetModel& model) {
  const TetMesh& mesh = model.mesh;
  std::string text = text_for(mesh);
  const std::vector<std::uint32_t> marks = pin_marks(model);
  text += "MeshVersionFormatted 2\nDimension 3\n\nVertices\n";
  append_line(text, mesh.vertices.size());
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const Vec3d v = placed(mesh.vertices[i], mesh.origin);
    append_line(text, v.x, v.y, v.z, marks[i]);
  }
  text += "\nTetrahedra\n";
  append_line(text, mesh.tets.size());
  for (std::size_t i = 0; i < mesh.tets.size(); ++i) {
    const Tet& t = mesh.tets[i];
    append_line(text, t[0] + 1, t[1] + 1, t[2] + 1, t[3] + 1, region_of(model, i) + 1);
  }
  text += "\nEnd\n";
  return text;
}

std::string tetgen_node_text(const TetModel& model) {
  const TetMesh& mesh = model.mesh;
  std::string text = text_for(mesh);
  const bool marked = !model.pins.empty();
  const std::vector<std::uint32_t> marks = pin_marks(model);
  append_line(text, mesh.vertices.size(), 3, 0, marked ? 1 : 0);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const Vec3d v = placed(mesh.vertices[i], mesh.origin);
    if (marked)
      append_line(text, i, v.x, v.y, v.z, marks[i]);
    else
      append_line(text, i, v.x, v.y, v.z);
  }
  return text;
}

std::string tetgen_ele_text(const TetModel& model) {
  const TetMesh& mesh = model.mesh;
  std::string text = text_for(mesh);
  append_line(text, mesh.tets.size(), 4, has_regions(model) ? 1 : 0);
  for (std::size_t i = 0; i < mesh.tets.size(); ++i) {
    const Tet& t = mesh.tets[i];
    if (has_regions(model))
      append_line(text, i, t[0], t[1], t[2], t[3], region_of(model, i) + 1);
    else
      append_line(text, i, t[0], t[1], t[2], t[3]);
  }
  return text;
}

std::string tetgen_face_text(const TetModel& model) {
  const std::vector<Triangle> faces = boundary_triangles(model.mesh);
  std::string text;
  append_line(text, faces.size(), 1);
  for (std::size_t i = 0; i < faces.size(); ++i) append_line(text, i, faces[i][0], faces[i][1], faces[i][2], 1);
  return text;
}

std::string isaacgym_text(const TetModel& model) {
  std::string text = text_for(model.mesh);
  text += "# tetsoup\n";
  for (const Vec3d& v : placed_points(model.mesh.vertices, model.mesh.origin)) {
    text += "v ";
    append_line(text, v.x, v.y, v.z);
  }
  for (const Tet& t : model.mesh.tets) {
    text += "t ";
    append_line(text, t[0], t[1], t[2], t[3]);
  }
  return text;
}

std::string obj_tets_text(const TetModel& model) {
  std::string text = text_for(model.mesh);
  LegalNames object, groups;
  text += "# tetsoup: every face is a tet\no " + object.make(model.name, "body") + '\n';
  for (const Vec3d& v : placed_points(model.mesh.vertices, model.mesh.origin)) {
    text += "v ";
    append_line(text, v.x, v.y, v.z);
  }
  const std::vector<std::string> names = region_names(model, groups);
  const auto lists = tets_by_region(model);
  for (std::size_t region = 0; region < lists.size(); ++region) {
    if (has_regions(model)) text += "g " + names[region] + '\n';
    for (const std::uint32_t i : lists[region]) {
      const Tet& t = model.mesh.tets[i];
      text += "f ";
      append_line(text, t[0] + 1, t[1] + 1, t[2] + 1, t[3] + 1);
    }
  }
  return text;
}

}  // namespace tetsoup
