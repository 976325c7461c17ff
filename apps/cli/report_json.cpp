#include "report_json.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "angles.h"
#include "readiness_page.h"
#include "tetsoup/progress.h"

namespace tetsoup::cli {

namespace {

using Json = nlohmann::ordered_json;  // writes NaN and infinity as null

Json vector_json(const Vec3d& v) {
  return Json::array({v.x, v.y, v.z});
}

Json degrees_json(const Vec3d& v) {
  return vector_json({to_degrees(v.x), to_degrees(v.y), to_degrees(v.z)});
}

template <class T>
Json optional_json(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json soup_json(const SoupReport& soup) {
  Json box = nullptr;
  if (soup.kind != SoupClass::Empty) box = {{"lo", vector_json(soup.box.lo)}, {"hi", vector_json(soup.box.hi)}};
  return {{"class", class_name(soup.kind)},
          {"vertex_count", soup.vertex_count},
          {"triangle_count", soup.triangle_count},
          {"index_out_of_range", soup.index_out_of_range},
          {"non_finite", soup.non_finite},
          {"duplicates", soup.duplicates},
          {"zero_area", soup.zero_area},
          {"used_triangles", soup.used_triangles},
          {"merged_vertices", soup.merged_vertices},
          {"components", soup.components},
          {"boundary_edges", soup.boundary_edges},
          {"non_manifold_edges", soup.non_manifold_edges},
          {"inconsistent_edges", soup.inconsistent_edges},
          {"box", box}};
}

Json quality_json(const Quality& quality) {
  return {{"vertex_count", quality.vertex_count},
          {"tet_count", quality.tet_count},
          {"inverted_tets", quality.inverted_tets},
          {"invalid_tets", quality.invalid_tets},
          {"unused_vertices", quality.unused_vertices},
          {"volume", quality.volume},
          {"min_tet_volume", quality.min_tet_volume},
          {"max_tet_volume", quality.max_tet_volume},
          {"min_dihedral_deg", to_degrees(quality.min_dihedral)},
          {"max_dihedral_deg", to_degrees(quality.max_dihedral)},
          {"min_dihedral_p1_deg", to_degrees(quality.min_dihedral_p1)},
          {"volume_variation", quality.volume_variation},
          {"dihedral_histogram", quality.dihedral_histogram},
          {"max_edge_ratio", quality.max_edge_ratio},
          {"mean_ratio_min", quality.mean_ratio_min},
          {"mean_ratio_mean", quality.mean_ratio_mean},
          {"components", quality.components},
          {"boundary_triangles", quality.boundary_triangles},
          {"boundary_vertices", quality.boundary_vertices},
          {"boundary_closed", quality.boundary_closed},
          {"non_manifold_edges", quality.non_manifold_edges},
          {"non_manifold_vertices", quality.non_manifold_vertices},
          {"boundary_manifold", quality.boundary_manifold},
          {"boundary_only_tets", quality.boundary_only_tets},
          {"boundary_only_faces", quality.boundary_only_faces},
          {"boundary_only_edges", quality.boundary_only_edges},
          {"roughness_deg", to_degrees(quality.roughness)},
          {"boundary_area", quality.boundary_area},
          {"boundary_curvature", quality.boundary_curvature}};
}

Json seconds_json(const Timings& seconds) {
  return {{"read", seconds.read},         {"soup", seconds.soup},
          {"distance", seconds.distance}, {"pseudo_volume", seconds.pseudo_volume},
          {"lattice", seconds.lattice},   {"smooth", seconds.smooth},
          {"quality", seconds.quality},   {"preview", seconds.preview},
          {"write", seconds.write},       {"total", seconds.total}};
}

Json grid_json(const DistanceField& field) {
  const GridFrame& frame = field.distance.frame;
  return {{"size", frame.size},
          {"pad", frame.pad},
          {"origin", vector_json(frame.origin)},
          {"voxel_size", frame.voxel_size},
          {"d_max", field.d_max},
          {"memory_bytes", grid_memory(frame)}};
}

Json pseudo_volume_json(const PseudoVolumeReport& report) {
  Json candidates = Json::array();
  for (const BandScore& candidate : report.candidates)
    candidates.push_back(
        {{"band_voxels", candidate.band_voxels}, {"score", candidate.score}, {"consensus", candidate.consensus}});
  return {{"k", report.k},
          {"band", report.band},
          {"band_voxels", report.band_voxels},
          {"automatic", report.automatic},
          {"floored", report.floored},
          {"largest_closure", report.largest_closure},
          {"inside_voxels", report.inside_voxels},
          {"cavity_voxels", report.cavity_voxels},
          {"volume", report.volume},
          {"consensus", report.consensus},
          {"soup_covered", report.soup_covered},
          {"candidates", candidates}};
}

Json topology_json(const TopologyReport& report) {
  return {{"touching_mended", report.touching_mended},
          {"tets_added", report.tets_added},
          {"tets_dropped", report.tets_dropped},
          {"vertices_doubled", report.vertices_doubled},
          {"parts_dropped", report.parts_dropped},
          {"dropped_volume", report.dropped_volume},
          {"bubbles_filled", report.bubbles_filled},
          {"bubble_tets", report.bubble_tets},
          {"boundary_only_tets", report.boundary_only_tets},
          {"boundary_only_edges", report.boundary_only_edges}};
}

Json lattice_json(const LatticeReport& report) {
  return {{"cells", report.cells},
          {"cell_size", report.cell_size},
          {"mean_edge", report.mean_edge},
          {"used_cells", report.used_cells},
          {"tet_count", report.tet_count},
          {"sampled_tets", report.sampled_tets},
          {"kept_volume", report.kept_volume},
          {"pseudo_volume", report.pseudo_volume},
          {"kept_by_soup", report.kept_by_soup},
          {"fills", report.fills},
          {"translate", vector_json(report.translate_cells)},
          {"rotate_deg", degrees_json(report.rotate)},
          {"overlap", report.overlap},
          {"overlap_unfitted", report.overlap_unfitted},
          {"evened_tets", report.evened_tets},
          {"thin_tets", report.thin_tets},
          {"enclosing_tets", report.enclosing_tets},
          {"doubled_tets", report.doubled_tets},
          {"parted_vertices", report.parted_vertices},
          {"excess_volume", report.excess_volume},
          {"lacking_volume", report.lacking_volume},
          {"topology", topology_json(report.topology)}};
}

Json smooth_json(const SmoothReport& report) {
  const std::vector<float>& ratios = report.boundary_volume_ratio;
  Json ratio = nullptr;
  if (!ratios.empty()) {
    const auto [low, high] = std::minmax_element(ratios.begin(), ratios.end());
    double sum = 0;
    for (const float r : ratios) sum += static_cast<double>(r);
    ratio = {{"min", *low}, {"mean", sum / static_cast<double>(ratios.size())}, {"max", *high}};
  }
  return {{"passes", report.passes},
          {"boundary_vertices", report.boundary_vertices},
          {"shortened_moves", report.shortened_moves},
          {"volume_before", report.volume_before},
          {"volume_after", report.volume_after},
          {"volume_wanted", report.volume_wanted},
          {"snapped", report.snapped},
          {"min_dihedral_deg", to_degrees(report.min_dihedral)},
          {"boundary_volume_ratio", ratio}};
}

Json options_json(const MeshOptions& options) {
  const DistanceOptions& distance = options.distance;
  const PseudoVolumeOptions& volume = options.pseudo_volume;
  const LatticeOptions& lattice = options.lattice;
  return {{"voxels", optional_json(distance.voxels)},
          {"voxel_size", optional_json(distance.voxel_size)},
          {"k", optional_json(volume.k)},
          {"band_voxels", optional_json(volume.band_voxels)},
          {"band", optional_json(volume.band)},
          {"rays", volume.rays},
          {"placement", volume.placement == Placement::Closest ? "closest" : "entry"},
          {"cavities", volume.cavities == Cavities::Fill ? "fill" : "keep"},
          {"tets", optional_json(lattice.tets)},
          {"vertices", optional_json(lattice.vertices)},
          {"edge", optional_json(lattice.edge)},
          {"cells", optional_json(lattice.cells)},
          {"cell_size", optional_json(lattice.cell_size)},
          {"lattice", lattice.kind == LatticeKind::Bcc ? "bcc" : "five"},
          {"fit", lattice.fit == Fit::Search},
          {"rho_min", lattice.rho_min},
          {"translate", vector_json(lattice.translate_cells)},
          {"rotate_deg", degrees_json(lattice.rotate)},
          {"thin", lattice.thin == Thin::Keep ? "keep" : "drop"},
          {"cover", lattice.cover == Cover::Density   ? "density"
                    : lattice.cover == Cover::Enclose ? "enclose"
                                                      : "inside"},
          {"separate", lattice.separate == Separate::Apart},
          {"stairs", lattice.stairs == Stairs::Even ? "even" : "leave"},
          {"touching", lattice.topology.touching == Touching::Mend ? "mend" : "leave"},
          {"min_part", lattice.topology.min_part},
          {"bubbles", lattice.topology.bubbles == Bubbles::Fill ? "fill" : "keep"},
          {"boundary_only", lattice.topology.boundary_only == BoundaryOnly::Leave    ? "leave"
                            : lattice.topology.boundary_only == BoundaryOnly::Remove ? "remove"
                                                                                     : "split"},
          {"passes", options.smooth.passes},
          {"strength", options.smooth.strength},
          {"snap", options.smooth.snap == Snap::Surface ? "on" : "off"},
          {"min_angle_deg", to_degrees(options.smooth.min_dihedral)},
          {"max_angle_deg", to_degrees(options.smooth.max_dihedral)},
          {"max_edge_ratio", options.smooth.max_edge_ratio},
          {"memory_limit_bytes", optional_json(options.memory_limit)},
          {"threads", thread_count()}};
}

/// File names may hold any bytes, JSON only UTF-8: what is not is shown as U+FFFD.
std::string text_of(const Json& json) {
  constexpr int kIndent = 2;
  return json.dump(kIndent, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

const char* class_name(SoupClass kind) {
  switch (kind) {
    case SoupClass::Closed:
      return "closed";
    case SoupClass::Open:
      return "open";
    case SoupClass::Soup:
      return "soup";
    case SoupClass::Empty:
      break;
  }
  return "empty";
}

Json embedding_json(const Embedding& embedding) {
  if (embedding.tets.empty()) return nullptr;
  const EmbedReport& report = embedding.report;
  return {{"inside", report.inside},         {"outside", report.outside},       {"drawn_closer", report.drawn_closer},
          {"other_copy", report.other_copy}, {"non_finite", report.non_finite}, {"max_distance", report.max_distance}};
}

Json regions_json(const TetModel& model) {
  std::vector<std::size_t> tets(model.regions.size(), 0);
  for (std::size_t t = 0; t < model.mesh.tets.size(); ++t) ++tets[model.tet_regions.empty() ? 0 : model.tet_regions[t]];
  Json regions = Json::array();
  for (std::size_t r = 0; r < tets.size(); ++r) {
    const Region& region = model.regions[r];
    regions.push_back({{"name", region.name},
                       {"tet_count", tets[r]},
                       {"density", region.material.density},
                       {"young", region.material.young},
                       {"poisson", region.material.poisson}});
  }
  return regions;
}

Json pins_json(const TetModel& model) {
  Json pins = Json::array();
  for (const VertexSet& set : model.pins) pins.push_back({{"name", set.name}, {"vertex_count", set.vertices.size()}});
  return pins;
}

std::string mesh_report_json(const MeshRun& run) {
  const Pipeline& pipeline = *run.pipeline;
  const PseudoVolumeReport& volume = pipeline.pseudo_volume().report;
  Json outputs = Json::array();
  for (const auto& path : run.outputs) outputs.push_back(path.string());
  return text_of({{"tet_count", run.quality.tet_count},
                  {"vertex_count", run.quality.vertex_count},
                  {"inverted_tets", run.quality.inverted_tets},
                  {"min_dihedral_deg", to_degrees(run.quality.min_dihedral)},
                  {"max_dihedral_deg", to_degrees(run.quality.max_dihedral)},
                  {"boundary_manifold", run.quality.boundary_manifold},
                  {"components", run.quality.components},
                  {"volume", run.quality.volume},
                  {"iou_pseudo_volume", run.iou},
                  {"boundary_distance_edges",
                   {{"mean", run.distance.mean},
                    {"percentile95", run.distance.percentile95},
                    {"lattice_mean", run.raw_distance.mean},
                    {"lattice_percentile95", run.raw_distance.percentile95}}},
                  {"k", volume.k},
                  {"band_voxels", volume.band_voxels},
                  {"voxels", unpadded_size(pipeline.distance().distance.frame)},
                  {"soup", soup_json(pipeline.soup().report)},
                  {"seconds", seconds_json(run.seconds)},
                  {"version", TETSOUP_VERSION},
                  {"input", run.input},
                  {"outputs", outputs},
                  {"engine", run.engine.empty() ? Json() : Json(run.engine)},
                  {"options", options_json(run.options)},
                  {"grid", grid_json(pipeline.distance())},
                  {"pseudo_volume", pseudo_volume_json(volume)},
                  {"lattice", lattice_json(pipeline.lattice().report)},
                  {"smooth", smooth_json(pipeline.smooth().report)},
                  {"quality", quality_json(run.quality)},
                  {"embedding", embedding_json(run.model.embedding)},
                  {"regions", regions_json(run.model)},
                  {"pins", pins_json(run.model)},
                  {"readiness", readiness_json(run.readiness, run.material)}});
}

std::string soup_report_json(const std::string& input, const SoupReport& report, const std::vector<PartName>& parts) {
  Json list = Json::array();
  for (const PartName& part : parts)
    list.push_back({{"kind", kind_name(part.kind)}, {"name", part.name}, {"triangle_count", part.triangle_count}});
  return text_of({{"input", input}, {"version", TETSOUP_VERSION}, {"soup", soup_json(report)}, {"parts", list}});
}

const char* kind_name(PartKind kind) {
  return kind == PartKind::Object ? "object" : kind == PartKind::Group ? "group" : "material";
}

std::string tets_report_json(const std::string& input, const Quality& quality, const Readiness& readiness,
                             const Material& material) {
  return text_of({{"input", input},
                  {"version", TETSOUP_VERSION},
                  {"quality", quality_json(quality)},
                  {"readiness", readiness_json(readiness, material)}});
}

}  // namespace tetsoup::cli
