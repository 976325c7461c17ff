// A scene played from beginning to end: what it is to do, and all that is known afterwards.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "progress_bar.h"
#include "simulate_folder.h"
#include "tetsoup/scene.h"

namespace tetsoup::cli {

struct SimulateOptions {
  std::string input;                   ///< Name of a built-in scene, or a file.
  std::vector<std::string> outputs;    ///< A folder, and files.
  std::optional<std::string> preview;  ///< Empty: the usual place.
  std::optional<std::string> save_scene;
  std::optional<std::string> json;
  std::optional<double> seconds, fps;
  std::optional<int> substeps;
  std::optional<Solver> solver;
  bool resume = false;
  bool list = false;
  bool quiet = false;

  /// All that frames go into.
  std::vector<std::filesystem::path> frame_files() const;
};

/// Wall seconds of this run.
struct SimulateTimings {
  double load = 0;      ///< Reading, meshing, hanging the surfaces on.
  double simulate = 0;  ///< Steps,
  double embed = 0;     ///< and moving all surfaces after each.
  double write = 0;     ///< Files and pictures.
  double total = 0;
};

struct SimulateRun {
  std::string input;
  std::size_t frames = 0;         ///< Since the scene's start,
  std::size_t resumed_after = 0;  ///< of which so many were simulated before.
  std::uint64_t state_hash = 0;   ///< Of the last.
  std::size_t most_contacts = 0, most_touching = 0;
  std::vector<std::filesystem::path> outputs;
  SimulateTimings seconds;

  /// Simulated seconds over those that simulating and moving the surfaces took; writing and drawing do not count.
  double real_time_factor(double fps) const;
};

/// The scene by name or from its file, with what the flags say.
Scene open_scene(const SimulateOptions& options);

/// Whether an output names a folder rather than a file.
bool is_folder_output(const std::filesystem::path& path);

/// Plays the scene. @throws Cancelled, or CancelledMidway where a folder is left from which it goes on.
SimulateRun play_scene(const SimulateOptions& options, LoadedScene& loaded, ProgressBar& bar);

}  // namespace tetsoup::cli
