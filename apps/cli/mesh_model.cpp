#include "mesh_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "files.h"
#include "report_json.h"
#include "summary.h"
#include "tetsoup/error.h"

namespace tetsoup::cli {

namespace {

UpAxis usual_up_axis(const std::filesystem::path& input) {
  const std::string extension = lower_extension(input);
  return extension == ".obj" || extension == ".gltf" || extension == ".glb" ? UpAxis::Y : UpAxis::Z;
}

const std::string& name_of(const RenderMesh::Part& part, PartKind kind) {
  return kind == PartKind::Object ? part.object : kind == PartKind::Group ? part.group : part.material;
}

/// " (objects: a, b; materials: c)", as far as a line holds them.
std::string known_names(const RenderMesh& surface) {
  constexpr std::size_t kMost = 12;
  const std::vector<PartName> names = part_names(surface);
  if (names.empty()) return "; the model names no objects, groups or materials";
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kMost); ++i)
    text += fmt::format("{} {} '{}'", i == 0 ? "; it has" : ",", kind_name(names[i].kind), names[i].name);
  return names.size() > kMost ? text + fmt::format(" and {} more: tetsoup inspect", names.size() - kMost) : text;
}

bool has_part(const RenderMesh& surface, const std::string& name) {
  return std::any_of(surface.parts.begin(), surface.parts.end(), [&](const RenderMesh::Part& part) {
    return part.object == name || part.group == name || part.material == name;
  });
}

/// A number for every face: of its region's name in the order of the file, faces without one last.
struct FaceRegions {
  std::vector<std::string> names;
  std::vector<std::uint32_t> of_part;
};

FaceRegions regions_of(const RenderMesh& surface, PartKind kind, const std::string& rest) {
  FaceRegions regions;
  std::map<std::string, std::uint32_t> known;
  bool some_without = false;
  for (const RenderMesh::Part& part : surface.parts) {
    const std::string& name = name_of(part, kind);
    if (name.empty()) {
      some_without = true;
    } else if (known.emplace(name, regions.names.size()).second) {
      regions.names.push_back(name);
    }
  }
  const auto last = static_cast<std::uint32_t>(regions.names.size());
  if (some_without || regions.names.empty()) regions.names.push_back(rest);
  for (const RenderMesh::Part& part : surface.parts)
    regions.of_part.push_back(name_of(part, kind).empty() ? last : known.at(name_of(part, kind)));
  return regions;
}

/// A label for every triangle from one for every part.
template <class Label>
std::vector<std::uint32_t> triangle_labels(const RenderMesh& surface, const Label& label) {
  std::vector<std::uint32_t> labels = triangle_faces(surface);
  for (std::uint32_t& l : labels) l = label(surface.face_parts[l]);
  return labels;
}

void set_regions(TetModel& model, const ModelOptions& options, const Material& material, const TriangleSoup& soup,
                 const Progress& progress) {
  const FaceRegions regions = regions_of(model.render, *options.regions_by, model.name);
  const auto labels = triangle_labels(model.render, [&](std::uint32_t part) { return regions.of_part[part]; });
  model.tet_regions = label_tets(model.mesh, soup, labels, progress);
  model.regions.clear();
  for (const std::string& name : regions.names) {
    Region region{name, material};
    for (const RegionWish& wish : options.materials) {
      if (wish.name != name) continue;
      region.material.density = wish.density.value_or(region.material.density);
      region.material.young = wish.young.value_or(region.material.young);
      region.material.poisson = wish.poisson.value_or(region.material.poisson);
    }
    model.regions.push_back(region);
  }
}

std::vector<std::uint32_t> vertices_near(const TetModel& model, const std::string& name, const TriangleSoup& soup,
                                         const Progress& progress) {
  const auto labels = triangle_labels(model.render, [&](std::uint32_t p) -> std::uint32_t {
    const RenderMesh::Part& part = model.render.parts[p];
    return part.object == name || part.group == name || part.material == name ? 0 : 1;
  });
  const std::vector<std::uint32_t> nearest = label_vertices(model.mesh, soup, labels, progress);
  std::vector<std::uint32_t> vertices;
  for (std::uint32_t v = 0; v < nearest.size(); ++v)
    if (nearest[v] == 0) vertices.push_back(v);
  return vertices;
}

}  // namespace

