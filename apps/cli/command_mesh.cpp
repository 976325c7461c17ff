// tetsoup mesh: a soup in, a tet mesh out.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "angles.h"
#include "arguments.h"
#include "calibration.h"
#include "commands.h"
#include "files.h"
#include "interrupt.h"
#include "mesh_model.h"
#include "mesh_outputs.h"
#include "mesh_run.h"
#include "options.h"
#include "readiness_page.h"
#include "report_json.h"
#include "soup_input.h"
#include "summary.h"
#include "tetsoup/error.h"
#include "tetsoup/io.h"
#include "tetsoup/label_volume.h"
#include "tetsoup/report.h"

namespace tetsoup::cli {

namespace {

struct MeshCommand {
  std::string input;
  std::optional<double> point_size;
  WantedMeshes meshes;
  ModelOptions model;
  std::optional<std::string> json;
  std::optional<std::string> preview;
  std::optional<std::string> page;
  std::optional<std::string> cavity_surface;
  MeshOptions options;
  TetCount tet_count = TetCount::Given;
  Material material;
  bool material_is_default = true;
  std::optional<double> mass;  ///< kg, instead of a density.
  bool calibrate = false;
  std::optional<double> poisson;  ///< Where it was given.
  RunOptions run;
};

constexpr const char* kExamples =
    "Examples:\n"
    "  tetsoup mesh bunny.ply -o bunny.msh                     about 2,000 tets, everything chosen for you\n"
    "  tetsoup mesh bunny.ply -o bunny.vtk --tets 10000        more and smaller tets\n"
    "  tetsoup mesh bunny.ply -o bunny.msh --lattice bcc --fit  tets all alike, laid where they meet the shape best\n"
    "  tetsoup mesh tree.obj -o tree.msh --band-voxels 2       bridge wider gaps between loose triangles\n"
    "  tetsoup mesh bunny.obj -o bunny --for mujoco            what an engine reads, in metres\n"
    "  tetsoup mesh bunny.obj -o bunny.usda --enclose           the model itself inside the tets, to be moved by them\n"
    "  tetsoup mesh lamp.glb -o lamp --for calculix --regions material --region brass=8500,1e11,0.34 --pin-below y:0\n"
    "  tetsoup mesh part.stl -o part.inp --format inp --metres-per-unit 0.001\n"
    "  tetsoup mesh horse.obj -o horse --for newton --tets 500 --calibrate   so few tets that move like 40,000\n"
    "  tetsoup mesh part.stl -o part.msh --voxels 256 --preview part.png --json part.json\n"
    "\n"
    "Exit codes: 0 done, 1 internal error or out of memory, 2 wrong usage or option, 3 a file cannot be read or\n"
    "written, 4 nothing in the file can be meshed, 130 cancelled.";

void add_embedding(Outputs& outputs, const std::string& path) {
  const std::string extension = lower_extension(path);
  if (extension != ".npz" && extension != ".embedding")
    throw InvalidInput("--embed " + path + ": the name must end in .npz or .embedding");
  outputs.add("--embed", path);
}

void add_cavity_surface(Outputs& outputs, const std::string& path) {
  const std::string extension = lower_extension(path);
  if (extension != ".obj" && extension != ".stl" && extension != ".ply")
    throw InvalidInput("--cavity-surface " + path + ": the name must end in .obj, .stl or .ply");
  outputs.add("--cavity-surface", path);
}

/// Everything about the outputs that can be wrong is found here, before the work starts.
std::vector<PlannedMesh> check_outputs(const MeshCommand& command) {
  Outputs outputs(command.input);
  std::vector<PlannedMesh> planned = plan_meshes(command.meshes, outputs);
  if (command.model.order == Order::Quadratic)
    for (const PlannedMesh& mesh : planned) require_midsides(mesh);
  if (command.model.embed) add_embedding(outputs, *command.model.embed);
  if (command.cavity_surface) add_cavity_surface(outputs, *command.cavity_surface);
  if (command.preview) outputs.add("--preview", *command.preview, ".png");
  if (command.page) outputs.add("--report", *command.page, ".html");
  if (command.json && *command.json != "-") outputs.add("--json", *command.json);
  return planned;
}

void take_stage_times(MeshRun& run) {
  const auto seconds = [&](Stage stage) { return run.pipeline->seconds(stage); };
  run.seconds.soup = seconds(Stage::Soup);
  run.seconds.distance = seconds(Stage::Distance);
  run.seconds.pseudo_volume = seconds(Stage::PseudoVolume);
  run.seconds.lattice = seconds(Stage::Lattice);
  run.seconds.smooth = seconds(Stage::Smooth);
}

/// @param compare  Also measures what the report compares with.
void measure(MeshRun& run, bool compare) {
  const Stopwatch watch;
  run.quality = measure_quality(run.mesh);
  const LatticeMesh& lattice = run.pipeline->lattice();
  const TriangleSoup& soup = run.pipeline->soup().soup;
  run.distance = boundary_distance(run.mesh, soup, lattice.report.mean_edge);
  if (compare) run.raw_distance = boundary_distance(lattice.mesh, soup, lattice.report.mean_edge);
  // Bodies are told by the places of their tets, which regions may have changed.
  run.iou = run.mesh.tets == lattice.mesh.tets
                ? run.pipeline->overlap(run.mesh)
                : intersection_over_union(run.mesh, run.pipeline->pseudo_volume().inside);
  run.fidelity = measure_fidelity(run.mesh, run.pipeline->soup());
  run.readiness = assess_readiness(run.mesh, run.quality, run.fidelity, run.material);
  run.seconds.quality = watch.seconds();
}

/// The input as its file describes it, where something is to be made of that; else empty.
RenderMesh read_surface(const MeshCommand& command, const std::vector<PlannedMesh>& planned) {
  const bool held =
      std::any_of(planned.begin(), planned.end(), [](const PlannedMesh& mesh) { return holds_surface(mesh.format); });
  RenderMesh surface;
  if (wants_surface(command.model, held)) surface = read_input_surface(command.input, command.point_size);
  check_names(command.model, surface);
  return surface;
}

/// What is meshed, and the input as its file describes it, where that is wanted.
struct Shape {
  TriangleSoup soup;
  RenderMesh surface;
};

/// Labelled voxels: what has a label is meshed, and the labels are regions where nothing else is said.
Shape read_voxels(MeshCommand& command) {
  if (command.point_size) throw InvalidInput("--point-size: the input holds voxels, not points");
  const LabelVolume volume = read_label_volume(command.input);
  Shape shape{label_hull(volume), label_surfaces(volume)};
  if (shape.soup.triangles.empty()) throw CannotMesh(command.input + ": no voxel has a label above 0");
  if (!command.model.regions_by) command.model.regions_by = RegionsBy::Object;
  check_names(command.model, shape.surface);
  return shape;
}

Shape read_shape(MeshCommand& command, const std::vector<PlannedMesh>& planned) {
  if (is_label_volume(command.input)) return read_voxels(command);
  Shape shape;
  shape.surface = read_surface(command, planned);
  shape.soup =
      shape.surface.vertices.empty() ? read_input_soup(command.input, command.point_size) : triangles_of(shape.surface);
  return shape;
}

void write_cavities(const std::string& path, MeshRun& run, NewFiles& files) {
  const TetMesh& mesh = run.model.mesh;
  const std::vector<Triangle> triangles = cavity_triangles(mesh);
  if (triangles.empty())
    throw InvalidInput(
        "--cavity-surface: no closed space is left in the mesh; --cavities keep leaves all that the model "
        "has, and more voxels or tets those that are small");
  files.expect(path);
  write_surface(path, mesh.vertices, triangles, mesh.origin);
  run.outputs.push_back(path);
}

void write_meshes(const MeshCommand& command, const std::vector<PlannedMesh>& planned, MeshRun& run, NewFiles& files) {
  const Stopwatch watch;
  for (const PlannedMesh& mesh : planned) {
    throw_if_interrupted();
    files.expect_all(mesh.files);
    write_planned(mesh, run.model, command.material_is_default, run);
  }
  if (command.model.embed) {
    files.expect(*command.model.embed);
    write_embedding(*command.model.embed, run.model.embedding);
    run.outputs.push_back(*command.model.embed);
  }
  if (command.cavity_surface) write_cavities(*command.cavity_surface, run, files);
  run.seconds.write = watch.seconds();
}

void draw_preview(const std::string& path, std::optional<UpAxis> up, MeshRun& run, NewFiles& files) {
  throw_if_interrupted();
  const Stopwatch watch;
  const Pipeline& pipeline = *run.pipeline;
  const SoupReport& soup = pipeline.soup().report;
  const PseudoVolumeReport& volume = pipeline.pseudo_volume().report;
  const std::array<int, 3> size = unpadded_size(pipeline.grid());
  PreviewScene scene;
  scene.soup = &pipeline.soup().soup;
  scene.volume = &pipeline.pseudo_volume();
  scene.lattice = &pipeline.lattice().mesh;
  scene.mesh = &run.mesh;
  scene.up = up;
  scene.title = std::filesystem::path(run.input).filename().string();
  scene.captions = {
      fmt::format("{}, {}", counted(soup.used_triangles, "triangle"), counted(soup.boundary_edges, "open edge")),
      fmt::format("votes, {} x {} x {} voxels, k = {:.4g}", size[0], size[1], size[2], volume.k),
      fmt::format("lattice, {}", counted(pipeline.lattice().report.tet_count, "tet")),
      fmt::format("mesh, {}, angles {:.1f} to {:.1f} degrees", counted(run.quality.tet_count, "tet"),
                  to_degrees(run.quality.min_dihedral), to_degrees(run.quality.max_dihedral))};
  files.expect(path);
  write_preview(path, scene);
  run.outputs.push_back(path);
  run.seconds.preview = watch.seconds();
}

void write_page(const MeshCommand& command, MeshRun& run, NewFiles& files) {
  ReportPage page;
  page.title = std::filesystem::path(run.input).filename().string();
  page.mesh = &run.mesh;
  page.soup = &run.pipeline->soup().soup;
  page.up = std::string(1, "xyz"[static_cast<std::size_t>(run.model.up)]);
  page.metres_per_unit = run.material.metres_per_unit;
  page.json = mesh_report_json(run);
  files.expect(*command.page);
  write_report_page(*command.page, page);
  run.outputs.push_back(*command.page);
}

/// What is to be said of a search for a count of tets, if anything.
std::string mesh_as_asked(const MeshCommand& command, Pipeline& pipeline, ProgressBar& bar) {
  if (command.tet_count == TetCount::Search) return find_tet_count(pipeline, command.options, bar.callback()).note();
  pipeline.run(command.options, bar.callback());
  return {};
}

void calibrate(const TriangleSoup& soup, std::optional<double> poisson, MeshRun& run, ProgressBar& bar) {
  const Stopwatch watch;
  run.calibration = calibrate_model(run.model, soup, run.options, poisson, bar);
  run.readiness.mass = mass_of(run.model);
  // A tet's own bound goes with the root of density over stiffness.
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < run.model.stiffness_scale.size(); ++t)
    least = std::min<double>(least, run.model.density_scale[t] / run.model.stiffness_scale[t]);
  run.readiness.stable_time_step *= std::sqrt(least);
  run.seconds.calibrate = watch.seconds();
}

/// All densities times what gives the body that mass.
void give_mass(double mass, MeshRun& run) {
  const double times = mass / mass_of(run.model);
  for (Region& region : run.model.regions) region.material.density *= times;
  run.material.density *= times;
  run.readiness.mass = mass;
  run.readiness.stable_time_step *= std::sqrt(times);
}

void run_mesh(MeshCommand& command) {
  const Stopwatch watch;
  check_input(command.input);
  const std::vector<PlannedMesh> planned = check_outputs(command);
  ProgressBar bar(command.run.quiet);
  MeshRun run;
  run.input = command.input;
  run.material = command.material;
  bar.show("read");
  const Stopwatch read_watch;
  auto [soup, surface] = read_shape(command, planned);
  run.seconds.read = read_watch.seconds();
  Pipeline pipeline = open_pipeline(command.input, soup, bar);
  command.options.memory_limit = memory_limit(command.run);  // what is left once the soup is in memory
  const std::string count_note = mesh_as_asked(command, pipeline, bar);
  run.options = pipeline.options();
  run.pipeline = &pipeline;
  take_stage_times(run);
  run.model = make_model(run, command.model, std::move(surface), bar);
  run.mesh = run.model.mesh;
  const bool seen = !command.run.quiet || command.json || command.preview || command.page;
  if (seen) {
    bar.show("measure");
    measure(run, command.json.has_value() || command.page.has_value());
  }
  if (command.calibrate) calibrate(soup, command.poisson, run, bar);
  if (command.mass) give_mass(*command.mass, run);
  run.recentred = command.model.recentre;
  if (run.recentred) recentre(run.model);
  bar.show("write");
  NewFiles files;
  write_meshes(command, planned, run, files);
  if (seen) run.notes = notes_of({pipeline, run.quality, run.fidelity, run.engine, run.material.metres_per_unit});
  if (!count_note.empty()) run.notes.push_back(count_note);
  if (command.preview) draw_preview(*command.preview, command.model.up, run, files);
  bar.clear();
  throw_if_interrupted();
  run.seconds.total = watch.seconds();
  if (command.page) write_page(command, run, files);
  if (command.json) {
    if (*command.json != "-") files.expect(*command.json);
    write_report(*command.json, mesh_report_json(run));
  }
  files.keep();
  if (command.run.quiet) return;
  if (command.json && *command.json == "-")
    fmt::print(stderr, "{}", describe_run(run));
  else
    write_stdout(describe_run(run));
}

}  // namespace

