// C: the mesh with the surface that hangs on it, and files of both.
#include <algorithm>

#include <nlohmann/json.hpp>

#include "base/vec.h"
#include "c/guard.h"
#include "c/handles.h"
#include "tetsoup/calibrate.h"
#include "tetsoup/engines.h"
#include "tetsoup/io.h"
#include "tetsoup/report.h"

using namespace tetsoup;
using Json = nlohmann::ordered_json;

namespace {

TetModel whole_model(const tetsoup_model& model) {
  TetModel whole = model.settings;
  whole.mesh = model.make->mesh;
  whole.render = model.make->render;
  whole.embedding = model.make->embedding;
  return whole;
}

Json names_json(const std::vector<std::filesystem::path>& files) {
  Json names = Json::array();
  for (const std::filesystem::path& file : files) names.push_back(file.string());
  return names;
}

}  // namespace

tetsoup_status tetsoup_model_create(const tetsoup_pipeline* pipeline, const char* name, tetsoup_progress progress,
                                    void* context, tetsoup_model** model) {
  return c::guarded([&] {
    tetsoup_model*& out = c::given(model, "model");
    const tetsoup_pipeline& p = c::given(pipeline, "pipeline");
    p.require_stage(Stage::Smooth);
    auto made = std::make_unique<tetsoup_model>();
    made->settings.name = &c::given(name, "name");
    if (made->settings.name.empty()) throw InvalidInput("name is empty");
    made->settings.regions = {{made->settings.name, {}}};
    made->make = std::make_shared<const c::Make>(
        c::make_of(p.pipeline.smooth().mesh, p.input->render, {}, c::progress_of(progress, context)));
    out = made.release();
  });
}

tetsoup_status tetsoup_model_set_material(tetsoup_model* model, double density, double young, double poisson,
                                          double metres_per_unit) {
  return c::guarded([&] {
    tetsoup_model& m = c::given(model, "model");
    const Material material{density, young, poisson, metres_per_unit};
    check_material(material);
    m.settings.regions.front().material = material;
    m.material_is_default = false;
  });
}

tetsoup_status tetsoup_model_set_up(tetsoup_model* model, int32_t axis) {
  return c::guarded([&] {
    require(axis >= 0 && axis < 3, "axis", axis, "0, 1 or 2");
    c::given(model, "model").settings.up = static_cast<UpAxis>(axis);
  });
}

tetsoup_status tetsoup_model_add_pins(tetsoup_model* model, const char* name, const double low[3], const double high[3],
                                      size_t* count) {
  return c::guarded([&] {
    tetsoup_model& m = c::given(model, "model");
    const Box3 box{c::vector_from(low, "low"), c::vector_from(high, "high")};
    std::vector<std::uint32_t> vertices = vertices_in_box(m.make->mesh, box);
    if (count != nullptr) *count = vertices.size();
    m.settings.pins.push_back({&c::given(name, "name"), std::move(vertices)});
  });
}

tetsoup_status tetsoup_model_calibrate(tetsoup_model* model, const tetsoup_pipeline* pipeline,
                                       tetsoup_progress progress, void* context, const char** json) {
  return c::guarded([&] {
    tetsoup_model& m = c::given(model, "model");
    const tetsoup_pipeline& p = c::given(pipeline, "pipeline");
    const Progress watched = c::progress_of(progress, context);
    CalibrateOptions options;
    options.poisson =
        m.material_is_default ? kUsualPoisson : std::min(m.settings.regions.front().material.poisson, 0.49);
    const TetMesh fine = calibration_reference(p.input->soup, p.options, options.reference_tets, watched);
    const Calibration made = calibrate_tets({&m.make->mesh, {}, {}}, {&fine, {}, {}}, options, watched);
    m.settings.stiffness_scale = made.stiffness_scale;
    m.settings.density_scale = made.density_scale;
    m.settings.stiffness_factor = made.factor;
    if (json != nullptr) *json = c::keep_text(to_json(made));
  });
}

tetsoup_status tetsoup_model_vertices(const tetsoup_model* model, tetsoup_floats* vertices) {
  return c::guarded([&] { c::given(vertices, "vertices") = c::view_of(c::given(model, "model").make->mesh.vertices); });
}

tetsoup_status tetsoup_model_tets(const tetsoup_model* model, tetsoup_indices* tets) {
  return c::guarded([&] { c::given(tets, "tets") = c::view_of(c::given(model, "model").make->mesh.tets); });
}

tetsoup_status tetsoup_model_surface(const tetsoup_model* model, tetsoup_floats* vertices, tetsoup_indices* triangles) {
  return c::guarded([&] {
    const c::Make& make = *c::given(model, "model").make;
    c::given(vertices, "vertices") = c::view_of(make.render.vertices);
    c::given(triangles, "triangles") = c::view_of(make.triangles);
  });
}

tetsoup_status tetsoup_model_deform(tetsoup_model* model, const float* positions, size_t vertex_count,
                                    tetsoup_floats* vertices, tetsoup_floats* normals) {
  return c::guarded([&] {
    tetsoup_model& m = c::given(model, "model");
    const std::vector<Vec3> moved = c::points_from(positions, vertex_count, "positions");
    c::deform(*m.make, moved, vertices == nullptr ? nullptr : &m.surface, normals == nullptr ? nullptr : &m.normals);
    if (vertices != nullptr) *vertices = c::view_of(m.surface);
    if (normals != nullptr) *normals = c::view_of(m.normals);
  });
}

tetsoup_status tetsoup_model_report(const tetsoup_model* model, const char** json) {
  return c::guarded([&] {
    const char*& out = c::given(json, "json");
    const tetsoup_model& m = c::given(model, "model");
    const Json report{{"embedding", Json::parse(to_json(m.make->embedding.report))},
                      {"pins", Json::parse(pins_json(m.settings))}};
    out = c::keep_text(report.dump());
  });
}

tetsoup_status tetsoup_model_write(const tetsoup_model* model, const char* path, const char* format,
                                   const char** json) {
  return c::guarded([&] {
    const char*& out = c::given(json, "json");
    const tetsoup_model& m = c::given(model, "model");
    const std::string file = &c::given(path, "path");
    const auto wanted = format == nullptr ? std::nullopt : std::optional(tet_format_named(format));
    out = c::keep_text(names_json(write_tets(file, whole_model(m), wanted)).dump());
  });
}

tetsoup_status tetsoup_model_write_for_engine(const tetsoup_model* model, const char* path, const char* engine,
                                              const char** json) {
  return c::guarded([&] {
    const char*& out = c::given(json, "json");
    const tetsoup_model& m = c::given(model, "model");
    const std::string file = &c::given(path, "path");
    const Engine& wanted = find_engine(&c::given(engine, "engine"));
    const Json files = names_json(write_for_engine(wanted, file, whole_model(m), m.material_is_default));
    out = c::keep_text(Json{{"files", files}, {"usage", engine_usage(wanted, file)}}.dump());
  });
}

void tetsoup_model_destroy(tetsoup_model* model) {
  delete model;
}
