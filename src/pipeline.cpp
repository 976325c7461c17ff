#include "tetsoup/pipeline.h"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>

#include "base/require.h"
#include "tetsoup/tetsoup.h"

namespace tetsoup {
namespace {

class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

std::size_t index_of(Stage stage) {
  return static_cast<std::size_t>(stage);
}

void check_memory(const CleanSoup& soup, const MeshOptions& options) {
  if (!options.memory_limit) return;
  const GridFrame frame = make_grid(soup, options.distance);
  const std::size_t needed = grid_memory(frame), limit = *options.memory_limit;
  if (needed <= limit) return;
  const int longest = std::max({frame.size[0], frame.size[1], frame.size[2]}) - 2 * frame.pad;
  const auto needed_for = [&](int voxels) {
    DistanceOptions smaller = options.distance;
    smaller.voxel_size.reset();
    smaller.voxels = voxels;
    return grid_memory(make_grid(soup, smaller));
  };
  int fits = 1;
  for (int too_many = longest; too_many - fits > 1;) {
    const int middle = (fits + too_many) / 2;
    (needed_for(middle) <= limit ? fits : too_many) = middle;
  }
  char text[256];
  std::snprintf(text, sizeof text, "voxels = %d needs %.2f GB of memory, must be at most %d to fit into %.2f GB",
                longest, static_cast<double>(needed) * 1e-9, fits, static_cast<double>(limit) * 1e-9);
  throw InvalidInput(text);
}

}  // namespace

std::size_t grid_memory(const GridFrame& frame) {
  // Bit-sliced votes of two candidates and a handful of bit grids everywhere; distances and events near the soup, of
  // which as much is expected as the box has surface. Measured on the models; soups that fill their box need more.
  constexpr double kBytesPerVoxel = 2.5, kBytesPerSurfaceVoxel = 120;
  const double x = frame.size[0], y = frame.size[1], z = frame.size[2];
  const double bytes = kBytesPerVoxel * x * y * z + kBytesPerSurfaceVoxel * 2 * (x * y + y * z + z * x);
  constexpr auto kMost = std::numeric_limits<std::size_t>::max();  // less than 4096^3 voxels take, with 32 bits
  return bytes < static_cast<double>(kMost) ? static_cast<std::size_t>(bytes) : kMost;
}

Pipeline::Pipeline(const TriangleSoup& soup, const Progress& progress) {
  const Stopwatch stopwatch;
  soup_ = clean_soup(soup, progress);
  seconds_[index_of(Stage::Soup)] = stopwatch.seconds();
  run_counts_[index_of(Stage::Soup)] = 1;
}

std::size_t Pipeline::run_count(Stage stage) const {
  return run_counts_[index_of(stage)];
}
double Pipeline::seconds(Stage stage) const {
  return seconds_[index_of(stage)];
}

const SmoothResult& Pipeline::run(const MeshOptions& options, const Progress& progress) {
  run_until(Stage::Smooth, options, progress);
  return *smooth_;
}

void Pipeline::run_until(Stage last, const MeshOptions& options, const Progress& progress) {
  const auto timed = [&](Stage stage, const auto& body) {
    const Stopwatch stopwatch;
    body();
    seconds_[index_of(stage)] += stopwatch.seconds();
    ++run_counts_[index_of(stage)];
  };
  // What a changed option invalidates goes first, so that a cancelled run leaves no result that does not match.
  if (!(options.distance == options_.distance)) distance_.reset();
  if (!distance_ || !(options.pseudo_volume == options_.pseudo_volume)) volume_.reset();
  if (!volume_ || !(options.lattice == options_.lattice)) lattice_.reset();
  if (!lattice_ || !(options.smooth == options_.smooth)) smooth_.reset();
  options_ = options;
  const auto restart_clock = [&](Stage stage, bool stands) {
    if (!stands) seconds_[index_of(stage)] = 0;
  };
  restart_clock(Stage::Distance, distance_.has_value());
  restart_clock(Stage::PseudoVolume, volume_.has_value());
  restart_clock(Stage::Lattice, lattice_.has_value());
  restart_clock(Stage::Smooth, smooth_.has_value());

  if (!distance_) {
    if (soup_.report.used_triangles == 0) throw InvalidInput("the soup has no finite triangle");
    check_memory(soup_, options);
    timed(Stage::Distance, [&] { distance_ = unsigned_distance(soup_, options.distance, progress); });
  }
  if (last == Stage::Distance) return;
  if (!volume_) {
    // The automatic choice may ask for a wider band, step by step; a cancelled step leaves no half-chosen volume.
    std::optional<double> band = band_needed_voxels(*distance_, options.pseudo_volume);
    while (band) {
      volume_.reset();
      const Stopwatch stopwatch;
      widen_distance(*distance_, soup_, *band, progress);
      seconds_[index_of(Stage::Distance)] += stopwatch.seconds();
      timed(Stage::PseudoVolume, [&] { volume_ = classify_volume(*distance_, options.pseudo_volume, progress); });
      band = volume_->report.wants_band_voxels;
    }
  }
  if (last == Stage::PseudoVolume) return;
  if (!lattice_) timed(Stage::Lattice, [&] { lattice_ = fill_lattice(*volume_, soup_, options.lattice, progress); });
  if (last == Stage::Lattice) return;
  if (!smooth_) {
    SmoothTarget target;
    target.inside = &volume_->inside;
    if (options.lattice.cover == Cover::Enclose) target.enclosed = soup_.soup.vertices;
    if (options.lattice.cover == Cover::Inside) target.stay = Stay::WithinVolume;
    timed(Stage::Smooth, [&] { smooth_ = smooth_tets(lattice_->mesh, target, options.smooth, progress); });
  }
}

TetMesh mesh_soup(const TriangleSoup& soup, const MeshOptions& options, const Progress& progress) {
  Pipeline pipeline(soup, progress);
  return pipeline.run(options, progress).mesh;
}

}  // namespace tetsoup
