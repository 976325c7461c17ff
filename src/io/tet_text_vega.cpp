// Vega FEM's volumetric meshes, and the list of vertices that its drivers hold.
#include <span>
#include <string>

#include "io/line_writer.h"
#include "io/model_parts.h"
#include "io/number_text.h"
#include "io/text_capacity.h"
#include "io/tet_writers.h"

namespace tetsoup {

namespace {

constexpr std::size_t kPerLine = 8;                 // As Vega writes; its reader takes 1023 characters a line.
constexpr const char* kEverything = "allElements";  // A set that its reader makes itself.

void append_material(std::string& text, const std::string& name, const Material& material) {
  text += "\n*MATERIAL " + name + "\nENU, ";
  append_number(text, material.density);
  text += ", ";
  append_number(text, material.young);
  text += ", ";
  append_number(text, material.poisson);
  text += '\n';
}

}  // namespace

std::string vega_text(const TetModel& model) {
  const TetMesh& mesh = model.mesh;
  std::string text = text_for(mesh);
  text += "# tetsoup\n";
  if (model.stiffness_factor != 1)
    text += "# Calibrated: moduli and densities in steps, with which these tets move as many would.\n";
  text += "\n*VERTICES\n";
  append_line(text, mesh.vertices.size(), 3, 0, 0);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const Vec3d v = placed(mesh.vertices[i], mesh.origin);
    append_line(text, i + 1, v.x, v.y, v.z);
  }
  text += "\n*ELEMENTS\nTET\n";
  append_line(text, mesh.tets.size(), 4, 0);
  for (std::size_t i = 0; i < mesh.tets.size(); ++i) {
    const Tet& t = mesh.tets[i];
    append_line(text, i + 1, t[0] + 1, t[1] + 1, t[2] + 1, t[3] + 1);
  }
  LegalNames legal({kEverything});
  const std::vector<std::string> names = region_names(model, legal);
  for (std::size_t r = 0; r < names.size(); ++r)
    append_material(text, names[r], in_mesh_units(model.regions[r].material));
  const auto lists = tets_by_region(model);
  for (std::size_t r = 0; has_regions(model) && r < names.size(); ++r) {
    if (lists[r].empty()) continue;
    text += "\n*SET " + names[r] + '\n';
    append_list(text, std::span(lists[r]), 1U, kPerLine, ",");
  }
  for (std::size_t r = 0; r < names.size(); ++r)
    if (!has_regions(model) || !lists[r].empty())
      text += "\n*REGION\n" + (has_regions(model) ? names[r] : kEverything) + ", " + names[r] + '\n';
  return text;
}

std::string vega_pins_text(const TetModel& model) {
  std::string text;
  const std::vector<std::uint32_t> pinned = pinned_vertices(model);
  append_list(text, std::span(pinned), 1U, kPerLine, ",");
  return text;
}

}  // namespace tetsoup
