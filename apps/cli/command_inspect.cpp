// tetsoup inspect: what is this soup, or how good is this tet mesh?
#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "commands.h"
#include "files.h"
#include "interrupt.h"
#include "options.h"
#include "progress_bar.h"
#include "readiness_page.h"
#include "report_json.h"
#include "summary.h"
#include "tetsoup/io.h"

namespace tetsoup::cli {

namespace {

struct InspectCommand {
  std::string input;
  std::optional<std::string> json;
  Material material;
  bool quiet = false;
};

constexpr const char* kExamples =
    "Examples:\n"
    "  tetsoup inspect bunny.ply             parts and their names, open edges, triangles that cannot be used\n"
    "  tetsoup inspect bunny.msh             quality of a tet mesh, histogram of its dihedral angles\n"
    "  tetsoup inspect bunny.msh --json -    the same for scripts";

struct Diagnosis {
  std::string table;
  std::string json;
};

Diagnosis diagnose(const std::string& input, const Material& material, ProgressBar& bar) {
  bar.show("read");
  if (is_tet_file(input)) {
    const TetMesh mesh = read_tets(input);
    throw_if_interrupted();
    bar.show("measure");
    const Quality quality = measure_quality(mesh);
    const Readiness readiness = assess_readiness(mesh, quality, material);
    return {tabulate_tets(input, quality) + describe_readiness(readiness, material),
            tets_report_json(input, quality, readiness, material)};
  }
  const RenderMesh surface = read_render_mesh(input);
  const std::vector<PartName> parts = part_names(surface);
  const TriangleSoup soup = triangles_of(surface);
  const SoupReport report = clean_soup(soup, bar.callback()).report;
  std::string table = tabulate_soup(input, report, parts);
  if (report.kind != SoupClass::Empty)
    table += tabulate_connected_parts(soup) + "Mesh it with: tetsoup mesh " + input + " -o out.msh\n";
  return {table, soup_report_json(input, report, parts)};
}

void run_inspect(const InspectCommand& command) {
  check_input(command.input);
  const bool json_to_stdout = command.json == "-";
  if (command.json && !json_to_stdout) Outputs(command.input).add("--json", *command.json);
  ProgressBar bar(command.quiet);
  const Diagnosis diagnosis = diagnose(command.input, command.material, bar);
  bar.clear();
  throw_if_interrupted();
  if (command.json) write_report(*command.json, diagnosis.json);
  if (command.quiet) return;
  if (json_to_stdout)
    fmt::print(stderr, "{}", diagnosis.table);
  else
    write_stdout(diagnosis.table);
}

}  // namespace

void add_inspect_command(CLI::App& app) {
  const auto command = std::make_shared<InspectCommand>();
  CLI::App* const inspect = app.add_subcommand("inspect", "Diagnose a triangle soup, or measure a tet mesh");
  inspect->group("Commands")->footer(kExamples);
  inspect
      ->add_option("IN", command->input,
                   "Triangles (.obj .stl .ply .off .gltf .glb .3mf .dae) or tets (.msh .vtk .vtu .mesh .npz .node)")
      ->required()
      ->option_text(" ");
  add_flag(
      *inspect, "--json", "FILE|-", [command](const std::string& text) { command->json = text; },
      "Write a report for scripts; - is standard output");
  add_material_flags(*inspect, command->material);
  add_quiet_flag(*inspect, command->quiet);
  inspect->callback([command] { run_inspect(*command); });
}

}  // namespace tetsoup::cli
