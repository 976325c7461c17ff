#include "simulate_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "summary.h"
#include "tetsoup/progress.h"

namespace tetsoup::cli {

namespace {

using Json = nlohmann::ordered_json;

/// Vertices of all tets, faces and vertices of all surfaces.
struct Sizes {
  std::size_t vertices = 0, triangles = 0, points = 0;
};

Sizes sizes_of(const LoadedScene& loaded) {
  Sizes sizes;
  for (const LoadedBody& body : loaded.bodies) {
    const SceneAsset& asset = loaded.assets[body.asset];
    sizes.vertices += asset.mesh.vertices.size();
    sizes.points += asset.surface.vertices.size();
    sizes.triangles += asset.surface.corners.size() - 2 * asset.surface.face_sizes.size();
  }
  return sizes;
}

const char* solver_name(Solver solver) {
  return solver == Solver::Implicit ? "implicit" : "potentials";
}

/// Substeps of a frame: those of its steps.
int substeps_of(const LoadedScene& loaded) {
  return loaded.simulation.report().substeps * steps_of_frame(loaded);
}

double ns_per_tet_substep(const SimulateRun& run, const LoadedScene& loaded) {
  const double steps = static_cast<double>(run.frames - run.resumed_after) * substeps_of(loaded);
  const double tets = static_cast<double>(loaded.simulation.report().tet_count);
  constexpr double kNanoseconds = 1e9;  // a second
  return steps * tets > 0 ? run.seconds.simulate / (steps * tets) * kNanoseconds : 0;
}

Json seconds_json(const SimulateTimings& seconds) {
  return {{"load", seconds.load},
          {"simulate", seconds.simulate},
          {"embed", seconds.embed},
          {"write", seconds.write},
          {"total", seconds.total}};
}

Json energy_json(const Energy& energy) {
  return {
      {"kinetic", energy.kinetic}, {"elastic", energy.elastic}, {"gravity", energy.gravity}, {"total", energy.total()}};
}

}  // namespace

std::string describe_simulation(const SimulateRun& run, const LoadedScene& loaded) {
  const SimulationReport& report = loaded.simulation.report();
  const Sizes sizes = sizes_of(loaded);
  std::string text =
      fmt::format("{}: {}, {}", run.input, counted(loaded.bodies.size(), "bodie"), counted(report.tet_count, "tet"));
  if (loaded.bodies.size() == 1) text = fmt::format("{}: 1 body, {}", run.input, counted(report.tet_count, "tet"));
  if (sizes.triangles > 0) text += fmt::format(", {} on them", counted(sizes.triangles, "triangle"));
  text += "\n";
  if (report.left_out > 0)
    text += fmt::format("Note: {} without volume left out of the simulation\n", counted(report.left_out, "tet"));
  if (report.clamped > 0)
    text += fmt::format("Note: {} held back from moving unreasonably far; more substeps help\n",
                        counted(report.clamped, "vertice"));
  text += fmt::format("Frames: {} of 1/{:g} s, {} substeps each, solver {}\n", grouped(run.frames), loaded.scene.fps,
                      substeps_of(loaded), solver_name(loaded.scene.simulation.solver));
  text += fmt::format("Contacts: at most {} between bodies, {} with obstacles\n", grouped(run.most_contacts),
                      grouped(run.most_touching));
  text += fmt::format("Time: {:.2f} s (load {:.2f}, simulate {:.2f}, surfaces {:.2f}, write {:.2f})\n",
                      run.seconds.total, run.seconds.load, run.seconds.simulate, run.seconds.embed, run.seconds.write);
  text += fmt::format("Real time: {:.2f} times (simulating and surfaces, without loading and writing)\n",
                      run.real_time_factor(loaded.scene.fps));
  text += fmt::format("State: {}\n", hash_words(run.state_hash));
  for (const auto& path : run.outputs) text += fmt::format("Wrote {}\n", path.string());
  return text;
}

std::string simulation_json(const SimulateRun& run, const LoadedScene& loaded) {
  const SimulationReport& report = loaded.simulation.report();
  const Sizes sizes = sizes_of(loaded);
  Json outputs = Json::array();
  for (const auto& path : run.outputs) outputs.push_back(path.string());
  const Json json{{"tet_count", report.tet_count},
                  {"frames", run.frames},
                  {"real_time_factor", run.real_time_factor(loaded.scene.fps)},
                  {"state_hash", hash_words(run.state_hash)},
                  {"simulated_seconds", loaded.simulation.time()},
                  {"resumed_after", run.resumed_after},
                  {"fps", loaded.scene.fps},
                  {"substeps", substeps_of(loaded)},
                  {"solver", solver_name(loaded.scene.simulation.solver)},
                  {"body_count", loaded.bodies.size()},
                  {"make_count", loaded.assets.size()},
                  {"parts", report.parts},
                  {"vertex_count", sizes.vertices},
                  {"surface_triangles", sizes.triangles},
                  {"surface_vertices", sizes.points},
                  {"contacts",
                   {{"between", report.contacts},
                    {"obstacles", report.touching},
                    {"most_between", run.most_contacts},
                    {"most_obstacles", run.most_touching}}},
                  {"left_out", report.left_out},
                  {"loose_vertices", report.loose_vertices},
                  {"clamped", report.clamped},
                  {"energy", energy_json(loaded.simulation.energy())},
                  {"ns_per_tet_substep", ns_per_tet_substep(run, loaded)},
                  {"seconds", seconds_json(run.seconds)},
                  {"threads", thread_count()},
                  {"version", TETSOUP_VERSION},
                  {"input", run.input},
                  {"title", loaded.scene.title},
                  {"outputs", outputs}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace tetsoup::cli
