#include "tetsoup/pipeline.h"

#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numeric>

#include "base/elementary.h"
#include "base/mesh_voxels.h"
#include "base/parallel.h"
#include "base/require.h"
#include "base/vec.h"
#include "pipeline/unite.h"
#include "tetsoup/tetsoup.h"

namespace tetsoup {
namespace {

constexpr double kMostVoxels = 400;     ///< That a body may ask for along its longest side.
constexpr std::size_t kFewestTets = 5;  ///< Of a lattice: a cube. Bodies that may have fewer are one tet.

class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Three voxels across a sheet, or five where that would be coarse: odd numbers, which a sheet between voxels' centres
/// and one on them meet best, and no more than the grid's padding holds.
double voxel_for_thickness(double thickness, double wanted, const BodySize& size) {
  const double third = thickness / 3;
  return std::max(third > wanted ? thickness / 5 : third, size.longest / kMostVoxels);
}

/// One stage's progress out of that of many steps, each of which may tell of stages of its own.
class Steps {
 public:
  Steps(const Progress& progress, const char* stage, std::size_t count)
      : progress_(progress), stage_(stage), count_(static_cast<double>(std::max<std::size_t>(count, 1))) {}

  /// For the next step; holds as long as this.
  Progress next() {
    const double begin = done_++;
    if (!progress_) return {};
    return [this, begin](std::string_view, double fraction) {
      told_ = std::max(told_, std::min(1.0, (begin + fraction) / count_));
      return progress_(stage_, told_);
    };
  }