void add_mesh_command(CLI::App& app) {
  const auto command = std::make_shared<MeshCommand>();
  CLI::App* const mesh = app.add_subcommand("mesh", "Turn a triangle soup into a tet mesh");
  mesh->group("Commands")->footer(kExamples);
  mesh->add_option("IN", command->input,
                   "Triangles: .obj .stl .ply .off .gltf .glb .3mf .dae, or labelled\nvoxels: .nrrd .nhdr")
      ->required()
      ->option_text(" ");
  add_output_flags(*mesh, command->meshes);
  add_point_flag(*mesh, command->point_size);
  add_grid_flags(*mesh, command->options.distance);
  add_volume_flags(*mesh, command->options.pseudo_volume);
  add_join_flag(*mesh, command->options.join);
  add_lattice_flags(*mesh, command->options.lattice, command->tet_count);
  add_cover_flags(*mesh, command->options.lattice);
  add_topology_flags(*mesh, command->options.lattice.topology);
  add_flag(
      *mesh, "--cavity-surface", "FILE", [command](const std::string& text) { command->cavity_surface = text; },
      "Write the mesh's boundary to closed spaces within it alone, as .obj,\n.stl or .ply: where pressure acts in a "
      "soft robot")
      ->group("Reports");
  add_smooth_flags(*mesh, command->options.smooth);
  add_model_flags(*mesh, command->model);
  add_material_flags(*mesh, command->material);
  add_flag(
      *mesh, "--mass", "KG",
      [command](const std::string& text) { command->mass = parse_number("--mass", text, kPositive); },
      "Mass of the body, instead of a density")
      ->group(kMaterialGroup)
      ->excludes("--density");
  add_calibrate_flag(*mesh, command->calibrate);
  add_flag(
      *mesh, "--json", "FILE|-", [command](const std::string& text) { command->json = text; },
      "Write a report for scripts; - is standard output")
      ->group("Reports");
  add_flag(
      *mesh, "--preview", "FILE", [command](const std::string& text) { command->preview = text; },
      "Draw soup, votes, lattice and mesh into a .png")
      ->group("Reports");
  add_flag(
      *mesh, "--report", "FILE", [command](const std::string& text) { command->page = text; },
      "Write one .html that shows the mesh in 3D, histograms, settings and\ntimes in any browser, offline")
      ->group("Reports");
  add_run_flags(*mesh, command->run);
  mesh->callback([command, mesh] {
    command->material_is_default = true;
    for (const char* flag : {"--density", "--mass", "--young", "--poisson"})
      if (mesh->count(flag) > 0) command->material_is_default = false;
    if (mesh->count("--poisson") > 0) command->poisson = command->material.poisson;
    run_mesh(*command);
  });
}

}  // namespace tetsoup::cli
