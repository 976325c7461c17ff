// Slider steps: a program with sliders holds a Pipeline, one option changes, and a new smoothed mesh is wanted.
#include <functional>

#include "bench_rows.h"

namespace tetsoup::bench {

namespace {

using Change = std::function<void(const Prepared&, MeshOptions&)>;

// Goes to and fro between the prepared options and changed ones; both have been seen before the clock starts, so that
// the distance is known as far as either needs it.
void step_slider(benchmark::State& state, int voxels, const Change& change) {
  Prepared& ready = prepared(SoupName::Input, voxels);
  Pipeline& pipeline = ready.pipeline;
  MeshOptions changed = ready.options;
  change(ready, changed);
  pipeline.run(changed);
  pipeline.run(ready.options);
  const std::size_t distances = pipeline.run_count(Stage::Distance);
  bool forth = true;
  for (auto _ : state) {
    pipeline.run(forth ? changed : ready.options);
    forth = !forth;
  }
  if (pipeline.run_count(Stage::Distance) != distances) state.SkipWithError("the distance was computed again");
  pipeline.run(ready.options);
  state.counters["tets"] = static_cast<double>(pipeline.smooth().mesh.tets.size());
}

void add_slider_row(const std::string& slider, int voxels, const Change& change) {
  add_row(row_name("slider_" + slider, {.voxels = voxels}),
          [voxels, change](benchmark::State& state) { step_slider(state, voxels, change); });
}

}  // namespace

void add_slider_rows(int voxels) {
  // From the automatic threshold to one whose band is half as wide again.
  add_slider_row("k", voxels, [](const Prepared& ready, MeshOptions& options) {
    options.pseudo_volume.k = 1 - 1.5 * (1 - ready.pipeline.pseudo_volume().report.k);
  });
  add_slider_row("rho_min", voxels, [](const Prepared&, MeshOptions& options) { options.lattice.rho_min = 0.4; });
  add_slider_row("translate", voxels, [](const Prepared&, MeshOptions& options) {
    options.lattice.translate_cells = {0.3F, 0.2F, 0.1F};
  });
  add_slider_row("cell_size", voxels, [](const Prepared& ready, MeshOptions& options) {
    options.lattice.cell_size = ready.pipeline.lattice().report.cell_size * 0.97;
  });
  add_slider_row("smoothing", voxels, [](const Prepared&, MeshOptions& options) { options.smooth.strength = 0.8; });
}

}  // namespace tetsoup::bench
