#include "simulate_run.h"

#include <fmt/format.h>

#include <algorithm>

#include "commands.h"
#include "files.h"
#include "interrupt.h"
#include "simulate_files.h"
#include "soup_input.h"
#include "tetsoup/error.h"

namespace tetsoup::cli {

namespace fs = std::filesystem;

namespace {

constexpr double kSaveInterval = 10;  // s between two states, so that little is lost if the machine goes down

bool is_builtin(const std::string& name) {
  const std::vector<std::string> names = scene_names();
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Whether no frame can be added to the file by a later run.
bool is_film(const fs::path& path) {
  return lower_extension(path) == ".webp" || lower_extension(path) == ".glb";
}

/// Everything that is done with the frames of one run.
class Player {
 public:
  Player(const SimulateOptions& options, LoadedScene& loaded, ProgressBar& bar);
  void play();
  /// Once there is nothing more to be played.
  void finish();

  SimulateRun run;

 private:
  /// Measures what one step of the loop takes.
  template <class Action>
  static void timed(double& seconds, const Action& action) {
    const Stopwatch watch;
    action();
    seconds += watch.seconds();
  }
  void begin();
  void note_frame();
  void record();
  void save() {
    if (folder_) timed(run.seconds.write, [&] { folder_->save(loaded_, view_or_before()); });
    since_save_ = Stopwatch();
  }
  std::optional<Box3> view_or_before() const {
    const std::optional<Box3> view = files_->view();
    return view || !folder_ ? view : folder_->view();
  }

  LoadedScene& loaded_;
  ProgressBar& bar_;
  std::optional<SimulationFolder> folder_;
  std::optional<FrameFiles> files_;
  Stopwatch since_save_;
};

Player::Player(const SimulateOptions& options, LoadedScene& loaded, ProgressBar& bar) : loaded_(loaded), bar_(bar) {
  run.input = options.input;
  for (const fs::path& path : options.frame_files()) {
    if (is_folder_output(path)) folder_.emplace(path, loaded.scene, options.resume);
    run.outputs.push_back(path);
  }
  if (folder_ && options.resume) folder_->resume(loaded);
  run.resumed_after = loaded.frame;
  if (loaded.frame > 0 && options.preview && options.preview->empty()) std::erase_if(run.outputs, is_film);
  files_.emplace(run.outputs, loaded, folder_ ? folder_->view() : std::nullopt);
  if (folder_ && !folder_->frames().empty())
    run.state_hash = loaded.simulation.state_hash();
  else
    begin();
}

/// The state comes before the frame: whatever ends this run from here on, another can go on with the folder.
void Player::begin() {
  run.state_hash = loaded_.simulation.state_hash();
  note_frame();
  save();
  timed(run.seconds.write, [&] { files_->add_frame(run.state_hash); });
}

void Player::note_frame() {
  if (folder_) folder_->add({loaded_.frame, static_cast<double>(loaded_.frame) / loaded_.scene.fps, run.state_hash});
}

void Player::record() {
  run.state_hash = loaded_.simulation.state_hash();
  timed(run.seconds.write, [&] { files_->add_frame(run.state_hash); });
  note_frame();
}

void Player::play() {
  const Progress progress = bar_.callback();
  const std::size_t count = frame_count(loaded_.scene);
  while (loaded_.frame < count && !interrupted()) {
    timed(run.seconds.simulate, [&] { advance_frame(loaded_); });
    timed(run.seconds.embed, [&] { deform_surfaces(loaded_); });
    record();
    const SimulationReport& report = loaded_.simulation.report();
    run.most_contacts = std::max(run.most_contacts, report.contacts);
    run.most_touching = std::max(run.most_touching, report.touching);
    if (since_save_.seconds() > kSaveInterval) save();
    progress("simulate", static_cast<double>(loaded_.frame) / static_cast<double>(count));
  }
  run.frames = loaded_.frame;
}

void Player::finish() {
  const std::size_t count = frame_count(loaded_.scene);
  const bool whole = loaded_.frame >= count;
  if (!whole && !folder_) {
    files_->remove_all();
    throw Cancelled();
  }
  save();
  timed(run.seconds.write, [&] { files_->finish(); });
  bar_.clear();
  if (!whole)
    throw CancelledMidway(fmt::format(
        "cancelled after frame {} of {}; the same command with --resume goes on from there", loaded_.frame, count));
}

}  // namespace

std::vector<fs::path> SimulateOptions::frame_files() const {
  std::vector<fs::path> paths(outputs.begin(), outputs.end());
  if (!preview) return paths;
  if (!preview->empty()) {
    paths.emplace_back(*preview);
    return paths;
  }
  const auto folder = std::find_if(paths.begin(), paths.end(), is_folder_output);
  if (folder == paths.end()) {
    paths.push_back(fs::path(input).stem().string() + ".webp");
  } else {
    const fs::path in = *folder;
    paths.push_back(in / "preview.png");
    paths.push_back(in / "preview.webp");
  }
  return paths;
}

double SimulateRun::real_time_factor(double fps) const {
  const double wall = seconds.simulate + seconds.embed;
  return wall > 0 ? static_cast<double>(frames - resumed_after) / fps / wall : 0;
}

bool is_folder_output(const fs::path& path) {
  std::error_code ignored;
  return !path.has_extension() || fs::is_directory(path, ignored);
}

Scene open_scene(const SimulateOptions& options) {
  Scene scene;
  std::error_code ignored;
  if (is_builtin(options.input) && !fs::exists(options.input, ignored)) {
    scene = make_scene(options.input);
  } else if (options.input.find('.') == std::string::npos && !fs::exists(options.input, ignored)) {
    throw InvalidInput(fmt::format("{}: there is neither such a scene nor such a file; the scenes are {}",
                                   options.input, fmt::join(scene_names(), ", ")));
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
  Player player(options, loaded, bar);
  player.play();
  player.finish();
  return player.run;
}

}  // namespace tetsoup::cli
