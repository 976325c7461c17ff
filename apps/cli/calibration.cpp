#include "calibration.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "options.h"
#include "readiness_page.h"
#include "summary.h"
#include "tetsoup/engines.h"

namespace tetsoup::cli {

namespace {

/// Every tet's modulus and density, over those of the first region.
struct Values {
  std::vector<double> stiffness, density;
};
Values values_of(const TetModel& model, const std::vector<std::uint32_t>& regions) {
  Values values;
  const Material& first = model.regions.front().material;
  for (const std::uint32_t region : regions) {
    values.stiffness.push_back(model.regions[region].material.young / first.young);
    values.density.push_back(model.regions[region].material.density / first.density);
  }
  return values;
}

/// The region of the coarse tet that a fine one's centre lies in.
std::vector<std::uint32_t> regions_at(const TetModel& model, const TetMesh& fine) {
  std::vector<std::uint32_t> regions;
  if (model.tet_regions.empty()) return regions;
  TriangleSoup centres;
  centres.origin = fine.origin;
  for (const Tet& tet : fine.tets) {
    Vec3 sum;
    for (const std::uint32_t v : tet) {
      sum.x += fine.vertices[v].x / 4;
      sum.y += fine.vertices[v].y / 4;
      sum.z += fine.vertices[v].z / 4;
    }
    centres.vertices.push_back(sum);
  }
  for (const std::uint32_t tet : embed_points(model.mesh, centres).tets) regions.push_back(model.tet_regions[tet]);
  return regions;
}

}  // namespace

void add_calibrate_flag(CLI::App& app, bool& calibrate) {
  app.add_flag_callback(
         "--calibrate", [&calibrate] { calibrate = true; },
         "Multiply each tet's stiffness and density so that the mesh has\nthe eigenfrequencies, compliance and mass of "
         "one of 40,000 tets\n(a few seconds)")
      ->option_text(" ")
      ->group(kMaterialGroup);
}

Calibration calibrate_model(TetModel& model, const TriangleSoup& soup, const MeshOptions& options,
                            std::optional<double> poisson, ProgressBar& bar) {
  CalibrateOptions calibrate;
  calibrate.poisson = std::min(poisson.value_or(kUsualPoisson), 0.49);
  const TetMesh fine = calibration_reference(soup, options, calibrate.reference_tets, bar.callback());
  const Values own = values_of(model, model.tet_regions), of_fine = values_of(model, regions_at(model, fine));
  Calibration result = calibrate_tets({&model.mesh, own.stiffness, own.density},
                                      {&fine, of_fine.stiffness, of_fine.density}, calibrate, bar.callback());
  model.stiffness_scale = result.stiffness_scale;
  model.density_scale = result.density_scale;
  model.stiffness_factor = result.factor;
  return result;
}

std::string describe_calibration(const Calibration& calibration, const std::vector<CalibratedFile>& files) {
  const CalibrateReport& report = calibration.report;
  const auto percent = [](double error) { return fmt::format("{:.2g} %", 100 * error); };
  const auto stiffness = [&](double compliance) {
    const bool stiff = compliance < 1;
    return fmt::format("{} too {}", percent(stiff ? 1 / compliance - 1 : compliance - 1), stiff ? "stiff" : "soft");
  };
  std::string text = fmt::format(
      "Moves like {}: frequencies within {} (1 to 10) and {} (from 11 on), {} under loads; without calibration they "
      "would be {} and {} off, and the body {}.\n",
      counted(report.reference_tets, "tet"), percent(report.after.low), percent(report.after.high),
      stiffness(report.after.compliance), percent(report.before.low), percent(report.before.high),
      stiffness(report.before.compliance));
  text += fmt::format(
      "  Young's modulus of tets times {:.3g} to {:.3g}, density times {:.3g} to {:.3g}; where an engine takes one "
      "modulus only, times {:.3g}: frequencies within {} and {}, {} under loads.\n",
      report.least_stiffness, report.most_stiffness, report.least_density, report.most_density, calibration.factor,
      percent(report.one.low), percent(report.one.high), stiffness(report.one.compliance));
  if (report.uncalibrated > 0)
    text += fmt::format("  {} of {} are not pieces of the fine mesh; they took the one factor.\n",
                        grouped(report.uncalibrated), counted(report.pieces, "piece"));
  for (const CalibratedFile& file : files) {
    const std::string name = file.path.filename().string();
    if (file.holds == CalibrationForm::PerTet)
      text += fmt::format("  {} holds every tet's factors, or its scene does.\n", name);
    else if (file.holds == CalibrationForm::Steps)
      text += fmt::format("  {} holds them in up to eight steps a region, as materials.\n", name);
    else if (file.holds == CalibrationForm::OneFactor)
      text += fmt::format("  {} or its scene holds the one factor and the mean density.\n", name);
    else
      text += fmt::format("  {} has no place for materials: multiply the modulus that you set by {:.4g}.\n", name,
                          calibration.factor);
  }
  return text;
}

std::string_view name_of(CalibrationForm form) {
  switch (form) {
    case CalibrationForm::PerTet:
      return "per-tet";
    case CalibrationForm::Steps:
      return "steps";
    case CalibrationForm::OneFactor:
      return "one-factor";
    case CalibrationForm::None:
      break;
  }
  return "none";
}

}  // namespace tetsoup::cli
