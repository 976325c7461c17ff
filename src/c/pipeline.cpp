// C: from soup to mesh.
#include <algorithm>
#include <nlohmann/json.hpp>
#include <numbers>

#include "c/guard.h"
#include "c/handles.h"
#include "tetsoup/quality.h"
#include "tetsoup/readiness.h"
#include "tetsoup/report.h"

using namespace tetsoup;
using Json = nlohmann::ordered_json;

namespace {

constexpr std::array<const char*, kStageCount> kStageNames{"soup", "distance", "pseudo_volume", "lattice", "smooth"};

Stage stage_of(const tetsoup_stage& stage) {
  const int number = c::number_of(stage);
  require(number >= 0 && number < static_cast<int>(kStageCount), "stage", number, "0 to 4");
  return static_cast<Stage>(number);
}

const TetMesh& mesh_of(const tetsoup_pipeline& p, const tetsoup_mesh& mesh) {
  const int number = c::number_of(mesh);
  require(number == TETSOUP_MESH_LATTICE || number == TETSOUP_MESH_FINAL, "mesh", number, "0 or 1");
  p.require_stage(mesh == TETSOUP_MESH_LATTICE ? Stage::Lattice : Stage::Smooth);
  return mesh == TETSOUP_MESH_LATTICE ? p.pipeline.lattice().mesh : p.pipeline.smooth().mesh;
}

/// The options of a new run, which the last one's results do not outlive.
MeshOptions begin_run(tetsoup_pipeline& p, const char* json) {
  MeshOptions options = parse_mesh_options(c::options_or_none(json));
  options.memory_limit = p.memory_limit;
  p.done = Stage::Soup;
  p.boundaries = {};
  p.options = options;
  return options;
}

/// The stages that a run has finished stand even where it was cancelled; what it began does not.
void run_until(tetsoup_pipeline& p, Stage last, const char* json, const Progress& progress) {
  const MeshOptions options = begin_run(p, json);
  for (int stage = static_cast<int>(Stage::Distance); stage <= static_cast<int>(last); ++stage) {
    p.pipeline.run_until(static_cast<Stage>(stage), options, progress);
    p.done = static_cast<Stage>(stage);
  }
}

/// Values of one layer, row by row.
template <class At>
void fill_layer(const GridFrame& frame, int axis, int layer, std::vector<float>& values, std::size_t& width,
                const At& at) {
  const auto u = static_cast<std::size_t>(axis == 0 ? 1 : 0), v = static_cast<std::size_t>(axis == 2 ? 1 : 2);
  width = static_cast<std::size_t>(frame.size[u]);
  values.clear();
  values.reserve(width * static_cast<std::size_t>(frame.size[v]));
  std::array<int, 3> voxel{};
  voxel[static_cast<std::size_t>(axis)] = layer;
  for (voxel[v] = 0; voxel[v] < frame.size[v]; ++voxel[v])
    for (voxel[u] = 0; voxel[u] < frame.size[u]; ++voxel[u])
      values.push_back(static_cast<float>(at(voxel[0], voxel[1], voxel[2])));
}

void fill_slice(tetsoup_pipeline& p, const tetsoup_field& field, int axis, int layer, std::size_t& width) {
  const GridFrame& frame = p.pipeline.grid();
  require(axis >= 0 && axis < 3, "axis", axis, "0, 1 or 2");
  const int layers = frame.size[static_cast<std::size_t>(axis)];
  require(layer >= 0 && layer < layers, "layer", layer, "at least 0 and below the grid's size along the axis");
  const int number = c::number_of(field);
  require(number >= 0 && number <= TETSOUP_FIELD_INSIDE, "field", number, "0, 1 or 2");
  switch (field) {
    case TETSOUP_FIELD_DISTANCE:
      return fill_layer(frame, axis, layer, p.slice, width,
                        [&](int x, int y, int z) { return p.pipeline.distance().distance.at(x, y, z); });
    case TETSOUP_FIELD_VOTES:
      p.require_stage(Stage::PseudoVolume);
      return fill_layer(frame, axis, layer, p.slice, width,
                        [&](int x, int y, int z) { return p.pipeline.pseudo_volume().votes.at(x, y, z); });
    case TETSOUP_FIELD_INSIDE:
      p.require_stage(Stage::PseudoVolume);
      return fill_layer(frame, axis, layer, p.slice, width,
                        [&](int x, int y, int z) { return p.pipeline.pseudo_volume().inside.test(x, y, z) ? 1 : 0; });
  }
}

template <class... Parts>
Json part(const Parts&... parts) {
  return Json::parse(to_json(parts...));
}

Json report_of(const tetsoup_pipeline& p, const char* material_json) {
  const Pipeline& pipeline = p.pipeline;
  Json report{{"soup", part(pipeline.soup().report)}};
  if (p.done >= Stage::Distance) report["grid"] = part(pipeline.grid());
  if (p.done >= Stage::PseudoVolume) report["pseudo_volume"] = part(pipeline.pseudo_volume().report);
  if (p.done >= Stage::Lattice) {
    report["lattice"] = part(pipeline.lattice().report);
    report["lattice_quality"] = part(measure_quality(pipeline.lattice().mesh));
  }
  if (p.done >= Stage::Smooth) {
    const TetMesh& mesh = pipeline.smooth().mesh;
    const Quality quality = measure_quality(mesh);
    const Material material = parse_material(c::options_or_none(material_json)).elastic;
    report["smooth"] = part(pipeline.smooth().report);
    report["quality"] = part(quality);
    const Fidelity fidelity = measure_fidelity(mesh, pipeline.soup());
    report["fidelity"] = part(fidelity);
    report["readiness"] = part(assess_readiness(mesh, quality, fidelity, material), material);
    report["notes"] = notes_of(
        {.pipeline = pipeline, .quality = quality, .fidelity = fidelity, .metres_per_unit = material.metres_per_unit});
  }
  for (std::size_t stage = 0; stage <= static_cast<std::size_t>(p.done); ++stage)
    report["seconds"][kStageNames[stage]] = pipeline.seconds(static_cast<Stage>(stage));
  report["options"] = part(p.options);
  return report;
}

}  // namespace

