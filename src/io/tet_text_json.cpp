// A tet mesh as JSON of flat arrays of numbers: what JavaScript turns into typed arrays and what Unity's and Godot's
// own readers take, which know no arrays within arrays. Numbers are written as in all other formats.
#include <array>
#include <cmath>
#include <concepts>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "base/origin.h"
#include "io/model_parts.h"
#include "io/number_text.h"
#include "io/text_capacity.h"
#include "io/tet_writers.h"
#include "tetsoup/quality.h"

namespace tetsoup {

namespace {

void append_value(std::string& text, std::uint32_t value) {
  append_number(text, value);
}
// JSON knows neither infinity nor NaN.
template <std::floating_point Real>
void append_value(std::string& text, Real value) {
  if (std::isfinite(value))
    append_number(text, value);
  else
    text += "null";
}
void append_value(std::string& text, const Vec3d& value) {
  append_value(text, value.x);
  text += ',';
  append_value(text, value.y);
  text += ',';
  append_value(text, value.z);
}
template <class Number, std::size_t size>
void append_value(std::string& text, const std::array<Number, size>& values) {
  for (std::size_t i = 0; i < size; ++i) {
    if (i > 0) text += ',';
    append_value(text, values[i]);
  }
}
// Quoted, with whatever is not UTF-8 replaced.
void append_value(std::string& text, std::string_view value) {
  text += nlohmann::json(value).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

void append_key(std::string& text, std::string_view key) {
  text += '"';
  text += key;
  text += "\": ";
}

template <class Value>
void append_member(std::string& text, std::string_view key, const Value& value) {
  append_key(text, key);
  append_value(text, value);
}

template <class Values>
void append_array(std::string& text, std::string_view key, const Values& values) {
  append_key(text, key);
  text += '[';
  bool first = true;
  for (const auto& value : values) {
    if (!first) text += ',';
    first = false;
    append_value(text, value);
  }
  text += ']';
}

void append_regions(std::string& text, const TetModel& model) {
  append_key(text, "regions");
  text += '[';
  for (const Region& region : model.regions) {
    text += &region == &model.regions.front() ? "{" : ", {";
    append_member(text, "name", std::string_view(region.name));
    append_member(text += ", ", "density", region.material.density);
    append_member(text += ", ", "young", region.material.young);
    append_member(text += ", ", "poisson", region.material.poisson);
    text += '}';
  }
  text += ']';
}

void append_pins(std::string& text, const TetModel& model) {
  append_key(text, "pins");
  text += '[';
  for (const VertexSet& pin : model.pins) {
    text += &pin == &model.pins.front() ? "{" : ", {";
    append_member(text, "name", std::string_view(pin.name));
    append_array(text += ", ", "vertices", pin.vertices);
    text += '}';
  }
  text += ']';
}

std::string_view name_of(UpAxis up) {
  return up == UpAxis::X ? "x" : up == UpAxis::Y ? "y" : "z";
}

}  // namespace

std::string json_text(const TetModel& model) {
  const std::string next = ",\n";
  std::string text = text_for(model.mesh);
  append_member(text += "{\n", "name", std::string_view(model.name));
  append_member(text += next, "up", name_of(model.up));
  append_member(text += next, "metres_per_unit", model.regions.front().material.metres_per_unit);
  append_array(text += next, "vertices", placed_points(model.mesh.vertices, model.mesh.origin));
  append_array(text += next, "tets", model.mesh.tets);
  append_array(text += next, "edges", unique_edges(model.mesh));
  append_array(text += next, "surface", boundary_triangles(model.mesh));
  append_regions(text += next, model);
  append_array(text += next, "tet_regions", model.tet_regions);
  if (!model.stiffness_scale.empty()) {
    append_member(text += next, "stiffness_factor", model.stiffness_factor);
    append_array(text += next, "stiffness_scale", model.stiffness_scale);
    append_array(text += next, "density_scale", model.density_scale);
  }
  append_pins(text += next, model);
  if (!model.render.face_sizes.empty()) {
    append_key(text += next, "render");
    append_array(text += "{\n", "vertices", placed_points(model.render.vertices, model.render.origin));
    append_array(text += next, "triangles", triangles_of(model.render).triangles);
    text += '}';
  }
  if (!model.embedding.tets.empty()) {
    append_key(text += next, "embedding");
    append_array(text += "{\n", "tets", model.embedding.tets);
    append_array(text += next, "weights", model.embedding.weights);
    text += '}';
  }
  return text + "\n}\n";
}

}  // namespace tetsoup
