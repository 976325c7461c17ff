#include "simulate_run.h"

#include <fmt/format.h>

#include <algorithm>

#include "commands.h"
#include "files.h"
#include "interrupt.h"
#include "soup_input.h"
#include "tetsoup/error.h"

namespace tetsoup::cli {

namespace {

constexpr double kSaveInterval = 10;  // s between two states, so that little is lost if the machine goes down

bool is_builtin(const std::string& name) {
  const std::vector<std::string> names = scene_names();
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Measures what one step of the loop takes.
template <class Action>
void timed(double& seconds, const Action& action) {
  const Stopwatch watch;
  action();
  seconds += watch.seconds();
}

std::optional<SimulationFolder> open_folder(const SimulateOptions& options, const LoadedScene& loaded) {
  for (const std::string& output : options.outputs)
    if (is_folder_output(output)) return SimulationFolder(output, loaded.scene, options.resume);
  return {};
}

}  // namespace

double SimulateRun::real_time_factor(double fps) const {
  const double wall = seconds.simulate + seconds.embed;
  return wall > 0 ? static_cast<double>(frames - resumed_after) / fps / wall : 0;
}

bool is_folder_output(const std::filesystem::path& path) {
  std::error_code ignored;
  return !path.has_extension() || std::filesystem::is_directory(path, ignored);
}

Scene open_scene(const SimulateOptions& options) {
  Scene scene;
  std::error_code ignored;
  if (is_builtin(options.input) && !std::filesystem::exists(options.input, ignored)) {
    scene = make_scene(options.input);
  } else if (options.input.find('.') == std::string::npos && !std::filesystem::exists(options.input, ignored)) {
    std::string known;
    for (const std::string& name : scene_names()) known += (known.empty() ? "" : ", ") + name;
    throw InvalidInput(
        fmt::format("{}: there is neither such a scene nor such a file; the scenes are {}", options.input, known));
  } else {
    check_input(options.input);
    scene = read_scene(options.input);
  }
  if (options.seconds) scene.seconds = *options.seconds;
  if (options.fps) scene.fps = *options.fps;
  if (options.substeps) scene.simulation.substeps = *options.substeps;
  if (options.solver) scene.simulation.solver = *options.solver;
  check_scene(scene);
  return scene;
}

SimulateRun play_scene(const SimulateOptions& options, LoadedScene& loaded, ProgressBar& bar) {
  SimulateRun run;
  run.input = options.input;
  std::optional<SimulationFolder> folder = open_folder(options, loaded);
  if (folder && options.resume) folder->resume(loaded);
  run.resumed_after = loaded.frame;
  const auto record = [&] {
    run.state_hash = loaded.simulation.state_hash();
    if (folder) folder->add({loaded.frame, static_cast<double>(loaded.frame) / loaded.scene.fps, run.state_hash});
  };
  if (!folder || folder->frames().empty()) record();
  run.state_hash = loaded.simulation.state_hash();
  const Progress progress = bar.callback();
  const std::size_t count = frame_count(loaded.scene);
  Stopwatch since_save;
  bool stopped = false;
  while (loaded.frame < count && !stopped) {
    timed(run.seconds.simulate, [&] { advance_frame(loaded); });
    timed(run.seconds.embed, [&] { deform_surfaces(loaded); });
    record();
    run.most_contacts = std::max(run.most_contacts, loaded.simulation.report().contacts);
    run.most_touching = std::max(run.most_touching, loaded.simulation.report().touching);
    if (folder && since_save.seconds() > kSaveInterval) {
      timed(run.seconds.write, [&] { folder->save(loaded, {}); });
      since_save = Stopwatch();
    }
    stopped = !progress("simulate", static_cast<double>(loaded.frame) / static_cast<double>(count));
  }
  run.frames = loaded.frame;
  if (folder) timed(run.seconds.write, [&] { folder->save(loaded, {}); });
  bar.clear();
  if (!stopped || loaded.frame == count) return run;
  if (!folder) throw Cancelled();
  throw CancelledMidway(fmt::format("cancelled after frame {} of {}; the same command with --resume goes on from there",
                                    loaded.frame, count));
}

}  // namespace tetsoup::cli