bool wants_surface(const ModelOptions& options, bool format_holds_surface) {
  const bool pins_by_name =
      std::any_of(options.pins.begin(), options.pins.end(), [](const PinWish& pin) { return !pin.choose; });
  return format_holds_surface || options.embed || options.regions_by || pins_by_name;
}

void check_names(const ModelOptions& options, const RenderMesh& surface) {
  if (!options.materials.empty() && !options.regions_by)
    throw InvalidInput("--region: needs --regions object, group or material, which says what makes a region");
  for (const RegionWish& wish : options.materials) {
    const std::vector<PartName> names = part_names(surface);
    if (std::none_of(names.begin(), names.end(),
                     [&](const PartName& part) { return part.kind == *options.regions_by && part.name == wish.name; }))
      throw InvalidInput(fmt::format("--region: the model has no {} '{}'{}", kind_name(*options.regions_by), wish.name,
                                     known_names(surface)));
  }
  for (const PinWish& pin : options.pins)
    if (!pin.choose && !has_part(surface, pin.name))
      throw InvalidInput(fmt::format("--pin-part: the model has no part '{}'{}", pin.name, known_names(surface)));
}

TetModel make_model(const MeshRun& run, const ModelOptions& options, RenderMesh surface, ProgressBar& bar) {
  TetModel model;
  model.name = std::filesystem::path(run.input).stem().string();
  model.mesh = run.pipeline->smooth().mesh;
  model.regions = {{model.name, run.material}};
  model.up = options.up.value_or(usual_up_axis(run.input));
  model.render = std::move(surface);
  const TriangleSoup soup = triangles_of(model.render);
  if (!soup.vertices.empty()) model.embedding = embed_points(model.mesh, soup, {}, bar.callback());
  if (options.regions_by) set_regions(model, options, run.material, soup, bar.callback());
  for (const PinWish& pin : options.pins)
    model.pins.push_back(
        {pin.name, pin.choose ? pin.choose(model.mesh) : vertices_near(model, pin.name, soup, bar.callback())});
  return model;
}

std::string describe_model(const TetModel& model) {
  std::string text;
  if (!model.embedding.tets.empty()) {
    const EmbedReport& report = model.embedding.report;
    text += fmt::format("Embedding: {} of the model in the tets, {} outside", counted(report.inside, "vertex"),
                        grouped(report.outside));
    if (report.outside > 0)
      text += fmt::format(", at most {:.3g} away (--enclose has none outside)", report.max_distance);
    if (report.drawn_closer > 0)
      text += fmt::format("; {} too far off were drawn closer", grouped(report.drawn_closer));
    if (report.non_finite > 0) text += fmt::format("; {} are no points", grouped(report.non_finite));
    text += ".\n";
  }
  if (!model.tet_regions.empty()) {
    std::vector<std::size_t> tets(model.regions.size(), 0);
    for (const std::uint32_t region : model.tet_regions) ++tets[region];
    text += "Regions:";
    for (std::size_t r = 0; r < tets.size(); ++r)
      text += fmt::format("{} {} ({})", r == 0 ? "" : ",", model.regions[r].name, counted(tets[r], "tet"));
    text += ".\n";
    if (tets.size() == 1) text += "Note: the model names nothing that makes regions; all tets are one.\n";
  }
  for (const VertexSet& pins : model.pins) {
    text += fmt::format("Pins '{}': {} held.\n", pins.name, counted(pins.vertices.size(), "vertex"));
    if (pins.vertices.empty())
      text += fmt::format("Note: '{}' holds nothing; compare its numbers with the mesh's box (tetsoup inspect).\n",
                          pins.name);
  }
  return text;
}

}  // namespace tetsoup::cli
