// tetsoup sample: shapes made by formula, to start with.
#include <fmt/format.h>

#include <memory>

#include "arguments.h"
#include "commands.h"
#include "files.h"
#include "interrupt.h"
#include "options.h"
#include "summary.h"
#include "tetsoup/error.h"
#include "tetsoup/io.h"
#include "tetsoup/samples.h"

namespace tetsoup::cli {

namespace {

struct SampleCommand {
  std::string name;
  std::optional<std::string> output;
  SampleOptions options;
  bool quiet = false;
};

constexpr Range kDamage{.low = 0, .high = 1, .high_included = false, .words = "a number from 0 to below 1"};

constexpr const char* kExamples =
    "Examples:\n"
    "  tetsoup sample                                        list the samples\n"
    "  tetsoup sample torus                                  write torus.obj\n"
    "  tetsoup sample sphere -o broken.ply --damage 0.5      half of the triangles removed at random\n"
    "  tetsoup sample cup --wall 0.01                        a cup whose wall is a hundredth of its height";

void list_samples() {
  std::string text;
  for (const std::string& name : sample_names()) text += fmt::format("{:<16} {}\n", name, sample_summary(name));
  write_stdout(text + "Write one with: tetsoup sample NAME -o FILE.obj\n");
}

void check_surface_output(const std::string& path) {
  Outputs({}).add_mesh("-o", path, TetFormat::Surface);
}

void run_sample(const SampleCommand& command) {
  if (command.name.empty()) {
    if (command.output) throw InvalidInput("NAME is missing; `tetsoup sample` lists the samples");
    return list_samples();
  }
  const TriangleSoup soup = make_sample(command.name, command.options);
  const std::string path = command.output.value_or(command.name + ".obj");
  check_surface_output(path);
  throw_if_interrupted();
  write_surface(path, soup.vertices, soup.triangles);
  if (command.quiet) return;
  write_stdout(fmt::format("Wrote {} ({}). Mesh it with: tetsoup mesh {} -o {}.msh\n", path,
                           counted(soup.triangles.size(), "triangle"), path, command.name));
}

}  // namespace

void add_sample_command(CLI::App& app) {
  const auto command = std::make_shared<SampleCommand>();
  CLI::App* const sample = app.add_subcommand("sample", "Write a sample soup, or list the samples");
  sample->group("Commands")->footer(kExamples);
  sample->add_option("NAME", command->name, "Which one; without it the samples are listed")->option_text(" ");
  add_flag(
      *sample, "-o,--output", "OUT", [command](const std::string& text) { command->output = text; },
      "File: .obj .stl .ply (NAME.obj)");
  add_flag(
      *sample, "--damage", "X",
      [command](const std::string& text) { command->options.damage = parse_number("--damage", text, kDamage); },
      "Share of the triangles removed at random, [0, 1) (0)");
  add_flag(
      *sample, "--wall", "X",
      [command](const std::string& text) { command->options.wall = parse_number("--wall", text, kPositive); },
      "Thickness of a cup's, pipe's or tray's wall, a comb's tooth, a chain's\nwire, as a share of the length");
  add_flag(
      *sample, "--seed", "N",
      [command](const std::string& text) { command->options.seed = parse_seed("--seed", text); },
      "Seed of whatever is random (1)");
  add_quiet_flag(*sample, command->quiet);
  sample->callback([command] { run_sample(*command); });
}

}  // namespace tetsoup::cli
