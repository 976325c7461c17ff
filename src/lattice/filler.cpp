#include "lattice/filler.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/elementary.h"
#include "base/bits.h"
#include "base/mesh_voxels.h"
#include "base/require.h"
#include "lattice/body_voxels.h"
#include "lattice/carve.h"
#include "lattice/clean_topology.h"
#include "lattice/cover.h"
#include "lattice/even_out.h"
#include "lattice/gather_candidates.h"
#include "lattice/separate.h"
#include "lattice/whole_cells.h"

namespace tetsoup {
namespace {

constexpr int kMaxCells = 4096;  ///< Along the longest axis.
constexpr double kMaxTets = 2147483648.0;
constexpr double kLeastCovered = 0.25;  ///< A pseudo volume that covers less of the soup is nothing but stray voxels.
constexpr double kMostlyExact = 0.5;    ///< Share of the soup; voxels that are exact are a volume, however thin.
constexpr double kLeastCore =
    0.02;  ///< Share of inside voxels within inside voxels; below, the volume is a mere sheet.

struct CoreCounts {
  std::size_t all = 0, core = 0;
  CoreCounts& operator+=(const CoreCounts& other) {
    all += other.all;
    core += other.core;
    return *this;
  }
};

/// Inside voxels of a layer, and those of them whose six neighbours are inside too.
CoreCounts count_core(const BitGrid& inside, int z) {
  const std::size_t words = inside.words_per_row;
  const BitRows rows(inside);
  CoreCounts counts;
  for (int y = 0; y < inside.frame.size[1]; ++y) {
    const std::uint64_t* here = rows.at(y, z);
    const std::array beside{rows.at(y - 1, z), rows.at(y + 1, z), rows.at(y, z - 1), rows.at(y, z + 1)};
    for (std::size_t w = 0; w < words; ++w) {
      if (here[w] == 0) continue;
      std::uint64_t bits = here[w] & shifted_up(here, w) & shifted_down(here, w, words);
      for (const std::uint64_t* other : beside) bits &= other ? other[w] : 0;
      counts.all += bit_count(here[w]);
      counts.core += bit_count(bits);
    }
  }
  return counts;
}

double core_share(const BitGrid& inside, StageWatch& watch) {
  const auto counts = parallel_sum<CoreCounts>(inside.frame.size[2], 1, watch, [&](std::int64_t z, std::int64_t) {
    return count_core(inside, static_cast<int>(z));
  });
  return counts.all == 0 ? 0 : static_cast<double>(counts.core) / static_cast<double>(counts.all);
}

/// Held tets that would not stay for their density.
std::size_t count_held_below(const Candidates& candidates, double rho_min) {
  std::size_t count = 0;
  for (std::size_t t = 0; t < candidates.kept.size(); ++t)
    count += candidates.kept[t] == kHeld && candidates.density[t] < rho_min;
  return count;
}

}  // namespace

std::size_t Fill::kept_tets() const {
  return static_cast<std::size_t>(
      std::count_if(candidates.kept.begin(), candidates.kept.end(), [](std::uint8_t kept) { return kept != 0; }));
}

std::size_t Fill::kept_vertices() const {
  std::vector<std::uint8_t> used(candidates.mesh.vertices.size());
  for (std::size_t t = 0; t < candidates.kept.size(); ++t)
    if (candidates.kept[t] != 0)
      for (const std::uint32_t v : candidates.mesh.tets[t]) used[v] = 1;
  return static_cast<std::size_t>(std::count(used.begin(), used.end(), 1));
}

Filler::Filler(const PseudoVolume& volume, const CleanSoup& soup, const LatticeOptions& options, StageWatch& watch)
    : volume_(volume),
      soup_(soup),
      options_(options),
      watch_(watch),
      grid_(volume.inside.frame),
      table_(lattice_table(options.kind)),
      has_volume_(find_volume()),
      body_(find_body()),
      blocks_(body_, watch) {
  if (options.separate == Separate::Apart) parts_.emplace(body_, watch);
}

bool Filler::find_volume() const {
  const PseudoVolumeReport& report = volume_.report;
  return report.inside_voxels > 0 && report.soup_covered >= kLeastCovered &&
         (report.exact_share >= kMostlyExact || core_share(volume_.inside, watch_) >= kLeastCore);
}

BitGrid Filler::find_body() const {
  if (!has_volume_) return soup_voxels(grid_, soup_, watch_);
  const bool covers_soup = options_.thin == Thin::Keep && options_.cover != Cover::Inside;
  return covers_soup ? body_voxels(volume_.inside, soup_, watch_) : volume_.inside;
}

Fill Filler::fill(const LatticePose& pose, Cells cells) {
  check_cell(pose.cell_size);
  const double overhang = static_cast<double>(table_.reach) / kStepsPerCell - 1;
  Fill fill{pose, make_lattice_frame(grid_, pose, overhang), {}, false, 0, 0, {}};
  ++fills_;
  FilledCells filled = find_densities(blocks_, fill.frame, table_, options_.rho_min, watch_);
  if (cells == Cells::WholeWhereFlat) {
    level_flat_cells(body_, fill.frame, table_, options_.rho_min, filled, watch_);
  }
  fill.by_soup = !has_volume_ || (filled.kept_tets == 0 && options_.thin == Thin::Drop);
  if (fill.by_soup) keep_crossed_tets(soup_, fill.frame, table_, filled, watch_);
  fill.dense_tets = filled.kept_tets;
  fill.sampled_tets = filled.sampled_tets;
  fill.candidates = gather_candidates(filled, fill.frame, table_);
  mend(fill);
  return fill;
}

/// Whatever holds something of the body is kept first, each part of the body with its own copy; then what is not
/// needed goes.
void Filler::carve_cover(Fill& fill) {
  constexpr double kNoneDense = 2;  // a sheet fills no tet
  Candidates& candidates = fill.candidates;
  if (fill.by_soup) {
    constexpr float kTrace = 1e-3F;  // a sheet may pass between the voxels' centres
    for (std::size_t t = 0; t < candidates.kept.size(); ++t)
      if (candidates.kept[t]) candidates.density[t] = std::max(candidates.density[t], kTrace);
  } else if (options_.thin == Thin::Keep) {
    keep_cover(candidates);
  }
  if (options_.cover == Cover::Enclose && options_.thin == Thin::Keep) {
    keep_enclosing_tets(candidates, soup_.soup.vertices, watch_);
    fill.mended.enclosing_tets = count_held_below(candidates, options_.rho_min);
  }
  if (options_.separate == Separate::Apart && !fill.by_soup) {
    if (options_.thin == Thin::Keep) trim_slivers(candidates, options_.rho_min, body_, watch_);
    const double rho_min = options_.thin == Thin::Keep ? 0 : options_.rho_min;
    const Separated apart = separate(candidates, body_, *parts_, rho_min, watch_);
    fill.mended.doubled_tets = apart.tets;
    fill.mended.parted_vertices = apart.vertices;
  }
  if (options_.thin == Thin::Keep)
    fill.mended.thin_tets =
        carve(candidates, fill.by_soup ? kNoneDense : options_.rho_min, body_, fill.mended.topology, watch_);
}

/// Mends what density leaves, step by step; each changes which candidates are kept, or the candidates, and notes in
/// `fill.mended` what it did.
void Filler::mend(Fill& fill) {
  Candidates& candidates = fill.candidates;
  LatticeReport& report = fill.mended;
  if (options_.cover == Cover::Inside && !fill.by_soup) {
    keep_inside_tets(candidates);
  } else {
    carve_cover(fill);
    if (options_.stairs == Stairs::Even && !fill.by_soup) report.evened_tets = even_out(candidates, options_.rho_min);
  }
  if (options_.cover == Cover::Enclose)
    report.enclosing_tets += keep_enclosing_tets(candidates, soup_.soup.vertices, watch_);
  TopologyOptions topology = options_.topology;
  if (options_.cover == Cover::Enclose) topology.min_part = 0;  // or what was enclosed would be dropped
  const TopologyReport cover = report.topology;
  report.topology = clean_topology(candidates, topology, watch_);
  report.topology.vertices_doubled += cover.vertices_doubled;
  if (options_.cover == Cover::Enclose) report.enclosing_tets += enclose_apart(candidates, soup_.soup.vertices, watch_);
}

Shares Filler::shares(const TetMesh& mesh) const {
  const MeshVoxels voxels = count_mesh_voxels(mesh, volume_.inside, watch_);
  const auto volume = [&](std::size_t count) {
    return static_cast<double>(count) * elementary::cube(grid_.voxel_size);
  };
  return {volume(voxels.in_both), volume(voxels.in_mesh - voxels.in_both),
          volume(volume_.report.inside_voxels - voxels.in_both)};
}

double Filler::longest_edge() const {
  const Box3 box = grid_box(grid_);
  const Vec3d e = box.hi - box.lo;
  return std::max({e.x, e.y, e.z});
}

double Filler::smallest_cell() const {
  const Box3 box = grid_box(grid_);
  const Vec3d e = box.hi - box.lo;
  const double tets = static_cast<double>(table_.tet_count);
  // A little more than the cube root alone, since a cell more is counted along every axis.
  const double most = elementary::cbrt(e.x * e.y * e.z * tets / kMaxTets) * 1.01 + longest_edge() / kMaxCells;
  return std::max(finest_cell_size(grid_), most);
}

void Filler::check_cell(double cell_size) const {
  require(cell_size >= finest_cell_size(grid_), "cell_size", cell_size,
          "at least " + std::to_string(finest_cell_size(grid_)) +
              ", or single precision cannot hold the vertices so far from the origin");
  constexpr double kOfBox = 1e6;  // Beyond, vertices would leave what single precision can hold.
  require(cell_size <= kOfBox * longest_edge(), options_.edge ? "edge" : "cell_size", options_.edge.value_or(cell_size),
          "at most a million times the box's longest edge");
  const Box3 box = grid_box(grid_);
  const Vec3d e = (box.hi - box.lo) * (1 / cell_size);
  const double tets = (e.x + 1) * (e.y + 1) * (e.z + 1) * static_cast<double>(table_.tet_count);
  require(tets < kMaxTets && longest_edge() / cell_size <= kMaxCells, "cell_size", cell_size,
          "large enough for at most 2^31 tets and 4096 cells along the longest axis");
}

}  // namespace tetsoup
