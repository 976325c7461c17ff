// tetsoup simulate: a scene in, its motion out.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>

#include "arguments.h"
#include "commands.h"
#include "files.h"
#include "interrupt.h"
#include "options.h"
#include "simulate_report.h"
#include "simulate_run.h"
#include "soup_input.h"
#include "tetsoup/error.h"

namespace tetsoup::cli {

namespace {

constexpr Range kSeconds{.low = 0, .high = 3600, .words = "seconds from 0 to 3600"};
constexpr Range kFps{.low = 1, .high = 1000, .words = "a number from 1 to 1000"};
constexpr Range kSubsteps{.low = 1, .high = 10000, .words = "a whole number from 1 to 10000"};

constexpr const char* kGroup = "Simulation";
constexpr const char* kReports = "Reports";

constexpr const char* kExamples =
    "Examples:\n"
    "  tetsoup simulate --list                              scenes that come with the tool\n"
    "  tetsoup simulate drop                                play one, and say how fast that went\n"
    "  tetsoup simulate drop --save-scene my.json           write it as a file, to be changed (docs/SCENES.md)\n"
    "  tetsoup simulate drop --preview                      a film to look at: drop.webp\n"
    "  tetsoup simulate my.json -o DIR                      every frame for ParaView, DIR/frames.pvd\n"
    "  tetsoup simulate my.json -o my.glb                   one animation for Blender, the web and game engines\n"
    "  tetsoup simulate my.json -o skin.obj                 the surfaces of every frame: skin_0000.obj, ...\n"
    "  tetsoup simulate my.json -o DIR --resume             go on where Ctrl-C stopped it\n"
    "  tetsoup simulate my.json --seconds 2 --json -        numbers for scripts\n"
    "\n"
    "Exit codes: 0 done, 1 internal error or out of memory, 2 wrong usage or option, 3 a file cannot be read or\n"
    "written, or is no scene, 130 cancelled; a folder then holds all frames so far, and --resume goes on.";

void list_scenes() {
  std::string text;
  for (const std::string& name : scene_names()) text += fmt::format("{:<24} {}\n", name, scene_summary(name));
  write_stdout(text + "Play one with: tetsoup simulate NAME\n");
}

void save_scene(const std::string& path, const Scene& scene, bool quiet) {
  if (path != "-") Outputs({}).add("--save-scene", path, ".json");
  write_report(path, scene_text(scene));
  if (!quiet && path != "-") write_stdout(fmt::format("Wrote {}. Play it with: tetsoup simulate {}\n", path, path));
}

/// The usual places are not checked: nobody named them.
bool is_frame_file(const std::string& path) {
  static constexpr std::array<std::string_view, 6> kExtensions{".pvd", ".obj", ".ply", ".png", ".webp", ".glb"};
  const std::string extension = lower_extension(path);
  return std::find(kExtensions.begin(), kExtensions.end(), extension) != kExtensions.end();
}

void check_frame_file(std::string_view flag, const std::string& path, Outputs& outputs) {
  if (!is_frame_file(path))
    throw IoError(
        fmt::format("{} {}: frames are written into a folder, .pvd, .obj, .ply, .png, .webp or .glb", flag, path));
  outputs.add(flag, path);
}

/// Whatever is wrong with the outputs is found here, before the work starts.
void check_outputs(const SimulateOptions& options) {
  Outputs outputs(options.input);
  std::size_t folders = 0;
  for (const std::string& path : options.outputs) {
    if (!is_folder_output(path))
      check_frame_file("-o", path, outputs);
    else if (++folders > 1)
      throw InvalidInput(fmt::format("-o {}: only one folder can be given", path));
  }
  if (options.preview && !options.preview->empty()) {
    const std::string extension = lower_extension(*options.preview);
    if (extension != ".png" && extension != ".webp")
      throw IoError(fmt::format("--preview {}: pictures are .png, a film is .webp", *options.preview));
    outputs.add("--preview", *options.preview);
  }
  if (options.json && *options.json != "-") outputs.add("--json", *options.json);
  if (options.resume && folders == 0) throw InvalidInput("--resume: name the folder that is to go on, with -o DIR");
}

void run_simulate(const SimulateOptions& options) {
  const Stopwatch watch;
  if (options.list) return list_scenes();
  if (options.input.empty())
    throw InvalidInput("SCENE is missing; `tetsoup simulate --list` shows those that come with the tool");
  const Scene scene = open_scene(options);
  if (options.save_scene) return save_scene(*options.save_scene, scene, options.quiet);
  check_outputs(options);
  ProgressBar bar(options.quiet);
  bar.show("load");
  LoadedScene loaded = load_scene(scene, bar.callback());
  const double load_seconds = watch.seconds();
  throw_if_interrupted();
  SimulateRun run = play_scene(options, loaded, bar);
  run.seconds.load = load_seconds;
  run.seconds.total = watch.seconds();
  if (options.json) write_report(*options.json, simulation_json(run, loaded));
  if (options.quiet) return;
  if (options.json && *options.json == "-")
    fmt::print(stderr, "{}", describe_simulation(run, loaded));
  else
    write_stdout(describe_simulation(run, loaded));
}

void add_scene_flags(CLI::App& app, SimulateOptions& options) {
  add_flag(
      app, "--seconds", "T",
      [&options](const std::string& text) { options.seconds = parse_number("--seconds", text, kSeconds); },
      "Time in the scene (what the scene says)")
      ->group(kGroup);
  add_flag(
      app, "--fps", "N", [&options](const std::string& text) { options.fps = parse_number("--fps", text, kFps); },
      "Frames a second of that time (what the scene says)")
      ->group(kGroup);
  add_flag(
      app, "--substeps", "N",
      [&options](const std::string& text) { options.substeps = parse_whole("--substeps", text, kSubsteps); },
      "Substeps of each 1/60 s, at least: more are stiffer and slower\n(what the scene says)")
      ->group(kGroup);
  const auto read_solver = [&options](const std::string& text) {
    if (text != "implicit" && text != "potentials")
      throw InvalidInput("--solver " + text + ": must be implicit or potentials");
    options.solver = text == "implicit" ? Solver::Implicit : Solver::Potentials;
  };
  add_flag(app, "--solver", "implicit|potentials", read_solver,
           "Stable at any step, or the paper's forces (what the scene says)")
      ->group(kGroup);
}

}  // namespace

void add_simulate_command(CLI::App& app) {
  const auto options = std::make_shared<SimulateOptions>();
  CLI::App* const simulate = app.add_subcommand("simulate", "Let bodies fall, bend and collide");
  simulate->group("Commands")->footer(kExamples);
  simulate->add_option("SCENE", options->input, "A scene that comes with the tool, or a file: .json")->option_text(" ");
  simulate->add_flag("--list", options->list, "List the scenes that come with the tool");
  simulate
      ->add_option_function<std::vector<std::string>>(
          "-o,--output", [options](const std::vector<std::string>& paths) { options->outputs = paths; },
          "A folder for .vtu frames, or .pvd .obj .ply .png series, or a film:\n.webp .glb; may be given several times")
      ->option_text("OUT")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  simulate->add_flag("--resume", options->resume, "Go on with the folder of a run that was cancelled");
  add_flag(
      *simulate, "--save-scene", "FILE", [options](const std::string& text) { options->save_scene = text; },
      "Write the scene itself as .json, to be changed, and end");
  add_scene_flags(*simulate, *options);
  add_flag(
      *simulate, "--json", "FILE|-", [options](const std::string& text) { options->json = text; },
      "Write a report for scripts; - is standard output")
      ->group(kReports);
  simulate
      ->add_option_function<std::vector<std::string>>(
          "--preview",
          [options](const std::vector<std::string>& names) { options->preview = names.empty() ? "" : names.front(); },
          "Draw the frames: .webp for a film, .png for pictures (NAME.webp, or\nboth into the folder of -o)")
      ->option_text("[FILE]")
      ->expected(0, 1)
      ->group(kReports);
  add_threads_flag(*simulate);
  add_quiet_flag(*simulate, options->quiet);
  simulate->callback([options] { run_simulate(*options); });
}

}  // namespace tetsoup::cli
