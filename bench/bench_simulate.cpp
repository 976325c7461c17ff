// Scenes played from their first to their last frame, skins moved in each, nothing drawn or written; and tets that only
// bend, without anything to touch.
#include "bench_rows.h"
#include "tetsoup/samples.h"
#include "tetsoup/scene.h"

namespace tetsoup::bench {

namespace {

double count_of(std::size_t count) {
  return static_cast<double>(count);
}

/// One iteration is the whole scene; it begins anew where it was saved.
void play(benchmark::State& state, const Scene& scene) {
  LoadedScene loaded = load_scene(scene);
  const std::vector<std::byte> start = save_scene_state(loaded);
  std::size_t contacts = 0;
  for (auto _ : state) {
    state.PauseTiming();
    restore_scene_state(loaded, start);
    contacts = 0;
    state.ResumeTiming();
    for (std::size_t frame = 0; frame < frame_count(scene); ++frame) {
      advance_frame(loaded);
      deform_surfaces(loaded);
      contacts += loaded.simulation.report().contacts + loaded.simulation.report().touching;
    }
  }
  std::size_t skin = 0;
  for (const LoadedBody& body : loaded.bodies) skin += loaded.assets[body.asset].surface.face_sizes.size();
  state.counters["tets"] = count_of(loaded.simulation.report().tet_count);
  state.counters["skin_faces"] = count_of(skin);
  state.counters["seconds"] = count_of(frame_count(scene)) / scene.fps;
  state.counters["substeps"] =
      count_of(frame_count(scene)) * steps_of_frame(loaded) * loaded.simulation.report().substeps;
  state.counters["contacts"] = count_of(contacts) / count_of(frame_count(scene));
}

void add_scene_row(const std::string& name, const Scene& scene) {
  add_row("play_" + name, [scene](benchmark::State& state) { play(state, scene); });
}

/// A second in space.
void add_bending_row(const std::string& name, std::size_t tets) {
  add_row("bend_" + name, [tets](benchmark::State& state) {
    constexpr int kFrames = 60;
    MeshOptions options;
    options.lattice.tets = tets;
    const TetMesh mesh = mesh_soup(make_sample("robot"), options);
    SimulationOptions free;
    free.gravity = {};
    free.contacts = Contacts::None;
    Simulation simulation(free);
    simulation.add_body(mesh, {}, {.scale = 0.4, .spin = {3, 2, 1}});
    for (auto _ : state)
      for (int frame = 0; frame < kFrames; ++frame) simulation.step(1.0 / kFrames);
    state.counters["tets"] = count_of(simulation.report().tet_count);
    state.counters["seconds"] = 1;
    state.counters["substeps"] = static_cast<double>(kFrames * simulation.report().substeps);
  });
}

}  // namespace

void add_simulation_rows() {
  for (const std::string& name : scene_names()) add_scene_row(name, make_scene(name));
  Scene large = make_scene("drop");
  large.bodies.front().mesh.lattice.tets = 10000;
  add_scene_row("drop_10k", large);
  add_bending_row("3k", 3000);
  add_bending_row("10k", 10000);
  add_bending_row("100k", 100000);
}

}  // namespace tetsoup::bench
