// Tet meshes for VTK: the legacy format and XML.
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/base64.h"
#include "base/origin.h"
#include "io/model_parts.h"
#include "io/number_text.h"
#include "io/raw_numbers.h"
#include "io/text_capacity.h"
#include "io/tet_writers.h"

namespace tetsoup {

namespace {

void append_scalars(std::string& text, const std::string& name, const std::string& type) {
  text += "SCALARS " + name + " " + type + " 1\nLOOKUP_TABLE default\n";
}

/// What a calibrated model says of its tets, by name.
std::vector<std::pair<std::string, const std::vector<float>*>> scale_arrays(const TetModel& model) {
  std::vector<std::pair<std::string, const std::vector<float>*>> arrays;
  if (!model.stiffness_scale.empty()) arrays.emplace_back("stiffness_scale", &model.stiffness_scale);
  if (!model.density_scale.empty()) arrays.emplace_back("density_scale", &model.density_scale);
  return arrays;
}

/// Floats are too coarse then.
bool is_far(const TetMesh& mesh) {
  return !(mesh.origin == Vec3d{});
}

std::size_t node_count(const TetModel& model) {
  return model.mesh.vertices.size() + model.midsides.places.size();
}

std::vector<std::uint8_t> members(const VertexSet& set, const TetModel& model) {
  std::vector<std::uint8_t> is_member(node_count(model));
  for (const std::uint32_t node : nodes_of(model, set.vertices)) is_member[node] = 1;
  return is_member;
}

constexpr char kTet = 10, kTenNodeTet = 24;  // Types of cells.

/// Calls visit(nodes) for every tet.
template <class Visit>
void visit_cells(const TetModel& model, const Visit& visit) {
  if (model.midsides.edges.empty())
    for (const Tet& tet : model.mesh.tets) visit(std::span<const std::uint32_t>(tet));
  else
    for (const auto& nodes : ten_nodes(model)) visit(std::span<const std::uint32_t>(nodes));
}

std::vector<std::string> pin_array_names(const TetModel& model) {
  LegalNames names;
  std::vector<std::string> made;
  for (const std::string& name : pin_names(model, names)) made.push_back("pin_" + name);
  return made;
}

void append_data(std::string& text, const TetModel& model) {
  const bool scaled = !model.stiffness_scale.empty() || !model.density_scale.empty();
  if (has_regions(model) || scaled) {
    text += "CELL_DATA ";
    append_line(text, model.mesh.tets.size());
  }
  if (has_regions(model)) {
    append_scalars(text, "region", "int");
    for (std::size_t i = 0; i < model.mesh.tets.size(); ++i) append_line(text, region_of(model, i));
  }
  for (const auto& [name, scales] : scale_arrays(model)) {
    append_scalars(text, name, "float");
    for (const float scale : *scales) append_line(text, scale);
  }
  if (model.pins.empty()) return;
  text += "POINT_DATA ";
  append_line(text, node_count(model));
  const std::vector<std::string> names = pin_array_names(model);
  for (std::size_t i = 0; i < names.size(); ++i) {
    append_scalars(text, names[i], "int");
    for (const std::uint8_t is_member : members(model.pins[i], model)) append_line(text, static_cast<int>(is_member));
  }
}

void append_data_array(std::string& text, const std::string& attributes, const std::string& bytes) {
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

void append_xml_data(std::string& text, const TetModel& model) {
  if (!model.pins.empty()) {
    text += "      <PointData>\n";
    const std::vector<std::string> names = pin_array_names(model);
    for (std::size_t i = 0; i < names.size(); ++i) {
      const std::vector<std::uint8_t> is_member = members(model.pins[i], model);
      append_data_array(text, "type=\"UInt8\" Name=\"" + names[i] + '"', {is_member.begin(), is_member.end()});
    }
    text += "      </PointData>\n";
  }
  const auto scales = scale_arrays(model);
  if (!has_regions(model) && scales.empty()) return;
  text += has_regions(model) ? "      <CellData Scalars=\"region\">\n" : "      <CellData>\n";
  if (has_regions(model)) {
    std::string regions;
    for (std::size_t i = 0; i < model.mesh.tets.size(); ++i)
      append_raw(regions, static_cast<std::int32_t>(region_of(model, i)));
    append_data_array(text, "type=\"Int32\" Name=\"region\"", regions);
  }
  for (const auto& [name, values] : scales) {
    std::string raw;
    for (const float scale : *values) append_raw(raw, scale);
    append_data_array(text, "type=\"Float32\" Name=\"" + name + '"', raw);
  }
  text += "      </CellData>\n";
}

}  // namespace

// Bullet reads points and cells line by line and nothing newer; behind CELL_TYPES it looks at no line any more.
std::string vtk_text(const TetModel& model) {
  const TetMesh& mesh = model.mesh;
  std::string text = text_for(mesh);
  text += "# vtk DataFile Version 3.0\ntetsoup\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS ";
  append_number(text, node_count(model));
  text += is_far(mesh) ? " double\n" : " float\n";
  for (const Vec3d& v : placed_nodes(model)) append_line(text, v.x, v.y, v.z);
  text += "CELLS ";
  const bool linear = model.midsides.edges.empty();
  append_line(text, mesh.tets.size(), (linear ? 5 : 11) * mesh.tets.size());
  visit_cells(model, [&](std::span<const std::uint32_t> nodes) {
    append_number(text, nodes.size());
    for (const std::uint32_t node : nodes) text += ' ', append_number(text, node);
    text += '\n';
  });
  text += "CELL_TYPES ";
  append_line(text, mesh.tets.size());
  for (std::size_t i = 0; i < mesh.tets.size(); ++i) append_line(text, static_cast<int>(linear ? kTet : kTenNodeTet));
  append_data(text, model);
  return text;
}

std::string vtu_text(const TetModel& model) {
  const TetMesh& mesh = model.mesh;
  std::string points, corners, offsets;
  for (const Vec3d& v : placed_nodes(model)) {
    for (const double coordinate : {v.x, v.y, v.z})
      is_far(mesh) ? append_raw(points, coordinate) : append_raw(points, static_cast<float>(coordinate));
  }
  std::int64_t offset = 0;
  visit_cells(model, [&](std::span<const std::uint32_t> nodes) {
    for (const std::uint32_t node : nodes) append_raw(corners, std::int64_t{node});
    append_raw(offsets, offset += static_cast<std::int64_t>(nodes.size()));
  });
  std::string text =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n"
      "  <UnstructuredGrid>\n    <Piece NumberOfPoints=\"";
  append_number(text, node_count(model));
  text += "\" NumberOfCells=\"";
  append_number(text, mesh.tets.size());
  text += "\">\n";
  append_xml_data(text, model);
  text += "      <Points>\n";
  const std::string type = is_far(mesh) ? "type=\"Float64\"" : "type=\"Float32\"";
  append_data_array(text, type + " Name=\"Points\" NumberOfComponents=\"3\"", points);
  text += "      </Points>\n      <Cells>\n";
  append_data_array(text, "type=\"Int64\" Name=\"connectivity\"", corners);
  append_data_array(text, "type=\"Int64\" Name=\"offsets\"", offsets);
  append_data_array(text, "type=\"UInt8\" Name=\"types\"",
                    std::string(mesh.tets.size(), model.midsides.edges.empty() ? kTet : kTenNodeTet));
  text += "      </Cells>\n    </Piece>\n  </UnstructuredGrid>\n</VTKFile>\n";
  return text;
}

}  // namespace tetsoup
