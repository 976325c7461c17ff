#include "part_labels.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "report_json.h"
#include "tetsoup/io.h"
#include "tetsoup/regions.h"

namespace tetsoup::cli {

namespace {

const std::string& name_of(const RenderMesh::Part& part, RegionsBy by) {
  return by == RegionsBy::Object ? part.object : by == RegionsBy::Group ? part.group : part.material;
}

}  // namespace

const char* word_of(RegionsBy by) {
  return by == RegionsBy::Object  ? "object"
         : by == RegionsBy::Group ? "group"
         : by == RegionsBy::Part  ? "part"
                                  : "material";
}

PartLabels connected_parts(const TriangleSoup& soup) {
  PartLabels parts;
  parts.of_triangles = label_parts(soup);
  std::uint32_t count = 0;
  for (const std::uint32_t label : parts.of_triangles) count = std::max(count, label + 1);
  for (std::uint32_t i = 0; i < count; ++i) parts.names.push_back(fmt::format("part_{}", i + 1));
  return parts;
}

PartLabels label_by(const RenderMesh& surface, RegionsBy by, const std::string& rest) {
  PartLabels labels;
  std::map<std::string, std::uint32_t> known;
  bool some_without = false;
  for (const RenderMesh::Part& part : surface.parts) {
    const std::string& name = name_of(part, by);
    if (name.empty()) {
      some_without = true;
    } else if (known.emplace(name, labels.names.size()).second) {
      labels.names.push_back(name);
    }
  }
  const auto last = static_cast<std::uint32_t>(labels.names.size());
  if (some_without || labels.names.empty()) labels.names.push_back(rest);
  labels.of_triangles = triangle_faces(surface);
  for (std::uint32_t& l : labels.of_triangles) {
    const std::string& name = name_of(surface.parts[surface.face_parts[l]], by);
    l = name.empty() ? last : known.at(name);
  }
  return labels;
}

std::vector<std::uint32_t> find_part(const RenderMesh& surface, const std::string& name) {
  bool found = false;
  std::vector<std::uint32_t> labels = triangle_faces(surface);
  for (std::uint32_t& l : labels) {
    const RenderMesh::Part& part = surface.parts[surface.face_parts[l]];
    l = part.object == name || part.group == name || part.material == name ? 0 : 1;
    found = found || l == 0;
  }
  if (found) return labels;
  const PartLabels parts = connected_parts(triangles_of(surface));
  const auto place = std::find(parts.names.begin(), parts.names.end(), name);
  if (place == parts.names.end()) return {};
  const auto wanted = static_cast<std::uint32_t>(place - parts.names.begin());
  for (std::size_t t = 0; t < labels.size(); ++t) labels[t] = parts.of_triangles[t] == wanted ? 0 : 1;
  return labels;
}

std::string known_names(const RenderMesh& surface) {
  constexpr std::size_t kMost = 12;
  const std::vector<PartName> names = part_names(surface);
  const std::size_t parts = connected_parts(triangles_of(surface)).names.size();
  std::string text = "; it has";
  for (std::size_t i = 0; i < std::min(names.size(), kMost); ++i)
    text += fmt::format(" {} '{}',", kind_name(names[i].kind), names[i].name);
  if (names.size() > kMost) text += fmt::format(" {} names more,", names.size() - kMost);
  if (names.empty()) text += " no objects, groups or materials, but";
  return text + (parts == 1 ? " connected part_1" : fmt::format(" connected part_1 to part_{}", parts));
}

}  // namespace tetsoup::cli
