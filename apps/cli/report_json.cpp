#include "report_json.h"

#include <nlohmann/json.hpp>

#include "angles.h"
#include "calibration.h"
#include "tetsoup/report.h"

namespace tetsoup::cli {

namespace {

using Json = nlohmann::ordered_json;  // writes NaN and infinity as null

/// What the library says of a part, for the whole.
template <class... Parts>
Json part(const Parts&... parts) {
  return Json::parse(to_json(parts...));
}

Json seconds_json(const Timings& seconds) {
  return {{"read", seconds.read},           {"soup", seconds.soup},
          {"distance", seconds.distance},   {"pseudo_volume", seconds.pseudo_volume},
          {"lattice", seconds.lattice},     {"smooth", seconds.smooth},
          {"quality", seconds.quality},     {"preview", seconds.preview},
          {"calibrate", seconds.calibrate}, {"write", seconds.write},
          {"total", seconds.total}};
}

Json calibration_json(const MeshRun& run) {
  if (!run.calibration) return {};
  Json json = part(*run.calibration);
  for (const CalibratedFile& file : run.calibrated)
    json["files"].push_back({{"file", file.path.string()}, {"holds", name_of(file.holds)}});
  return json;
}

/// File names may hold any bytes, JSON only UTF-8: what is not is shown as U+FFFD.
std::string text_of(const Json& json) {
  constexpr int kIndent = 2;
  return json.dump(kIndent, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

std::string mesh_report_json(const MeshRun& run) {
  const Pipeline& pipeline = *run.pipeline;
  const PseudoVolumeReport& volume = pipeline.pseudo_volume().report;
  const Vec3d& offset = pipeline.soup().soup.origin;
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
                  {"voxels", unpadded_size(pipeline.grid())},
                  {"notes", run.notes},
                  {"soup", part(pipeline.soup().report)},
                  {"seconds", seconds_json(run.seconds)},
                  {"version", TETSOUP_VERSION},
                  {"input", run.input},
                  {"outputs", outputs},
                  {"offset", {offset.x, offset.y, offset.z}},
                  {"recentred", run.recentred},
                  {"engine", run.engine.empty() ? Json() : Json(run.engine)},
                  {"options", part(run.options)},
                  {"grid", part(pipeline.grid())},
                  {"pseudo_volume", part(volume)},
                  {"lattice", part(pipeline.lattice().report)},
                  {"smooth", part(pipeline.smooth().report)},
                  {"quality", part(run.quality)},
                  {"fidelity", part(run.fidelity)},
                  {"embedding", run.model.embedding.tets.empty() ? Json() : part(run.model.embedding.report)},
                  {"regions", Json::parse(regions_json(run.model))},
                  {"pins", Json::parse(pins_json(run.model))},
                  {"calibration", calibration_json(run)},
                  {"readiness", part(run.readiness, run.material)}});
}

std::string soup_report_json(const std::string& input, const SoupReport& report, const std::vector<PartName>& parts) {
  Json list = Json::array();
  for (const PartName& named : parts)
    list.push_back({{"kind", kind_name(named.kind)}, {"name", named.name}, {"triangle_count", named.triangle_count}});
  return text_of({{"input", input}, {"version", TETSOUP_VERSION}, {"soup", part(report)}, {"parts", list}});
}

const char* kind_name(PartKind kind) {
  return kind == PartKind::Object ? "object" : kind == PartKind::Group ? "group" : "material";
}

std::string tets_report_json(const std::string& input, const Quality& quality, const Readiness& readiness,
                             const Material& material) {
  return text_of({{"input", input},
                  {"version", TETSOUP_VERSION},
                  {"quality", part(quality)},
                  {"readiness", part(readiness, material)}});
}

}  // namespace tetsoup::cli
