#include "mesh_outputs.h"

#include <fmt/format.h>

#include <functional>

#include "options.h"
#include "tetsoup/error.h"
#include "tetsoup/io.h"

namespace tetsoup::cli {

namespace {

std::string describe_formats() {
  std::string text = "Format, instead of the one that the file's name tells:";
  for (const TetFormatInfo& info : tet_formats()) text += fmt::format("\n{:<8} {}", info.name, info.summary);
  return text;
}

std::string describe_engines() {
  constexpr std::size_t kLineWidth = 62;
  std::string text = "What an engine reads, in metres, and a scene beside it where there\nis one, instead of --format:";
  std::string line;
  for (const Engine& engine : engines()) {
    if (line.empty() || line.size() + 1 + engine.name.size() > kLineWidth) {
      text += line + "\n";
      line = engine.name;
    } else {
      line += " " + engine.name;
    }
  }
  return text + line;
}

/// The flag is named in what the library says about its value.
template <class Act>
auto with_flag(const char* flag, const Act& act) {
  try {
    return act();
  } catch (const InvalidInput& error) {
    throw InvalidInput(fmt::format("{}: {}", flag, error.what()));
  }
}

}  // namespace

void add_output_flags(CLI::App& app, WantedMeshes& wanted) {
  app.add_option("-o,--output", wanted.paths,
                 "File for the mesh, by name .msh .vtk .vtu .mesh .node .tet .veg\n.inp .vol .npz .json .usda, or the "
                 "boundary only: .obj .stl .ply;\nmay be given several times")
      ->required()
      ->allow_extra_args(false)
      ->option_text("OUT");
  CLI::Option* const format = add_flag(
      app, "--format", "NAME", [&wanted](const std::string& text) { wanted.format = text; }, describe_formats());
  add_flag(
      app, "--for", "ENGINE", [&wanted](const std::string& text) { wanted.engine = text; }, describe_engines())
      ->excludes(format);
}

std::vector<PlannedMesh> plan_meshes(const WantedMeshes& wanted, Outputs& outputs) {
  if ((wanted.format || wanted.engine) && wanted.paths.size() > 1)
    throw InvalidInput(fmt::format("{}: needs exactly one -o; with several the files' names tell the formats",
                                   wanted.engine ? "--for" : "--format"));
  std::vector<PlannedMesh> planned;
  if (wanted.engine) {
    const Engine& engine =
        with_flag("--for", [&]() -> std::reference_wrapper<const Engine> { return find_engine(*wanted.engine); });
    const std::filesystem::path path = wanted.paths.front();
    planned.push_back({path, engine.format, &engine, with_flag("-o", [&] { return engine_files(engine, path); })});
    for (const auto& file : planned.back().files) outputs.add("-o", file);
    return planned;
  }
  std::optional<TetFormat> named;
  if (wanted.format) named = with_flag("--format", [&] { return tet_format_named(*wanted.format); });
  for (const std::string& path : wanted.paths) {
    const TetFormat format = outputs.add_mesh("-o", path, named);
    planned.push_back({path, format, nullptr, tet_files(path, format)});
  }
  return planned;
}

void require_midsides(const PlannedMesh& mesh) {
  if (takes_midsides(mesh.format)) return;
  std::string known;
  for (const TetFormatInfo& info : tet_formats())
    if (takes_midsides(info.format)) known += (known.empty() ? "" : ", ") + info.name;
  throw InvalidInput(fmt::format("--order 2: {} has no place for tets of ten nodes here; formats that have are {}",
                                 mesh.path.string(), known));
}

bool holds_surface(TetFormat format) {
  return format == TetFormat::Usd || format == TetFormat::Npz || format == TetFormat::Json;
}

void write_planned(const PlannedMesh& planned, const TetModel& model, bool material_is_default, MeshRun& run) {
  const auto written = planned.engine ? write_for_engine(*planned.engine, planned.path, model, material_is_default)
                                      : write_tets(planned.path, model, planned.format);
  run.outputs.insert(run.outputs.end(), written.begin(), written.end());
  run.calibrated.push_back(
      {written.front(), planned.engine ? calibration_of(*planned.engine) : calibration_of(planned.format)});
  if (!planned.engine) return;
  run.engine = planned.engine->name;
  run.next_step = engine_usage(*planned.engine, planned.path);
}

}  // namespace tetsoup::cli
