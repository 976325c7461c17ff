#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "base/elementary.h"
#include "base/require.h"
#include "base/tet_geometry.h"
#include "lattice/budget.h"
#include "lattice/filler.h"
#include "lattice/fit.h"
#include "lattice/flat_sides.h"

namespace tetsoup {
namespace {

constexpr int kMaxCells = 1024;
constexpr std::size_t kMostWanted = std::size_t{1} << 27;
constexpr double kVolumeMiss = 0.03;  ///< Relative; a lattice that keeps the volume this well is left as it is.

void check_size_options(const LatticeOptions& o) {
  const std::array<std::pair<const char*, bool>, 5> sizes{{{"tets", o.tets.has_value()},
                                                           {"vertices", o.vertices.has_value()},
                                                           {"edge", o.edge.has_value()},
                                                           {"cells", o.cells.has_value()},
                                                           {"cell_size", o.cell_size.has_value()}}};
  const char* given = nullptr;
  for (const auto& [name, is_given] : sizes) {
    if (is_given && given != nullptr) throw InvalidInput(std::string("give ") + given + " or " + name + ", not both");
    if (is_given) given = name;
  }
  const auto is_count = [](const std::optional<std::size_t>& n) { return !n || (*n >= 1 && *n <= kMostWanted); };
  require(is_count(o.tets), "tets", o.tets.value_or(0), "1 to 2^27");
  require(is_count(o.vertices), "vertices", o.vertices.value_or(0), "1 to 2^27");
  const auto is_length = [](const std::optional<double>& l) { return !l || (*l > 0 && std::isfinite(*l)); };
  require(is_length(o.edge), "edge", o.edge.value_or(0), "positive and finite");
  require(!o.cells || (*o.cells >= 1 && *o.cells <= kMaxCells), "cells", o.cells.value_or(0), "1 to 1024");
  require(is_length(o.cell_size), "cell_size", o.cell_size.value_or(0), "positive and finite");
}

void check_options(const LatticeOptions& o) {
  check_size_options(o);
  require(o.rho_min > 0 && o.rho_min <= 1, "rho_min", o.rho_min, "above 0 and at most 1");
  const auto is_bounded = [](const Vec3d& v) {
    constexpr double kLimit = 1e6;  // whole cells or turns beyond that only lose digits
    return std::abs(v.x) <= kLimit && std::abs(v.y) <= kLimit && std::abs(v.z) <= kLimit;
  };
  require(is_bounded(o.translate_cells), "translate_cells", o.translate_cells.x, "finite, at most 1e6");
  require(is_bounded(o.rotate), "rotate", o.rotate.x, "finite, at most 1e6");
}

/// The count to meet; none if the size of the cells is given.
std::optional<Budget> budget_of(const LatticeOptions& o) {
  if (o.edge || o.cells || o.cell_size) return {};
  if (o.vertices) return Budget{Budget::Counts::Vertices, *o.vertices};
  return Budget{Budget::Counts::Tets, o.tets.value_or(kDefaultTets)};
}

/// Edge of a cell as given. That of a whole number of cells is raised where single precision cannot hold so fine a
/// lattice, as the voxels' edge is.
double given_cell_size(const LatticeOptions& o, const Filler& filler, const GridFrame& grid) {
  if (o.cells) return std::max(filler.longest_edge() / *o.cells, finest_cell_size(grid));
  return o.edge ? *o.edge / filler.table().mean_edge : *o.cell_size;
}

double volume_of(const TetMesh& mesh) {
  double sum = 0;
  for (const Tet& t : mesh.tets) sum += signed_volume(corners_of(mesh, t));
  return sum;
}

/// The same budget with the next whole number of cells along the longest axis, so that the lattice ends where the box
/// does, if that meets both the budget and, much better, the volume: a block is then met exactly.
Fill with_whole_cells(Fill fill, Filler& filler, const Budget& budget, double volume) {
  const auto volume_miss = [&](const Fill& f) { return std::abs(volume_of(kept_mesh(f.candidates)) / volume - 1); };
  if (fill.by_soup) return fill;
  const double miss = volume_miss(fill);
  if (miss < kVolumeMiss) return fill;
  const double longest = filler.longest_edge(), cells = longest / fill.pose.cell_size;
  for (const double whole : {std::round(cells), std::round(cells) > cells ? std::floor(cells) : std::ceil(cells)}) {
    if (whole < 1 || longest / whole < filler.smallest_cell() || filler.fills() >= kMostFills) continue;
    LatticePose pose = fill.pose;
    pose.cell_size = longest / whole;
    Fill other = filler.fill(pose);
    if (!other.by_soup && budget.miss(other) <= budget.tolerance() && volume_miss(other) < miss / 2) return other;
  }
  return fill;
}

Fill fill_to_budget(Filler& filler, const Budget& budget, LatticePose pose, const PseudoVolume& volume) {
  // A sheet has no volume to divide; a sixteenth of the box is where the search starts.
  constexpr double kOfLongest = 16;
  pose.cell_size = filler.has_volume() ? expected_cell(filler.table(), budget, volume.report.volume)
                                       : filler.longest_edge() / kOfLongest;
  return with_whole_cells(search_budget(filler, budget, pose, FineTuning::Frame, kMostFills), filler, budget,
                          volume.report.volume);
}

/// A soup with flat sides, in cells that end at them: then these sides are flat from the start, and no count jumps by
/// a layer. None where there are no such sides, or where no such lattice tried meets the budget.
std::optional<Fill> fill_between_sides(Filler& filler, const Budget& budget, const CleanSoup& soup, double volume,
                                       StageWatch& watch) {
  constexpr int kMostTries = 4;
  constexpr double kLeastOverlap = 0.4;  // Where walls are far thinner than tets it matters more how they are covered.
  constexpr double kOfMiss = 0.005;      // The whole tolerance, beside planes that lie within cells.
  const double cell = expected_cell(filler.table(), budget, volume);
  const std::optional<FlatSides> sides = find_flat_sides(soup.soup, filler.table().mean_edge * cell, watch);
  if (!sides) return {};
  const Box3 box = grid_box(filler.grid());
  const std::vector<AlignedPlace> places = aligned_places(*sides, cell, (box.lo + box.hi) * 0.5);
  std::vector<bool> tried(places.size());
  double cells_wanted = volume / elementary::cube(cell);  // corrected by every try
  for (int i = 0; i < kMostTries; ++i) {
    const AlignedPlace* best = nullptr;
    double least = 0;
    for (std::size_t p = 0; p < places.size(); ++p) {
      const double miss = std::abs(volume / places[p].volume / cells_wanted - 1) / budget.tolerance();
      const double unfit = places[p].unfit + kOfMiss * miss * miss;
      if (tried[p] || miss > 1 || (best != nullptr && unfit >= least)) continue;
      best = &places[p], least = unfit;
    }
    if (best == nullptr || best->place.cell_size < filler.smallest_cell()) return {};
    tried[static_cast<std::size_t>(best - places.data())] = true;
    Fill fill = filler.fill(pose_of(best->place, filler.grid()), Filler::Cells::WholeWhereFlat);
    if (fill.by_soup) return {};
    if (budget.miss(fill) <= budget.tolerance()) {
      if (!best->is_layer && filler.shares(kept_mesh(fill.candidates)).overlap() < kLeastOverlap) return {};
      return fill;
    }
    cells_wanted = volume / best->volume * static_cast<double>(budget.wanted) / static_cast<double>(budget.count(fill));
  }
  return {};
}

/// The best of what the search for a fit finds, as far as it meets the budget; `first` if that is no better.
Fill fitted(Fill first, Filler& filler, const std::optional<Budget>& budget, const LatticeOptions& options,
            const PseudoVolume& volume, StageWatch& watch) {
  constexpr std::size_t kMostPlaces = 4;
  constexpr int kMostFillsEach = 3;
  FitSearch search{volume.inside, filler.table(), options.rho_min, FitSearch::Edge::Given,
                   static_cast<double>(first.dense_tets)};
  if (budget) {
    search.edge = FitSearch::Edge::Searched;
    search.tets *= static_cast<double>(budget->wanted) / static_cast<double>(budget->count(first));
  }
  const std::vector<Place> places = search_fit(search, place_of(first.pose, filler.grid()), kMostPlaces, watch);
  double best = filler.shares(kept_mesh(first.candidates)).overlap();
  const auto misses = [&](const Fill& fill) { return budget && budget->miss(fill) > budget->tolerance(); };
  for (const Place& place : places) {
    const LatticePose pose = pose_of(place, filler.grid());
    Fill other = budget ? search_budget(filler, *budget, pose, FineTuning::None, kMostFillsEach) : filler.fill(pose);
    const double overlap = filler.shares(kept_mesh(other.candidates)).overlap();
    if (other.by_soup || misses(other) || (overlap <= best && !misses(first))) continue;
    best = overlap;
    first = std::move(other);
  }
  return first;
}

/// Cells with a tet of the mesh: the tets of one lie next to each other but for those that were added last.
std::size_t count_used_cells(const TetMesh& mesh, const LatticeFrame& frame) {
  std::vector<Cell> cells;
  for (const Tet& tet : mesh.tets) {
    Vec3d lo = frame.to_cell(to_double(mesh.vertices[tet[0]]));
    for (const std::uint32_t v : tet) lo = min(lo, frame.to_cell(to_double(mesh.vertices[v])));
    constexpr double kInto = 0.25;  // a tet starts at the lower side of its cell or, in bcc, at its middle
    const auto whole = [](double x) { return static_cast<int>(std::floor(x + kInto)); };
    const Cell cell{whole(lo.x), whole(lo.y), whole(lo.z)};
    if (cells.empty() || cells.back() != cell) cells.push_back(cell);
  }
  std::sort(cells.begin(), cells.end());
  return static_cast<std::size_t>(std::unique(cells.begin(), cells.end()) - cells.begin());
}

LatticeMesh finished(const Fill& fill, const Filler& filler, const PseudoVolume& volume, int fills) {
  LatticeMesh result;
  result.mesh = kept_mesh(fill.candidates);
  result.mesh.origin = volume.inside.frame.soup_origin;
  TETSOUP_ASSERT(!result.mesh.tets.empty());  // a finite triangle always touches a tet
  LatticeReport& report = result.report;
  report = fill.mended;
  report.cells = fill.frame.count;
  report.cell_size = fill.frame.cell_size;
  report.mean_edge = filler.table().mean_edge * fill.frame.cell_size;
  report.used_cells = count_used_cells(result.mesh, fill.frame);
  report.tet_count = result.mesh.tets.size();
  report.sampled_tets = fill.sampled_tets;
  report.kept_volume = volume_of(result.mesh);
  report.pseudo_volume = volume.report.volume;
  report.kept_by_soup = fill.by_soup;
  report.fills = fills;
  report.translate_cells = fill.pose.translate_cells;
  report.rotate = fill.pose.rotate;
  report.stretch = fill.pose.stretch;
  const Shares shares = filler.shares(result.mesh);
  report.overlap = shares.overlap();
  report.excess_volume = shares.only_mesh;
  report.lacking_volume = shares.only_volume;
  return result;
}

}  // namespace

LatticeMesh fill_lattice(const PseudoVolume& volume, const CleanSoup& soup, const LatticeOptions& options,
                         const Progress& progress) {
  check_options(options);
  if (soup.report.used_triangles == 0) throw InvalidInput("the soup has no finite triangle");
  StageWatch watch(progress, "lattice");
  Filler filler(volume, soup, options, watch);
  LatticePose pose{0, options.translate_cells, options.rotate};
  const std::optional<Budget> budget = budget_of(options);
  if (!budget) pose.cell_size = given_cell_size(options, filler, volume.inside.frame);
  std::optional<Fill> aligned;
  const bool is_free = options.fit == Fit::Off && pose.translate_cells == Vec3d{} && pose.rotate == Vec3d{};
  if (budget && is_free && filler.has_volume() && options.cover == Cover::Density &&
      filler.table().reach == kStepsPerCell)  // cells with faces
    aligned = fill_between_sides(filler, *budget, soup, volume.report.volume, watch);
  Fill fill = aligned  ? std::move(*aligned)
              : budget ? fill_to_budget(filler, *budget, pose, volume)
                       : filler.fill(pose);
  const int fills = filler.fills();
  if (options.fit == Fit::Off || fill.by_soup) return finished(fill, filler, volume, fills);
  const double unfitted = filler.shares(kept_mesh(fill.candidates)).overlap();
  fill = fitted(std::move(fill), filler, budget, options, volume, watch);
  LatticeMesh result = finished(fill, filler, volume, fills);
  result.report.overlap_unfitted = unfitted;
  return result;
}

}  // namespace tetsoup
