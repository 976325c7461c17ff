// All that is known after `tetsoup mesh` has done its work; the summary and the JSON report are two views of it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tetsoup/calibrate.h"
#include "tetsoup/io.h"
#include "tetsoup/pipeline.h"
#include "tetsoup/quality.h"
#include "tetsoup/readiness.h"
#include "tetsoup/tet_model.h"

namespace tetsoup::cli {

/// Wall seconds per step.
struct Timings {
  double read = 0, soup = 0, distance = 0, pseudo_volume = 0, lattice = 0, smooth = 0;
  double quality = 0;    ///< Measuring the result.
  double calibrate = 0;  ///< The reference included.
  double preview = 0;    ///< Drawing and writing the picture.
  double write = 0;      ///< Writing the mesh files.
  double total = 0;
};

struct CalibratedFile {
  std::filesystem::path path;
  CalibrationForm holds;
};

struct MeshRun {
  std::string input;
  std::vector<std::filesystem::path> outputs;  ///< Files written, the report itself left out.
  std::string engine;                          ///< That they were written for; empty: none.
  std::string next_step;                       ///< What to do with them, one line; empty where that is open.
  MeshOptions options;
  const Pipeline* pipeline = nullptr;  ///< Every stage has run.
  TetMesh mesh;                        ///< What came out, in the input's place.
  Quality quality;                     ///< Of it.
  BoundaryDistance distance;           ///< Of its boundary from the soup, in mean edges of the lattice,
  BoundaryDistance raw_distance;       ///< and of the lattice's.
  Fidelity fidelity;                   ///< To the soup.
  double iou = 0;                      ///< Of the mesh and the pseudo volume.
  Material material;
  TetModel model;          ///< What is written.
  bool recentred = false;  ///< Without the soup's origin.
  Readiness readiness;
  std::optional<Calibration> calibration;  ///< Where it was asked for,
  std::vector<CalibratedFile> calibrated;  ///< and what became of it in each mesh file.
  std::vector<std::string> notes;          ///< For the user.
  Timings seconds;
};

/// Voxels along x, y, z over the soup's box, the padding not counted.
inline std::array<int, 3> unpadded_size(const GridFrame& frame) {
  return {frame.size[0] - 2 * frame.pad, frame.size[1] - 2 * frame.pad, frame.size[2] - 2 * frame.pad};
}

}  // namespace tetsoup::cli
