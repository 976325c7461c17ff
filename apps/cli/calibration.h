// What --calibrate and `tetsoup calibrate` have in common.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mesh_run.h"
#include "progress_bar.h"
#include "tetsoup/calibrate.h"
#include "tetsoup/tet_model.h"

namespace tetsoup::cli {

void add_calibrate_flag(CLI::App& app, bool& calibrate);

/// Makes the fine mesh, calibrates the model by it, and puts the scales into it. Moduli and densities of regions count.
/// @param poisson  Where it was given; else one in the middle of what solids have.
Calibration calibrate_model(TetModel& model, const TriangleSoup& soup, const MeshOptions& options,
                            std::optional<double> poisson, ProgressBar& bar);

/// What was gained, and what each file holds of it: for the summary.
std::string describe_calibration(const Calibration& calibration, const std::vector<CalibratedFile>& files);

/// For reports: "per-tet", "steps", "one-factor", "none".
std::string_view name_of(CalibrationForm form);

}  // namespace tetsoup::cli
