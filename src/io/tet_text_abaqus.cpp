// The part of an input deck that describes a body, for Abaqus and CalculiX: what is left to add is a step.
#include <array>
#include <concepts>
#include <cstddef>
#include <span>
#include <string>

#include "base/tet_faces.h"
#include "io/line_writer.h"
#include "io/model_parts.h"
#include "io/number_text.h"
#include "io/text_capacity.h"
#include "io/tet_writers.h"

namespace tetsoup {

namespace {

constexpr std::size_t kPerLine = 8;  // Of 16 that both take.
// Their names of the faces opposite our vertices: S1 is 1-2-3, S2 1-4-2, S3 2-4-3, S4 3-4-1.
constexpr std::array<const char*, 4> kFaceNames{", S3\n", ", S4\n", ", S2\n", ", S1\n"};

// Neither reads more of a number, an exponent that stands behind that included.
constexpr std::size_t kFieldWidth = 20;

void append_field(std::string& text, double value) {
  append_number_within(text, value, kFieldWidth);
}
void append_field(std::string& text, std::integral auto value) {
  append_number(text, value);
}

template <class First, class... Rest>
void append_row(std::string& text, First first, Rest... rest) {
  append_field(text, first);
  ((text += ", ", append_field(text, rest)), ...);
  text += '\n';
}

void append_tets(std::string& text, const TetModel& model, const std::vector<std::uint32_t>& list,
                 const std::string& name) {
  const bool quadratic = !model.midsides.edges.empty();
  text += quadratic ? "*ELEMENT, TYPE=C3D10, ELSET=" : "*ELEMENT, TYPE=C3D4, ELSET=";
  text += name + '\n';
  if (quadratic) {
    const auto nodes = ten_nodes(model);
    for (const std::uint32_t i : list) {
      append_field(text, i + 1);
      for (const std::uint32_t node : nodes[i]) text += ", ", append_field(text, node + 1);
      text += '\n';
    }
    return;
  }
  for (const std::uint32_t i : list) {
    const Tet& t = model.mesh.tets[i];
    append_row(text, i + 1, t[0] + 1, t[1] + 1, t[2] + 1, t[3] + 1);
  }
}

void append_hull(std::string& text, const TetMesh& mesh) {
  text += "*SURFACE, NAME=HULL, TYPE=ELEMENT\n";
  const std::vector<TetFace> faces = sorted_faces(mesh);
  for (std::size_t begin = 0, end = 0; begin < faces.size(); begin = end) {
    end = face_run_end(faces, begin);
    if (end - begin > 1) continue;
    append_number(text, faces[begin].slot / 4 + 1);
    text += kFaceNames[faces[begin].slot % 4];
  }
}

void append_section(std::string& text, const std::string& name, const Material& material) {
  text += "*MATERIAL, NAME=" + name + "\n*ELASTIC\n";
  append_row(text, material.young, material.poisson);
  text += "*DENSITY\n";
  append_row(text, material.density);
  text += "*SOLID SECTION, ELSET=" + name + ", MATERIAL=" + name + '\n';
}

}  // namespace

std::string abaqus_text(const TetModel& model) {
  const TetMesh& mesh = model.mesh;
  std::string text = text_for(mesh);
  LegalNames legal({"NALL", "EALL", "HULL"});
  const std::vector<std::string> regions = region_names(model, legal), pins = pin_names(model, legal);
  text += "** tetsoup\n";
  if (model.stiffness_factor != 1)
    text += "** Calibrated: moduli and densities in steps, with which these tets move as many would.\n";
  text += "*NODE, NSET=NALL\n";
  const std::vector<Vec3d> nodes = placed_nodes(model);
  for (std::size_t i = 0; i < nodes.size(); ++i) append_row(text, i + 1, nodes[i].x, nodes[i].y, nodes[i].z);
  const auto lists = tets_by_region(model);
  for (std::size_t r = 0; r < lists.size(); ++r)
    if (!lists[r].empty()) append_tets(text, model, lists[r], regions[r]);
  text += "*ELSET, ELSET=EALL\n";
  for (std::size_t r = 0; r < lists.size(); ++r)
    if (!lists[r].empty()) text += regions[r] + '\n';
  for (std::size_t p = 0; p < pins.size(); ++p) {
    if (model.pins[p].vertices.empty()) continue;
    text += "*NSET, NSET=" + pins[p] + '\n';
    const std::vector<std::uint32_t> held = nodes_of(model, model.pins[p].vertices);
    append_list(text, std::span(held), 1U, kPerLine, ", ");
  }
  append_hull(text, mesh);
  for (std::size_t r = 0; r < lists.size(); ++r)
    if (!lists[r].empty()) append_section(text, regions[r], in_mesh_units(model.regions[r].material));
  return text;
}

}  // namespace tetsoup
