// Tet meshes and cleaned soups.
#include "arrays.h"
#include "bindings.h"
#include "materials.h"
#include "progress.h"
#include "records.h"
#include "tetsoup/quality.h"
#include "tetsoup/readiness.h"
#include "tetsoup/soup.h"

namespace tetsoup::python {

namespace {

constexpr const char* kCleanSoupDoc =
    "A soup in its canonical form: distinct positions in order, unique triangles in order; what cannot be used is "
    "gone.";

void bind_clean_soup(nb::module_& m) {
  nb::class_<CleanSoup>(m, "CleanSoup", kCleanSoupDoc)
      .def_prop_ro(
          "vertices",
          [](nb::handle_t<CleanSoup> self) {
            return rows_of<float, 3>(nb::cast<const CleanSoup&>(self).soup.vertices, self);
          },
          "(N, 3) float32, read-only.")
      .def_prop_ro(
          "faces",
          [](nb::handle_t<CleanSoup> self) {
            return rows_of<std::int32_t, 3>(nb::cast<const CleanSoup&>(self).soup.triangles, self);
          },
          "(F, 3) int32, read-only.")
      .def_ro("report", &CleanSoup::report, "What was dropped, and what the rest is.");
}

}  // namespace

void bind_meshes(nb::module_& m) {
  bind_clean_soup(m);
  m.def(
      "clean_soup",
      [](PointsIn vertices, FacesIn faces, nb::object progress) {
        const TriangleSoup soup = copy_soup(vertices, faces);
        return call_library(progress, [&](const Progress& watch) { return clean_soup(soup, watch); });
      },
      nb::arg("vertices"), nb::arg("faces"), nb::arg("progress").none());

  nb::class_<TetMesh>(m, "TetMesh")
      .def("__init__",
           [](TetMesh* self, PointsIn points, TetsIn tets) {
             new (self) TetMesh{copy_rows<Vec3>(points), copy_rows<Tet>(tets)};
           })
      .def_prop_ro(
          "points",
          [](nb::handle_t<TetMesh> self) { return rows_of<float, 3>(nb::cast<const TetMesh&>(self).vertices, self); })
      .def_prop_ro("tets",
                   [](nb::handle_t<TetMesh> self) {
                     return rows_of<std::int32_t, 4>(nb::cast<const TetMesh&>(self).tets, self);
                   })
      .def("surface",
           [](const TetMesh& self) {
             return owned_rows<std::int32_t, 3>(call_unlocked([&] { return boundary_triangles(self); }));
           })
      .def("cavity_surface",
           [](const TetMesh& self) {
             return owned_rows<std::int32_t, 3>(call_unlocked([&] { return cavity_triangles(self); }));
           })
      .def("quality", [](const TetMesh& self) { return call_unlocked([&] { return measure_quality(self); }); })
      .def(
          "readiness",
          [](const TetMesh& self, const Quality& quality, const Fidelity* fidelity, std::optional<double> density,
             std::optional<double> young, std::optional<double> poisson, std::optional<double> metres_per_unit) {
            const Material material = material_of(density, young, poisson, metres_per_unit);
            return call_unlocked([&] {
              return fidelity ? assess_readiness(self, quality, *fidelity, material)
                              : assess_readiness(self, quality, material);
            });
          },
          nb::arg("quality"), nb::arg("fidelity").none(), nb::arg("density").none(), nb::arg("young").none(),
          nb::arg("poisson").none(), nb::arg("metres_per_unit").none());
}

}  // namespace tetsoup::python
