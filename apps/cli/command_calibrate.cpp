// tetsoup calibrate: stiffness and density for the tets of any mesh, by the model it was made of.
#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>

#include "calibration.h"
#include "commands.h"
#include "files.h"
#include "interrupt.h"
#include "options.h"
#include "readiness_page.h"
#include "report_json.h"
#include "soup_input.h"
#include "tetsoup/io.h"
#include "tetsoup/report.h"

namespace tetsoup::cli {

namespace {

struct CalibrateCommand {
  std::string input, model, output;
  std::optional<std::string> json;
  std::optional<double> poisson;
  Material material;
  bool quiet = false;
};

constexpr const char* kExamples =
    "Examples:\n"
    "  tetsoup calibrate horse.msh --model horse.obj -o horse.npz    any tool's mesh, and what it was made of\n"
    "  tetsoup calibrate horse.vtk --model horse.obj -o horse.vtu --json -   what was gained, for scripts\n"
    "\n"
    "Files that hold every tet's factors: .npz .vtu .vtk; .inp and .veg hold them in eight steps.";

void run_calibrate(const CalibrateCommand& command) {
  check_input(command.input);
  check_input(command.model);
  Outputs outputs(command.input);
  const TetFormat format = outputs.add_mesh("-o", command.output, {});
  if (command.json && *command.json != "-") outputs.add("--json", *command.json);
  ProgressBar bar(command.quiet);
  bar.show("read");
  TetModel model;
  model.mesh = read_tets(command.input);
  model.regions = {{model.name, command.material}};
  const TriangleSoup soup = read_input_soup(command.model);
  throw_if_interrupted();
  const Calibration calibration = calibrate_model(model, soup, {}, command.poisson, bar);
  bar.clear();
  throw_if_interrupted();
  write_tets(command.output, model, format);
  if (command.json) write_report(*command.json, to_json(calibration) + "\n");
  if (command.quiet) return;
  const std::string text =
      describe_calibration(calibration, {{command.output, calibration_of(format)}}) + "Wrote " + command.output + "\n";
  if (command.json == "-")
    fmt::print(stderr, "{}", text);
  else
    write_stdout(text);
}

}  // namespace

void add_calibrate_command(CLI::App& app) {
  const auto command = std::make_shared<CalibrateCommand>();
  CLI::App* const calibrate =
      app.add_subcommand("calibrate", "Find stiffness and density of tets with which a mesh moves like a fine one");
  calibrate->group("Commands")->footer(kExamples);
  calibrate->add_option("MESH", command->input, "Tets: .msh .vtk .vtu .mesh .npz .node")->required()->option_text(" ");
  add_flag(
      *calibrate, "--model", "SOUP", [command](const std::string& text) { command->model = text; },
      "The triangles that the mesh was made of")
      ->required();
  add_flag(
      *calibrate, "-o,--output", "OUT", [command](const std::string& text) { command->output = text; },
      "File for the mesh with its factors")
      ->required();
  add_flag(
      *calibrate, "--json", "FILE|-", [command](const std::string& text) { command->json = text; },
      "Write a report for scripts; - is standard output");
  add_material_flags(*calibrate, command->material);
  add_threads_flag(*calibrate);
  add_quiet_flag(*calibrate, command->quiet);
  calibrate->callback([command, calibrate] {
    if (calibrate->count("--poisson") > 0) command->poisson = command->material.poisson;
    run_calibrate(*command);
  });
}

}  // namespace tetsoup::cli
