// tetsoup::io: what every stage has to say, as JSON for scripts and pages. Member names are a promise; numbers that do
// not exist (NaN, infinity) are null; angles are degrees.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tetsoup/calibrate.h"
#include "tetsoup/pipeline.h"
#include "tetsoup/quality.h"
#include "tetsoup/readiness.h"
#include "tetsoup/simulate.h"
#include "tetsoup/tet_model.h"
#include "tetsoup/types.h"

namespace tetsoup {

std::string to_json(const SoupReport& soup);
std::string to_json(const GridFrame& frame);  ///< The grid, and the memory that it takes.
std::string to_json(const PseudoVolumeReport& report);
std::string to_json(const LatticeReport& report);
std::string to_json(const SmoothReport& report);
std::string to_json(const Quality& quality);
std::string to_json(const Fidelity& fidelity);
std::string to_json(const Readiness& readiness, const Material& material);
std::string to_json(const Calibration& calibration);
std::string to_json(const EmbedReport& report);
std::string to_json(const MeshOptions& options);
std::string to_json(const SimulationReport& report);
std::string to_json(const Energy& energy);
/// Arrays: name, material, number of tets, volume and mass (kg) of every region; name and number of vertices of all
/// pins.
std::string regions_json(const TetModel& model);
std::string pins_json(const TetModel& model);

/// What is known of a finished mesh, and what it is for.
struct Findings {
  const Pipeline& pipeline;  ///< Every stage has run.
  const Quality& quality;    ///< Of the final mesh.
  const Fidelity& fidelity;  ///< Of the same to the soup.
  std::string engine = {};   ///< That the mesh is written for; empty: none.
  double metres_per_unit = 1;
};

/// What the user should know: what was found or could not be had, and the option of `tetsoup mesh` that changes it; one
/// sentence or two each, in the order of the stages. What a stage has to say stands in its own report's `notes`.
std::vector<std::string> notes_of(const Findings& found);
/// Why the grid is coarser than asked, or none; notes_of() holds them.
std::vector<std::string> grid_notes(const CleanSoup& soup, const DistanceOptions& asked, const GridFrame& frame);

/// The smallest of 500, 1,000, 2,000 ... 32,000 tets whose mesh passes all that readiness asks of its fidelity to the
/// soup: what `--tets auto` takes. Each is tried with the options as they are, and the pipeline is left with the
/// answer's mesh; where none passes, with that of the largest number, which is told by `held`.
struct CountSearch {
  std::size_t tets = 0;
  bool held = false;
  /// What the user should know where none passes; else empty.
  std::string note() const;
};
CountSearch find_tet_count(Pipeline& pipeline, const MeshOptions& options, const Progress& progress = {});

/// A report that people look at.
struct ReportPage {
  std::string title = "mesh";          ///< Such as the file's name.
  const TetMesh* mesh = nullptr;       ///< Must be there.
  const TriangleSoup* soup = nullptr;  ///< Shown around it, if it is there.
  std::string up = "z";                ///< The axis that points up: "x", "y" or "z".
  double metres_per_unit = 1;          ///< 1: lengths are shown without a unit.
  std::string json;  ///< Object as `tetsoup mesh --json` writes; what it lacks is measured or not shown.
};

/// One page of HTML that needs nothing else, and no network: the mesh in 3D with a plane that cuts it, the histogram of
/// its angles, and what the JSON says. The page is made of the studio's views.
/// @throws InvalidInput  without a mesh, for another `up`, or if the JSON is none.
std::string report_page(const ReportPage& page);
/// @throws IoError  if it cannot be written; the file is there whole or not at all.
void write_report_page(const std::filesystem::path& path, const ReportPage& page);

}  // namespace tetsoup