void tetsoup_pipeline::require_stage(Stage stage) const {
  if (done < stage)
    throw InvalidInput(std::string("the stage ") + kStageNames[static_cast<std::size_t>(stage)] +
                       " has no result yet: run the pipeline until there");
}

tetsoup_status tetsoup_pipeline_create(const tetsoup_soup* soup, tetsoup_progress progress, void* context,
                                       tetsoup_pipeline** pipeline) {
  return c::guarded([&] {
    tetsoup_pipeline*& out = c::given(pipeline, "pipeline");
    out = new tetsoup_pipeline(c::given(soup, "soup").input, c::progress_of(progress, context));
  });
}

tetsoup_status tetsoup_pipeline_set_memory_limit(tetsoup_pipeline* pipeline, size_t bytes) {
  return c::guarded([&] {
    tetsoup_pipeline& p = c::given(pipeline, "pipeline");
    p.memory_limit = bytes > 0 ? std::optional(bytes) : std::nullopt;
  });
}

tetsoup_status tetsoup_pipeline_run_until(tetsoup_pipeline* pipeline, tetsoup_stage last, const char* options,
                                          tetsoup_progress progress, void* context) {
  return c::guarded(
      [&] { run_until(c::given(pipeline, "pipeline"), stage_of(last), options, c::progress_of(progress, context)); });
}

tetsoup_status tetsoup_pipeline_run(tetsoup_pipeline* pipeline, const char* options, tetsoup_progress progress,
                                    void* context) {
  return tetsoup_pipeline_run_until(pipeline, TETSOUP_STAGE_SMOOTH, options, progress, context);
}

tetsoup_status tetsoup_pipeline_find_tets(tetsoup_pipeline* pipeline, const char* options, tetsoup_progress progress,
                                          void* context, size_t* tets, int32_t* held) {
  return c::guarded([&] {
    tetsoup_pipeline& p = c::given(pipeline, "pipeline");
    const MeshOptions wanted = begin_run(p, options);
    const CountSearch found = find_tet_count(p.pipeline, wanted, c::progress_of(progress, context));
    p.options = p.pipeline.options();
    p.done = Stage::Smooth;
    if (tets) *tets = found.tets;
    if (held) *held = found.held ? 1 : 0;
  });
}

tetsoup_status tetsoup_pipeline_vertices(tetsoup_pipeline* pipeline, tetsoup_mesh mesh, tetsoup_floats* vertices) {
  return c::guarded(
      [&] { c::given(vertices, "vertices") = c::view_of(mesh_of(c::given(pipeline, "pipeline"), mesh).vertices); });
}

tetsoup_status tetsoup_pipeline_tets(tetsoup_pipeline* pipeline, tetsoup_mesh mesh, tetsoup_indices* tets) {
  return c::guarded([&] { c::given(tets, "tets") = c::view_of(mesh_of(c::given(pipeline, "pipeline"), mesh).tets); });
}

