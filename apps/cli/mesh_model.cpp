#include "mesh_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "files.h"
#include "summary.h"
#include "tetsoup/error.h"

namespace tetsoup::cli {

namespace {

UpAxis usual_up_axis(const std::filesystem::path& input) {
  const std::string extension = lower_extension(input);
  return extension == ".obj" || extension == ".gltf" || extension == ".glb" ? UpAxis::Y : UpAxis::Z;
}

/// Keeps regions that have tets: of thousands of loose leaves most have none.
void drop_empty_regions(PartLabels& labels, std::vector<std::uint32_t>& tet_regions) {
  std::vector<std::uint32_t> new_names(labels.names.size(), 0);
  for (const std::uint32_t region : tet_regions) new_names[region] = 1;
  std::vector<std::string> kept;
  for (std::size_t r = 0; r < new_names.size(); ++r) {
    if (new_names[r] == 0) continue;
    new_names[r] = static_cast<std::uint32_t>(kept.size());
    kept.push_back(labels.names[r]);
  }
  for (std::uint32_t& region : tet_regions) region = new_names[region];
  labels.names = std::move(kept);
}

PartLabels region_labels(const TetModel& model, RegionsBy by, const TriangleSoup& soup) {
  return by == RegionsBy::Part ? connected_parts(soup) : label_by(model.render, by, model.name);
}

void set_regions(TetModel& model, const ModelOptions& options, const Material& material, PartLabels labels,
                 const TriangleSoup& soup, const Progress& progress) {
  model.tet_regions = label_tets(model.mesh, soup, labels.of_triangles, progress);
  if (options.regions_by == RegionsBy::Part) drop_empty_regions(labels, model.tet_regions);
  model.regions.clear();
  for (const std::string& name : labels.names) {
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
  const auto labels = find_part(model.render, name);
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
  if (!options.materials.empty()) {
    if (!options.regions_by)
      throw InvalidInput("--region: needs --regions object, group, material or part, which says what makes a region");
    const PartLabels labels = options.regions_by == RegionsBy::Part ? connected_parts(triangles_of(surface))
                                                                    : label_by(surface, *options.regions_by, "");
    for (const RegionWish& wish : options.materials)
      if (std::find(labels.names.begin(), labels.names.end(), wish.name) == labels.names.end())
        throw InvalidInput(fmt::format("--region: the model has no {} '{}'{}", word_of(*options.regions_by), wish.name,
                                       known_names(surface)));
  }
  for (const PinWish& pin : options.pins)
    if (!pin.choose && find_part(surface, pin.name).empty())
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
  PartLabels labels;
  if (options.regions_by) labels = region_labels(model, *options.regions_by, soup);
  if (options.regions_by && options.fit_regions)
    model.mesh = fit_to_labels(model.mesh, soup, labels.of_triangles, run.options.smooth, bar.callback());
  if (!soup.vertices.empty()) model.embedding = embed_points(model.mesh, soup, {}, bar.callback());
  if (options.regions_by) set_regions(model, options, run.material, std::move(labels), soup, bar.callback());
  if (options.order == Order::Quadratic)
    model.midsides = place_midsides(model.mesh, run.pipeline->soup().soup, bar.callback());
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
  if (!model.midsides.edges.empty()) {
    const Midsides& midsides = model.midsides;
    text += fmt::format("Ten-node tets: {} of edges, {} of them on the surface", counted(midsides.edges.size(), "node"),
                        grouped(midsides.moved));
    if (midsides.held_back > 0)
      text += fmt::format("; {} held back, where tets would be too crooked", grouped(midsides.held_back));
    text += ".\n";
  }
  if (!model.tet_regions.empty()) {
    const std::vector<RegionSize> sizes = region_sizes(model);
    text += "Regions:";
    constexpr std::size_t kMost = 12;
    const std::size_t shown = std::min(sizes.size(), kMost);
    for (std::size_t r = 0; r < shown; ++r)
      text += fmt::format("{} {} ({}, volume {:.4g}, {:.4g} kg)", r == 0 ? "" : ",", model.regions[r].name,
                          counted(sizes[r].tet_count, "tet"), sizes[r].volume, sizes[r].mass);
    text += sizes.size() > shown ? fmt::format(" and {} more.\n", grouped(sizes.size() - shown)) : ".\n";
    if (sizes.size() == 1) text += "Note: nothing in the model tells regions apart that way; all tets are one.\n";
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
