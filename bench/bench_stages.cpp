#include <functional>
#include <thread>

#include "bench_rows.h"

namespace tetsoup::bench {

namespace {

constexpr double kBandVoxels = 3;       // of the distance: what signs with one threshold need, rounded up
constexpr double kEventBandVoxels = 1;  // of the signs with one threshold

// While it lives, all stages use this many threads.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads) { set_thread_count(threads); }
  ~ThreadLimit() { set_thread_count(0); }
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;
};

double count_of(std::size_t count) {
  return static_cast<double>(count);
}

void add_distance_row(const char* what, const Case& which, DistanceMode mode) {
  add_row(row_name(what, which), [which, mode](benchmark::State& state) {
    const CleanSoup& soup = clean_soup_of(which.soup);
    DistanceOptions options;
    options.voxels = which.voxels;
    options.band_voxels = kBandVoxels;
    options.mode = mode;
    const ThreadLimit limit(which.threads);
    double d_max = 0;
    for (auto _ : state) d_max = unsigned_distance(soup, options).d_max;
    state.counters["voxels"] = count_of(make_grid(soup, options).voxel_count());
    state.counters["d_max"] = d_max;
  });
}

void add_signs_row(const char* what, const Case& which, const PseudoVolumeOptions& options) {
  add_row(row_name(what, which), [which, options](benchmark::State& state) {
    const Prepared& ready = prepared(which.soup, which.voxels);
    const ThreadLimit limit(which.threads);
    PseudoVolumeReport report;
    for (auto _ : state) report = classify_volume(ready.pipeline.distance(), options).report;
    state.counters["voxels"] = count_of(make_grid(ready.pipeline.soup(), ready.options.distance).voxel_count());
    state.counters["inside_voxels"] = count_of(report.inside_voxels);
    state.counters["band_voxels"] = report.band_voxels;
  });
}

void add_signs_rows(const Case& which) {
  PseudoVolumeOptions one_k;
  one_k.band_voxels = kEventBandVoxels;
  add_signs_row("signs_one_k", which, one_k);
  add_signs_row("signs_auto", which, {});
}

}  // namespace

std::string row_name(const std::string& what, const Case& which) {
  std::string name = what;
  if (which.voxels > 0) name += "/" + std::to_string(which.voxels);
  if (which.soup != SoupName::Input) name += "/soup:" + text_of(which.soup);
  if (which.threads > 0) name += "/threads:" + std::to_string(which.threads);
  return name;
}

void add_full_distance_row(const Case& which) {
  add_distance_row("distance_full", which, DistanceMode::Full);
}

void add_thread_rows(const Case& which) {
  const int cores = thread_count();
  for (const int threads : {1, 2, 4 * cores}) {
    Case limited = which;
    limited.threads = threads;
    add_distance_row("distance_band", limited, DistanceMode::Band);
    add_signs_rows(limited);
  }
}

void add_stage_rows(const Case& which) {
  add_distance_row("distance_band", which, DistanceMode::Band);
  add_signs_rows(which);
  const auto add_lattice_row = [&](const std::string& what, const std::function<void(LatticeOptions&)>& change) {
    add_row(row_name(what, which), [which, change](benchmark::State& state) {
      const Prepared& ready = prepared(which.soup, which.voxels);
      LatticeOptions options = ready.options.lattice;
      change(options);
      LatticeReport report;
      for (auto _ : state) report = fill_lattice(ready.pipeline.pseudo_volume(), ready.pipeline.soup(), options).report;
      state.counters["tets"] = count_of(report.tet_count);
    });
  };
  add_lattice_row("lattice", [](LatticeOptions& options) {
    options.stairs = Stairs::Leave;
    options.thin = Thin::Drop;
    options.separate = Separate::Together;
    options.topology = {Touching::Leave, 0, Bubbles::Keep, BoundaryOnly::Leave};
  });
  add_lattice_row("lattice_mended", [](LatticeOptions&) {});
  add_row(row_name("smooth", which), [which](benchmark::State& state) {
    const Prepared& ready = prepared(which.soup, which.voxels);
    const TetMesh& mesh = ready.pipeline.lattice().mesh;
    const SmoothTarget target{.inside = &ready.pipeline.pseudo_volume().inside, .soup = &ready.pipeline.soup().soup};
    for (auto _ : state) benchmark::DoNotOptimize(smooth_tets(mesh, target).report.volume_after);
    state.counters["tets"] = count_of(mesh.tets.size());
  });
}

}  // namespace tetsoup::bench
