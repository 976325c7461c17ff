// What every stage has to say, as JSON. Member names are a promise; numbers that do not exist (NaN, infinity) are null.
#include "tetsoup/report.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numbers>

#include "base/vec.h"

namespace tetsoup {

namespace {

using Json = nlohmann::ordered_json;  // writes NaN and infinity as null

double degrees(double radians) {
  return radians / (std::numbers::pi / 180);
}

/// Names may hold any bytes, JSON only UTF-8: what is not is shown as U+FFFD.
std::string text_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Json vector_json(const Vec3d& v) {
  return Json::array({v.x, v.y, v.z});
}

Json degrees_json(const Vec3d& v) {
  return vector_json({degrees(v.x), degrees(v.y), degrees(v.z)});
}

template <class T>
Json optional_json(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
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

const char* soup_class_name(SoupClass kind) {
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

}  // namespace

std::string to_json(const SoupReport& soup) {
  Json box = nullptr;
  if (soup.kind != SoupClass::Empty)
    box = {{"lo", vector_json(soup.box.lo + soup.origin)}, {"hi", vector_json(soup.box.hi + soup.origin)}};
  return text_of({{"class", soup_class_name(soup.kind)},
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
                  {"box", box},
                  {"origin", vector_json(soup.origin)}});
}

std::string to_json(const Quality& quality) {
  return text_of({{"vertex_count", quality.vertex_count},
                  {"tet_count", quality.tet_count},
                  {"inverted_tets", quality.inverted_tets},
                  {"invalid_tets", quality.invalid_tets},
                  {"unused_vertices", quality.unused_vertices},
                  {"volume", quality.volume},
                  {"min_tet_volume", quality.min_tet_volume},
                  {"max_tet_volume", quality.max_tet_volume},
                  {"min_dihedral_deg", degrees(quality.min_dihedral)},
                  {"max_dihedral_deg", degrees(quality.max_dihedral)},
                  {"min_dihedral_p1_deg", degrees(quality.min_dihedral_p1)},
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
                  {"roughness_deg", degrees(quality.roughness)},
                  {"boundary_area", quality.boundary_area},
                  {"boundary_curvature", quality.boundary_curvature}});
}

std::string to_json(const Fidelity& fidelity) {
  return text_of({{"mean_edge", fidelity.mean_edge},
                  {"lost_edges", fidelity.lost_edges},
                  {"lost_stretches", fidelity.lost_stretches},
                  {"closed", fidelity.closed},
                  {"soup_volume", fidelity.soup_volume},
                  {"volume_ratio", fidelity.volume_ratio},
                  {"wall_edges", fidelity.wall_edges},
                  {"volume_limit", fidelity.volume_limit},
                  {"stray_share", fidelity.stray_share},
                  {"soup_pieces", fidelity.soup_pieces},
                  {"mesh_pieces", fidelity.mesh_pieces},
                  {"torn_pieces", fidelity.torn_pieces},
                  {"joined_pieces", fidelity.joined_pieces},
                  {"lost_pieces", fidelity.lost_pieces},
                  {"soup_tunnels", fidelity.soup_tunnels},
                  {"mesh_tunnels", fidelity.mesh_tunnels},
                  {"overlapping_pairs", fidelity.overlapping_pairs},
                  {"overlap_share", fidelity.overlap_share},
                  {"apart_pairs", fidelity.apart_pairs},
                  {"apart_share", fidelity.apart_share},
                  {"flat", fidelity.flat},
                  {"tilted_share", fidelity.tilted_share}});
}

std::string to_json(const GridFrame& frame) {
  return text_of({{"size", frame.size},
                  {"pad", frame.pad},
                  {"origin", vector_json(frame.origin + frame.soup_origin)},
                  {"voxel_size", frame.voxel_size},
                  {"memory_bytes", grid_memory(frame)}});
}

std::string to_json(const PseudoVolumeReport& report) {
  Json candidates = Json::array();
  for (const BandScore& candidate : report.candidates)
    candidates.push_back(
        {{"band_voxels", candidate.band_voxels}, {"score", candidate.score}, {"consensus", candidate.consensus}});
  return text_of({{"k", report.k},
                  {"band", report.band},
                  {"band_voxels", report.band_voxels},
                  {"automatic", report.automatic},
                  {"floored", report.floored},
                  {"largest_closure", report.largest_closure},
                  {"inside_voxels", report.inside_voxels},
                  {"sheet_share", report.sheet_share},
                  {"exact_share", report.exact_share},
                  {"cavities_kept", report.cavities.size()},
                  {"cavity_voxels", report.cavity_voxels},
                  {"volume", report.volume},
                  {"bounded_volume", optional_json(report.bounded_volume)},
                  {"consensus", report.consensus},
                  {"soup_covered", report.soup_covered},
                  {"candidates", candidates}});
}

std::string to_json(const LatticeReport& report) {
  return text_of({{"cells", report.cells},
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
                  {"stretch", vector_json(report.stretch)},
                  {"overlap", report.overlap},
                  {"overlap_unfitted", report.overlap_unfitted},
                  {"evened_tets", report.evened_tets},
                  {"thin_tets", report.thin_tets},
                  {"enclosing_tets", report.enclosing_tets},
                  {"doubled_tets", report.doubled_tets},
                  {"parted_vertices", report.parted_vertices},
                  {"excess_volume", report.excess_volume},
                  {"lacking_volume", report.lacking_volume},
                  {"topology", topology_json(report.topology)}});
}

std::string to_json(const SmoothReport& report) {
  const std::vector<float>& ratios = report.boundary_volume_ratio;
  Json ratio = nullptr;
  if (!ratios.empty()) {
    const auto [low, high] = std::minmax_element(ratios.begin(), ratios.end());
    double sum = 0;
    for (const float r : ratios) sum += static_cast<double>(r);
    ratio = {{"min", *low}, {"mean", sum / static_cast<double>(ratios.size())}, {"max", *high}};
  }
  return text_of({{"passes", report.passes},
                  {"boundary_vertices", report.boundary_vertices},
                  {"shortened_moves", report.shortened_moves},
                  {"volume_before", report.volume_before},
                  {"volume_after", report.volume_after},
                  {"volume_wanted", report.volume_wanted},
                  {"snapped", report.snapped},
                  {"min_dihedral_deg", degrees(report.min_dihedral)},
                  {"boundary_volume_ratio", ratio}});
}

std::string to_json(const MeshOptions& options) {
  const DistanceOptions& distance = options.distance;
  const PseudoVolumeOptions& volume = options.pseudo_volume;
  const LatticeOptions& lattice = options.lattice;
  return text_of({{"voxels", optional_json(distance.voxels)},
                  {"voxel_size", optional_json(distance.voxel_size)},
                  {"k", optional_json(volume.k)},
                  {"band_voxels", optional_json(volume.band_voxels)},
                  {"band", optional_json(volume.band)},
                  {"rays", volume.rays},
                  {"placement", volume.placement == Placement::Closest ? "closest" : "entry"},
                  {"cavities", volume.cavities == Cavities::Auto   ? "auto"
                               : volume.cavities == Cavities::Fill ? "fill"
                                                                   : "keep"},
                  {"thickness", optional_json(volume.thickness)},
                  {"join", options.join == Join::Touching ? "touching"
                           : options.join == Join::Near   ? "near"
                                                          : "all"},
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
                  {"min_angle_deg", degrees(options.smooth.min_dihedral)},
                  {"max_angle_deg", degrees(options.smooth.max_dihedral)},
                  {"max_edge_ratio", options.smooth.max_edge_ratio},
                  {"memory_limit_bytes", optional_json(options.memory_limit)},
                  {"threads", thread_count()}});
}

std::string to_json(const Readiness& readiness, const Material& material) {
  Json checks = Json::object();
  for (const ReadinessCheck& check : readiness.checks)
    checks[std::string(check.name)] = {{"value", check.value},
                                       {check.at_least ? "at_least" : "at_most", check.limit},
                                       {"passed", check.passed},
                                       {"advice", check.passed ? "" : check.advice}};
  return text_of({{"passed", readiness.passed},
                  {"checks", checks},
                  {"mass_kg", readiness.mass},
                  {"stable_time_step_s", readiness.stable_time_step},
                  {"material",
                   {{"density", material.density},
                    {"young", material.young},
                    {"poisson", material.poisson},
                    {"metres_per_unit", material.metres_per_unit}}}});
}

std::string to_json(const Calibration& calibration) {
  const CalibrateReport& report = calibration.report;
  const auto error = [](const MotionError& e) {
    return Json{{"frequencies_1_to_10", e.low},
                {"frequencies_from_11", e.high},
                {"compliance", e.compliance},
                {"compliance_log", e.load}};
  };
  return text_of({{"factor", calibration.factor},
                  {"reference_tets", report.reference_tets},
                  {"pieces", report.pieces},
                  {"uncalibrated_pieces", report.uncalibrated},
                  {"modes", report.modes},
                  {"before", error(report.before)},
                  {"one_factor", error(report.one)},
                  {"after", error(report.after)},
                  {"stiffness_scale", {report.least_stiffness, report.most_stiffness}},
                  {"density_scale", {report.least_density, report.most_density}},
                  {"mass_error", report.mass_error},
                  {"centre_error", report.centre_error},
                  {"inertia_error", report.inertia_error}});
}

std::string to_json(const EmbedReport& report) {
  return text_of({{"inside", report.inside},
                  {"outside", report.outside},
                  {"drawn_closer", report.drawn_closer},
                  {"other_copy", report.other_copy},
                  {"non_finite", report.non_finite},
                  {"max_distance", report.max_distance}});
}

std::string regions_json(const TetModel& model) {
  const std::vector<RegionSize> sizes = region_sizes(model);
  Json regions = Json::array();
  for (std::size_t r = 0; r < sizes.size(); ++r) {
    const Region& region = model.regions[r];
    regions.push_back({{"name", region.name},
                       {"tet_count", sizes[r].tet_count},
                       {"volume", sizes[r].volume},
                       {"mass", sizes[r].mass},
                       {"density", region.material.density},
                       {"young", region.material.young},
                       {"poisson", region.material.poisson}});
  }
  return text_of(regions);
}

std::string pins_json(const TetModel& model) {
  Json pins = Json::array();
  for (const VertexSet& set : model.pins) pins.push_back({{"name", set.name}, {"vertex_count", set.vertices.size()}});
  return text_of(pins);
}

std::string to_json(const SimulationReport& report) {
  return text_of({{"tet_count", report.tet_count},
                  {"left_out", report.left_out},
                  {"loose_vertices", report.loose_vertices},
                  {"parts", report.parts},
                  {"substeps", report.substeps},
                  {"contacts", report.contacts},
                  {"touching", report.touching},
                  {"clamped", report.clamped}});
}

std::string to_json(const Energy& energy) {
  return text_of({{"kinetic", energy.kinetic},
                  {"elastic", energy.elastic},
                  {"gravity", energy.gravity},
                  {"total", energy.total()}});
}

}  // namespace tetsoup
