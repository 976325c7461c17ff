// Stiffness and density of tets with which a mesh moves like a fine one.
#include "arrays.h"
#include "bindings.h"
#include "progress.h"
#include "records.h"
#include "tetsoup/calibrate.h"

namespace tetsoup::python {

namespace {

void bind_report(nb::module_& m) {
  using E = MotionError;
  Record<E>(m, "MotionError", "How far a mesh is from moving like its reference. Frequencies: mean of |f / f_ref - 1|.")
      .field("low", &E::low, "Of the first ten elastic eigenfrequencies.")
      .field("high", &E::high, "Of those from the eleventh on.")
      .field("compliance", &E::compliance, "Median over forty loads of the work done over the reference's; < 1: stiff.")
      .field("load", &E::load, "Mean of the absolute logarithm over them.");
  using R = CalibrateReport;
  Record<R>(m, "CalibrateReport", "What a calibration was made with, and what was gained.")
      .field("reference_tets", &R::reference_tets, "Of the fine mesh.")
      .field("pieces", &R::pieces, "Connected pieces of the mesh.")
      .field("uncalibrated", &R::uncalibrated, "Those that the fine mesh has not as pieces: they take the one factor.")
      .field("modes", &R::modes, "Compared, of all pieces.")
      .field("before", &R::before, "As the mesh is.")
      .field("one", &R::one, "With the one factor.")
      .field("after", &R::after, "Calibrated.")
      .field("least_stiffness", &R::least_stiffness, "Smallest stiffness_scale.")
      .field("most_stiffness", &R::most_stiffness, "Largest.")
      .field("least_density", &R::least_density, "Smallest density_scale.")
      .field("most_density", &R::most_density, "Largest.")
      .field("mass_error", &R::mass_error, "|mass / reference - 1| afterwards.")
      .field("centre_error", &R::centre_error, "Distance of the centres of mass, in longest sides.")
      .field("inertia_error", &R::inertia_error, "Largest error of second moments, over the largest of them.");
}

}  // namespace

void bind_calibration(nb::module_& m) {
  bind_report(m);
  Record<Calibration>(m, "Calibration", "What to multiply stiffness and density of every tet by.")
      .field("stiffness_scale", &Calibration::stiffness_scale, "(T,) float32, of Young's modulus.")
      .field("density_scale", &Calibration::density_scale, "(T,) float32.")
      .field("factor", &Calibration::factor, "The best single factor of Young's modulus, for engines that take one.")
      .field("report", &Calibration::report, "A CalibrateReport.");
  m.def(
      "calibrate",
      [](const TetMesh& mesh, PointsIn vertices, FacesIn faces, std::optional<double> poisson,
         std::optional<std::size_t> reference_tets, nb::object progress) {
        const TriangleSoup soup = copy_soup(vertices, faces);
        CalibrateOptions options;
        options.poisson = poisson.value_or(options.poisson);
        options.reference_tets = reference_tets.value_or(options.reference_tets);
        return call_library(progress, [&](const Progress& watched) {
          const TetMesh fine = calibration_reference(soup, {}, options.reference_tets, watched);
          return calibrate_tets({&mesh, {}, {}}, {&fine, {}, {}}, options, watched);
        });
      },
      nb::arg("mesh"), nb::arg("vertices"), nb::arg("faces"), nb::arg("poisson").none(),
      nb::arg("reference_tets").none(), nb::arg("progress").none());
}

}  // namespace tetsoup::python