 private:
  const Progress& progress_;
  const char* stage_;
  double count_, done_ = 0, told_ = 0;
};

std::size_t index_of(Stage stage) {
  return static_cast<std::size_t>(stage);
}

void check_memory(const CleanSoup& soup, const MeshOptions& options, const DistanceOptions& chosen) {
  if (!options.memory_limit) return;
  const GridFrame frame = make_grid(soup, chosen);
  const std::size_t needed = grid_memory(frame), limit = *options.memory_limit;
  if (needed <= limit) return;
  const int longest = std::max({frame.size[0], frame.size[1], frame.size[2]}) - 2 * frame.pad;
  const auto needed_for = [&](int voxels) {
    DistanceOptions smaller = chosen;
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
  return smooth();
}

/// What a changed option invalidates goes first, so that a cancelled run leaves no result that does not match.
void Pipeline::forget_changed(const MeshOptions& options) {
  const auto shares_budget = [](const MeshOptions& o) { return o.lattice.tets.value_or(0); };
  if (options.join != options_.join || options.distance.box.has_value() != options_.distance.box.has_value())
    split_.reset();
  if (!split_ || !(options.distance == options_.distance) ||
      options.pseudo_volume.thickness != options_.pseudo_volume.thickness) {
    gridded_ = false;
    distance_.reset();
  }
  // Bodies that share a budget have grids that suit their share.
  if (bodies_.size() > 1 && shares_budget(options) != shares_budget(options_)) gridded_ = false;
  if (!gridded_ || !(options.pseudo_volume == options_.pseudo_volume)) volumed_ = false;
  if (!volumed_ || !(options.lattice == options_.lattice)) latticed_ = false;
  if (!latticed_ || !(options.smooth == options_.smooth)) smoothed_ = false;
  options_ = options;
  const auto restart_clock = [&](Stage stage, bool stands) {
    if (!stands) seconds_[index_of(stage)] = 0;
  };
  restart_clock(Stage::Distance, gridded_);
  restart_clock(Stage::PseudoVolume, volumed_);
  restart_clock(Stage::Lattice, latticed_);
  restart_clock(Stage::Smooth, smoothed_);
}

void Pipeline::run_until(Stage last, const MeshOptions& options, const Progress& progress) {
  const auto timed = [&](Stage stage, bool& done, const auto& body) {
    if (done) return;
    const Stopwatch stopwatch;
    body();
    done = true;
    seconds_[index_of(stage)] += stopwatch.seconds();
    ++run_counts_[index_of(stage)];
  };
  forget_changed(options);
  if (soup_.report.used_triangles == 0) throw InvalidInput("the soup has no finite triangle");
  timed(Stage::Distance, gridded_, [&] { choose_grids(progress); });
  if (last <= Stage::PseudoVolume && !distance_) {
    const Stopwatch stopwatch;
    measure_distance(progress);
    seconds_[index_of(Stage::Distance)] += stopwatch.seconds();
  }
  if (last == Stage::Distance) return;
  timed(Stage::PseudoVolume, volumed_, [&] { find_volumes(progress); });
  if (last == Stage::PseudoVolume) return;
  timed(Stage::Lattice, latticed_, [&] { fill_lattices(progress); });
  if (last == Stage::Lattice) return;
  timed(Stage::Smooth, smoothed_, [&] { smooth_all(progress); });
}

void Pipeline::split(const Progress& progress) {
  // One grid over a space that was given holds one body.
  Steps steps(progress, "distance", 2);
  Bodies found = split_bodies(soup_, options_.distance.box ? Join::Near : options_.join, steps.next());
  soup_.parts.around = found.around;
  sizes_ = measure_bodies(soup_, found, steps.next());
  split_ = std::move(found);
}

void Pipeline::choose_grids(const Progress& progress) {
  if (!split_) split(progress);
  const std::size_t count = split_->triangles.size();
  whole_ = count == 1 && split_->specks.empty();
  const DistanceOptions& asked = options_.distance;
  const bool fixed = asked.voxels || asked.voxel_size || asked.box;
  const std::vector<std::size_t> shares = share_tets(sizes_, options_.lattice.tets.value_or(kDefaultTets));
  bodies_ = std::vector<Body>(count);
  for (std::size_t b = 0; b < count; ++b) {
    Body& body = bodies_[b];
    body.size = sizes_[b];
    if (!whole_) body.own_soup = subset_of(soup_, split_->triangles[b]);
    (whole_ ? soup_ : body.own_soup).parts.near = split_->near[b];
    body.distance = asked;
    if (!fixed && body.size.longest > 0) {
      const double wanted = wanted_voxel_size(body.size, shares[b], count == 1);
      const std::optional<double>& thickness = options_.pseudo_volume.thickness;
      body.distance.voxel_size =
          thickness && body.size.rims ? voxel_for_thickness(*thickness, wanted, body.size) : wanted;
    }
    if (asked.voxels && count > 1) {
      body.distance.voxels.reset();
      body.distance.voxel_size = make_grid(soup_, asked).voxel_size;
    }
    check_memory(soup_of(body), options_, body.distance);
    body.grid = make_grid(soup_of(body), body.distance);
  }
  grid_ = count == 1 ? bodies_[0].grid : make_grid(soup_, asked);
}

void Pipeline::find_volumes(const Progress& progress) {
  volume_.reset();
  Steps steps(progress, "pseudo_volume", bodies_.size());
  for (Body& body : bodies_) {
    body.volume.reset();
    body.volume = find_volume(soup_of(body), body.grid, options_.pseudo_volume, steps.next());
  }
  if (bodies_.size() == 1) return;
  std::vector<const PseudoVolume*> volumes;
  for (const Body& body : bodies_) volumes.push_back(&*body.volume);
  volume_ = united_volume(volumes, grid_);
}

/// The lattice of one body; one that may have a single tet gets a regular one of its own volume.
LatticeMesh Pipeline::lattice_of(Body& body, std::size_t tets, const Progress& progress) {
  LatticeOptions own = options_.lattice;
  if (options_.join == Join::All) own.separate = Separate::Together;
  // What was left hollow stays so.
  if (options_.pseudo_volume.cavities == Cavities::Keep || !body.volume->report.cavities.empty())
    own.topology.bubbles = Bubbles::Keep;
  if (bodies_.size() == 1) return fill_lattice(*body.volume, soup_of(body), own, progress);
  if (own.cells) {
    const Vec3d sides = soup_.report.box.hi - soup_.report.box.lo;
    own.cell_size = std::max({sides.x, sides.y, sides.z}) / *own.cells;
    own.cells.reset();
  }
  if (own.edge || own.cell_size) return fill_lattice(*body.volume, soup_of(body), own, progress);
  if (own.vertices) {
    own.vertices = std::max<std::size_t>(4, tets);
  } else if (tets < kFewestTets) {
    LatticeMesh single = single_tet(body.own_soup.report.box, body.size.volume);
    single.mesh.origin = soup_.soup.origin;
    return single;
  } else {
    own.tets = tets;
  }
  return fill_lattice(*body.volume, soup_of(body), own, progress);
}

void Pipeline::fill_lattices(const Progress& progress) {
  const LatticeOptions& asked = options_.lattice;
  lattice_.reset();
  Steps steps(progress, "lattice", bodies_.size());
  if (bodies_.size() == 1) {
    bodies_[0].lattice = lattice_of(bodies_[0], 0, steps.next());
    return;
  }
  // From the smallest to the largest, which takes what the others missed.
  const std::size_t wanted = asked.vertices ? *asked.vertices : asked.tets.value_or(kDefaultTets);
  const std::vector<std::size_t> shares = share_tets(sizes_, wanted);
  std::vector<std::size_t> order(bodies_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return shares[a] < shares[b]; });
  std::ptrdiff_t over = 0;
  for (const std::size_t b : order) {
    bodies_[b].lattice.reset();
    if (shares[b] == 0) continue;
    const auto share = static_cast<std::ptrdiff_t>(shares[b]);
    const auto own = b == order.back() ? std::max<std::ptrdiff_t>(1, share - over) : share;
    bodies_[b].lattice = lattice_of(bodies_[b], static_cast<std::size_t>(own), steps.next());
    const TetMesh& mesh = bodies_[b].lattice->mesh;
    over += static_cast<std::ptrdiff_t>(asked.vertices ? mesh.vertices.size() : mesh.tets.size()) - own;
  }
  std::vector<const LatticeMesh*> lattices;
  for (const Body& body : bodies_)
    if (body.lattice) lattices.push_back(&*body.lattice);
  lattice_ = united_lattice(lattices);
}

void Pipeline::smooth_all(const Progress& progress) {
  smooth_.reset();
  Steps steps(progress, "smooth", bodies_.size());
  std::vector<const SmoothResult*> results;
  for (Body& body : bodies_) {
    body.smooth.reset();
    if (!body.lattice) continue;
    SmoothTarget target;
    target.inside = &body.volume->inside;
    target.volume = body.volume->report.bounded_volume;
    if (options_.lattice.cover == Cover::Enclose) target.enclosed = soup_of(body).soup.vertices;
    if (options_.lattice.cover == Cover::Inside)
      target.stay = Stay::WithinVolume;
    else
      target.soup = &soup_of(body).soup;
    body.smooth = smooth_tets(body.lattice->mesh, target, options_.smooth, steps.next());
    results.push_back(&*body.smooth);
  }
  if (bodies_.size() > 1) smooth_ = united_smooth(results);
}

std::vector<std::string> Pipeline::body_notes() const {
  std::vector<std::string> notes;
  const auto text = [](const char* format, auto... values) {
    std::array<char, 400> line{};
    std::snprintf(line.data(), line.size(), format, values...);
    return std::string(line.data());
  };
  const std::size_t count = bodies_.size();
  if (count > 1)
    notes.push_back(
        text("The model is %zu bodies that do not touch, each with a grid and a lattice of its own: --join "
             "near puts them on one grid, --join all glues what shares a cell.",
             count));
  if (!split_->specks.empty())
    notes.push_back(
        text("%zu triangles far too small to be a body beside the others were left out, the first near "
             "(%.6g, %.6g, %.6g).",
             split_->specks.size(), place_of(split_->specks.front()).x, place_of(split_->specks.front()).y,
             place_of(split_->specks.front()).z));
  std::size_t single = 0, lost = 0;
  for (const Body& body : bodies_) {
    single += body.lattice && count > 1 && body.lattice->mesh.tets.size() == 1;
    lost += !body.lattice;
  }
  if (single + lost > 0 && latticed_)
    notes.push_back(
        text("There are too few tets for so many bodies: %zu are a single tet each, %zu are lost. --tets %zu "
             "gives each a dozen.",
             single, lost, count * 12));
  note_thin_walls(notes);
  return notes;
}

/// Walls and gaps that a voxel of the grid cannot tell.
void Pipeline::note_thin_walls(std::vector<std::string>& notes) const {
  for (const Body& body : bodies_) {
    for (const auto& [what, width] : {std::pair{"wall", body.size.wall}, std::pair{"gap", body.size.gap}}) {
      if (!width || *width >= body.grid.voxel_size) continue;
      std::array<char, 300> line{};
      std::snprintf(line.data(), line.size(),
                    "The thinnest %s is %.4g wide, %.2g of a voxel: --voxels %d shows it (it costs time and memory).",
                    what, *width, *width / body.grid.voxel_size,
                    static_cast<int>(std::min(4096.0, std::ceil(1.7 * body.size.longest / *width))));
      notes.emplace_back(line.data());
      return;
    }
  }
}

Vec3d Pipeline::place_of(std::uint32_t triangle) const {
  return soup_.soup.origin + to_double(soup_.soup.vertices[soup_.soup.triangles[triangle][0]]);
}

void Pipeline::measure_distance(const Progress& progress) const {
  const DistanceOptions& asked = options_.distance;
  const double band = asked.mode == DistanceMode::Full ? std::numeric_limits<double>::infinity() : asked.band_voxels;
  distance_ = unsigned_distance(soup_, grid_, band, progress);
}

const DistanceField& Pipeline::distance() const {
  if (!distance_) measure_distance({});
  return *distance_;
}
const PseudoVolume& Pipeline::pseudo_volume() const {
  return bodies_.size() == 1 ? *bodies_[0].volume : *volume_;
}
const LatticeMesh& Pipeline::lattice() const {
  return bodies_.size() == 1 ? *bodies_[0].lattice : *lattice_;
}
const SmoothResult& Pipeline::smooth() const {
  return bodies_.size() == 1 ? *bodies_[0].smooth : *smooth_;
}

double Pipeline::overlap(const TetMesh& mesh) const {
  if (bodies_.size() == 1) return intersection_over_union(mesh, bodies_[0].volume->inside);
  const Progress nobody;
  StageWatch watch(nobody, "quality");
  double shared = 0, either = 0;
  MeshPlace place;
  for (const Body& body : bodies_) {
    TetMesh own;
    if (body.lattice) own = take_mesh(mesh, body.lattice->mesh, place);
    const MeshVoxels voxels = count_mesh_voxels(own, body.volume->inside, watch);
    const double voxel = elementary::cube(body.grid.voxel_size);
    shared += voxel * static_cast<double>(voxels.in_both);
    either += voxel * static_cast<double>(voxels.in_mesh + body.volume->report.inside_voxels - voxels.in_both);
  }
  return either > 0 ? shared / either : 1;
}

TetMesh mesh_soup(const TriangleSoup& soup, const MeshOptions& options, const Progress& progress) {
  Pipeline pipeline(soup, progress);
  return pipeline.run(options, progress).mesh;
}

}  // namespace tetsoup
