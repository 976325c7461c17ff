// A mesh with all that an engine's file may say about it, and the files.
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/map.h>

#include "arrays.h"
#include "bindings.h"
#include "materials.h"
#include "progress.h"
#include "records.h"
#include "tetsoup/calibrate.h"
#include "tetsoup/engines.h"
#include "tetsoup/error.h"
#include "tetsoup/io.h"

namespace tetsoup::python {

namespace {

namespace fs = std::filesystem;

std::optional<TetFormat> format_named(const std::optional<std::string>& name) {
  return name ? std::optional(tet_format_named(*name)) : std::nullopt;
}

UpAxis axis_named(const std::string& name) {
  for (const auto& [word, axis] : kWords<UpAxis>)
    if (name == word) return axis;
  throw InvalidInput("up = '" + name + "', must be one of 'x', 'y', 'z'");
}

void bind_model(nb::module_& m) {
  nb::class_<TetModel>(m, "TetModel")
      .def("__init__",
           [](TetModel* self, const TetMesh& mesh, const std::string& name, const std::string& up) {
             const UpAxis axis = axis_named(up);
             new (self) TetModel{.name = name, .mesh = mesh, .regions = {}, .up = axis};
           })
      .def(
          "add_region",
          [](TetModel& self, const std::string& name, std::optional<double> density, std::optional<double> young,
             std::optional<double> poisson, std::optional<double> metres_per_unit) {
            const Material material = material_of(density, young, poisson, metres_per_unit);
            check_material(material);
            self.regions.push_back({name, material});
          },
          nb::arg("name"), nb::arg("density").none(), nb::arg("young").none(), nb::arg("poisson").none(),
          nb::arg("metres_per_unit").none())
      .def("set_tet_regions",
           [](TetModel& self, IndicesIn regions) { self.tet_regions = copy_rows<std::uint32_t>(regions); })
      .def("add_pin",
           [](TetModel& self, const std::string& name, IndicesIn vertices) {
             self.pins.push_back({name, copy_rows<std::uint32_t>(vertices)});
           })
      .def("set_calibration",
           [](TetModel& self, const Calibration& calibration) {
             self.stiffness_scale = calibration.stiffness_scale;
             self.density_scale = calibration.density_scale;
             self.stiffness_factor = calibration.factor;
           })
      .def("set_render", [](TetModel& self, const RenderMesh& surface) { self.render = surface; })
      .def("set_embedding", [](TetModel& self, const Embedding& embedding) { self.embedding = embedding; });
}

}  // namespace

void bind_models(nb::module_& m) {
  bind_model(m);
  m.def(
      "write_tets",
      [](const fs::path& path, const TetModel& model, const std::optional<std::string>& format) {
        const std::optional<TetFormat> chosen = format_named(format);
        return call_unlocked([&] { return write_tets(path, model, chosen); });
      },
      nb::arg("path"), nb::arg("model"), nb::arg("format").none());
  m.def("write_for_engine",
        [](const fs::path& path, const TetModel& model, const std::string& engine, bool material_is_default) {
          const Engine& wanted = find_engine(engine);
          return call_unlocked([&] { return write_for_engine(wanted, path, model, material_is_default); });
        });
  m.def("engines", [] {
    std::map<std::string, std::string> summaries;
    for (const Engine& engine : engines()) summaries[engine.name] = engine.summary;
    return summaries;
  });
}

}  // namespace tetsoup::python