tetsoup_status tetsoup_pipeline_boundary(tetsoup_pipeline* pipeline, tetsoup_mesh mesh, tetsoup_indices* triangles) {
  return c::guarded([&] {
    tetsoup_pipeline& p = c::given(pipeline, "pipeline");
    const TetMesh& tets = mesh_of(p, mesh);
    std::vector<Triangle>& boundary = p.boundaries[static_cast<std::size_t>(mesh)];
    if (boundary.empty()) boundary = boundary_triangles(tets);
    c::given(triangles, "triangles") = c::view_of(boundary);
  });
}

tetsoup_status tetsoup_pipeline_cavities(tetsoup_pipeline* pipeline, tetsoup_mesh mesh, tetsoup_indices* triangles) {
  return c::guarded([&] {
    tetsoup_pipeline& p = c::given(pipeline, "pipeline");
    p.cavities = cavity_triangles(mesh_of(p, mesh));
    c::given(triangles, "triangles") = c::view_of(p.cavities);
  });
}

tetsoup_status tetsoup_pipeline_tet_quality(tetsoup_pipeline* pipeline, tetsoup_mesh mesh, tetsoup_measure measure,
                                            tetsoup_floats* values) {
  return c::guarded([&] {
    tetsoup_pipeline& p = c::given(pipeline, "pipeline");
    tetsoup_floats& out = c::given(values, "values");
    const int number = c::number_of(measure);
    require(number == TETSOUP_MEAN_RATIO || number == TETSOUP_MIN_DIHEDRAL, "measure", number, "0 or 1");
    constexpr auto kDegrees = static_cast<float>(180 / std::numbers::pi);
    p.qualities.clear();
    for (const TetQuality& tet : measure_tets(mesh_of(p, mesh)))
      p.qualities.push_back(measure == TETSOUP_MEAN_RATIO ? tet.mean_ratio : tet.min_dihedral * kDegrees);
    out = {p.qualities.data(), p.qualities.size(), 1};
  });
}

tetsoup_status tetsoup_pipeline_grid(const tetsoup_pipeline* pipeline, tetsoup_grid* grid) {
  return c::guarded([&] {
    const tetsoup_pipeline& p = c::given(pipeline, "pipeline");
    tetsoup_grid& out = c::given(grid, "grid");
    p.require_stage(Stage::Distance);
    const DistanceField& field = p.pipeline.distance();
    const GridFrame& frame = field.distance.frame;
    out = {{frame.origin.x, frame.origin.y, frame.origin.z}, frame.voxel_size, field.d_max, 0, {}, frame.pad, 0};
    std::copy(frame.size.begin(), frame.size.end(), out.size);
    if (p.done < Stage::PseudoVolume) return;
    out.band = p.pipeline.pseudo_volume().report.band;
    out.rays = p.pipeline.pseudo_volume().rays;
  });
}

tetsoup_status tetsoup_pipeline_slice(tetsoup_pipeline* pipeline, tetsoup_field field, int32_t axis, int32_t layer,
                                      tetsoup_floats* values) {
  return c::guarded([&] {
    tetsoup_pipeline& p = c::given(pipeline, "pipeline");
    tetsoup_floats& out = c::given(values, "values");
    p.require_stage(Stage::Distance);
    std::size_t width = 0;
    fill_slice(p, field, axis, layer, width);
    out = {p.slice.data(), p.slice.size() / width, width};
  });
}

tetsoup_status tetsoup_pipeline_report(tetsoup_pipeline* pipeline, const char* material, const char** json) {
  return c::guarded([&] {
    const char*& out = c::given(json, "json");
    out = c::keep_text(report_of(c::given(pipeline, "pipeline"), material).dump());
  });
}

tetsoup_status tetsoup_pipeline_accuracy(tetsoup_pipeline* pipeline, const char** json) {
  return c::guarded([&] {
    const char*& out = c::given(json, "json");
    const tetsoup_pipeline& p = c::given(pipeline, "pipeline");
    p.require_stage(Stage::Smooth);
    const TetMesh& mesh = p.pipeline.smooth().mesh;
    const double edge = p.pipeline.lattice().report.mean_edge;
    const BoundaryDistance distance = boundary_distance(mesh, p.pipeline.soup().soup, edge);
    const Json report{{"iou_pseudo_volume", p.pipeline.overlap(mesh)},
                      {"boundary_distance_edges", {{"mean", distance.mean}, {"percentile95", distance.percentile95}}}};
    out = c::keep_text(report.dump());
  });
}

void tetsoup_pipeline_destroy(tetsoup_pipeline* pipeline) {
  delete pipeline;
}
