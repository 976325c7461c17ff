// tetsoup field: the grids between soup and mesh, for a viewer.
#include <fmt/format.h>

#include <memory>

#include "commands.h"
#include "files.h"
#include "interrupt.h"
#include "options.h"
#include "soup_input.h"
#include "summary.h"
#include "tetsoup/io.h"
#include "tetsoup/report.h"

namespace tetsoup::cli {

namespace {

struct FieldCommand {
  std::string input;
  std::string output;
  std::optional<double> point_size;
  bool band_only = false;
  MeshOptions options;
  RunOptions run;
};

constexpr const char* kExamples =
    "Examples:\n"
    "  tetsoup field bunny.ply -o bunny.vti                 distance, votes and inside, for ParaView\n"
    "  tetsoup field bunny.ply -o bunny.vti --band-only     faster; distances far from the surface are infinite";

void run_field(FieldCommand& command) {
  const Stopwatch watch;
  check_input(command.input);
  Outputs(command.input).add("-o", command.output, ".vti");
  ProgressBar bar(command.run.quiet);
  double read_seconds = 0;
  Pipeline pipeline = open_pipeline(command.input, command.point_size, bar, read_seconds);
  command.options.distance.mode = command.band_only ? DistanceMode::Band : DistanceMode::Full;
  command.options.memory_limit = memory_limit(command.run);
  pipeline.run_until(Stage::PseudoVolume, command.options, bar.callback());
  bar.show("write");
  NewFiles files;
  files.expect(command.output);
  write_field(command.output, pipeline.distance(), pipeline.pseudo_volume());
  bar.clear();
  throw_if_interrupted();
  files.keep();
  if (command.run.quiet) return;
  const GridFrame& frame = pipeline.grid();
  std::string notes;
  for (const std::string& note : grid_notes(pipeline.soup(), command.options.distance, frame))
    notes += "Note: " + note + "\n";
  for (const std::string& note : pipeline.pseudo_volume().report.notes) notes += "Note: " + note + "\n";
  write_stdout(
      fmt::format("{}{}{}Time: {:.2f} s (read {:.2f}, clean {:.2f}, distance {:.2f}, pseudo volume {:.2f})\nWrote {}\n",
                  describe_soup(command.input, pipeline.soup().report),
                  describe_volume(frame, pipeline.pseudo_volume().report, pipeline.soup().report), notes,
                  watch.seconds(), read_seconds, pipeline.seconds(Stage::Soup), pipeline.seconds(Stage::Distance),
                  pipeline.seconds(Stage::PseudoVolume), command.output));
}

}  // namespace

void add_field_command(CLI::App& app) {
  const auto command = std::make_shared<FieldCommand>();
  CLI::App* const field = app.add_subcommand("field", "Write distance, votes and inside bits on a grid");
  field->group("Commands")->footer(kExamples);
  field->add_option("IN", command->input, "Triangles: .obj .stl .ply .off .gltf .glb .3mf .dae")
      ->required()
      ->option_text(" ");
  field->add_option("-o,--output", command->output, "File for the grids: .vti")->required()->option_text("OUT");
  add_point_flag(*field, command->point_size);
  add_grid_flags(*field, command->options.distance);
  field->add_flag("--band-only", command->band_only, "Distances only where meshing needs them, infinite elsewhere")
      ->group("Voxel grid");
  add_volume_flags(*field, command->options.pseudo_volume);
  add_run_flags(*field, command->run);
  field->callback([command] { run_field(*command); });
}

}  // namespace tetsoup::cli
