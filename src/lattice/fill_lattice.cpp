#include <algorithm>
#include <bit>
#include <cmath>

#include "base/bits.h"
#include "base/require.h"
#include "base/tet_geometry.h"
#include "lattice/inside_blocks.h"
#include "lattice/kept_cells.h"
#include "lattice/lattice_vertices.h"

namespace tetsoup {
namespace {

constexpr int kMaxCells = 1024;
constexpr double kMaxTets = 2147483648.0;
constexpr double kDefaultTets = 2000;   ///< What the default cell edge aims at.
constexpr double kGoodEnough = 0.04;    ///< Relative distance to the aim at which the search for the edge ends.
constexpr double kLeastCovered = 0.25;  ///< A pseudo volume that covers less of the soup is nothing but stray voxels.
constexpr double kLeastCore =
    0.02;  ///< Share of inside voxels within inside voxels; below, the volume is a mere sheet.
constexpr double kWholeCells = 0.15;  ///< A whole number of cells is preferred while the count stays this near the aim.
constexpr double kVolumeMiss = 0.03;  ///< Relative; a lattice that keeps the volume this well is left as it is.
constexpr int kMaxFills = 8;          ///< Tries of the search.
constexpr double kSmallestCellVoxels =
    0.75;  ///< The search makes no cells smaller: they would see no more of the shape.

void check_options(const LatticeOptions& o) {
  if (o.cells && o.cell_size) throw InvalidInput("give cells or cell_size, not both");
  require(!o.cells || (*o.cells >= 1 && *o.cells <= kMaxCells), "cells", o.cells.value_or(0), "1 to 1024");
  require(!o.cell_size || (*o.cell_size > 0 && std::isfinite(*o.cell_size)), "cell_size", o.cell_size.value_or(0),
          "positive and finite");
  require(o.rho_min > 0 && o.rho_min <= 1, "rho_min", o.rho_min, "above 0 and at most 1");
  const auto is_bounded = [](const Vec3d& v) {
    constexpr double kLimit = 1e6;  // whole cells or turns beyond that only lose digits
    return std::abs(v.x) <= kLimit && std::abs(v.y) <= kLimit && std::abs(v.z) <= kLimit;
  };
  require(is_bounded(o.translate_cells), "translate_cells", o.translate_cells.x, "finite, at most 1e6");
  require(is_bounded(o.rotate), "rotate", o.rotate.x, "finite, at most 1e6");
}

double longest_edge(const Box3& box) {
  const Vec3d e = box.hi - box.lo;
  return std::max({e.x, e.y, e.z});
}

struct Fill {
  LatticeFrame frame;
  KeptCells kept;
  bool by_soup = false;
};

/// Whether density left a body: at least every second tet has another of its own cell beside it. What it leaves of a
/// sheet thinner than a cell is crumbs.
bool holds_together(const KeptCells& kept) {
  std::size_t beside = 0;
  for (const KeptCell& k : kept.cells) {
    const auto corners = static_cast<std::size_t>(std::popcount(k.tets & 0b11110U));
    if ((k.tets & 1U) && corners > 0) beside += corners + 1;
  }
  return beside > 0 && 2 * beside >= kept.tet_count;
}

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

class Filler {
 public:
  Filler(const PseudoVolume& volume, const CleanSoup& soup, const LatticeOptions& options, StageWatch& watch)
      : volume_(volume),
        soup_(soup),
        options_(options),
        watch_(watch),
        grid_(volume.inside.frame),
        inside_(volume.inside, watch) {}

  /// The edge is raised where single precision cannot hold so fine a lattice, as the voxels' edge is.
  Fill with_cells(int cells) { return fill(std::max(longest_edge(grid_box(grid_)) / cells, finest_cell_size(grid_))); }

  Fill with_cell_size(double cell_size) {
    require(cell_size >= finest_cell_size(grid_), "cell_size", cell_size,
            "at least " + std::to_string(finest_cell_size(grid_)) +
                ", or single precision cannot hold the vertices so far from the origin");
    return fill(cell_size);
  }

  /// Looks for the edge that gives about the default count: by density, and along the soup where density leaves
  /// nothing.
  Fill with_default_size() {
    const double tets = volume_.report.volume * kTetsPerCell / kDefaultTets;
    if (has_volume()) {
      Fill dense = search(std::cbrt(tets), 3, [&](double size) { return try_density(size); });
      if (holds_together(dense.kept)) return with_whole_cells(std::move(dense));
    }
    return search(longest_edge(grid_box(grid_)) / 16, 2, [&](double size) { return try_soup(size); });
  }

 private:
  bool has_volume() const {
    return volume_.report.inside_voxels > 0 && volume_.report.soup_covered >= kLeastCovered &&
           core_share(volume_.inside, watch_) >= kLeastCore;
  }
  Fill fill(double cell_size) {
    Fill dense;
    if (has_volume()) dense = try_density(cell_size);
    return holds_together(dense.kept) ? dense : try_soup(cell_size);
  }
  Fill try_density(double cell_size) {
    Fill fill{make_checked_frame(cell_size), {}, false};
    fill.kept = keep_dense_tets(inside_, fill.frame, options_.rho_min, watch_);
    return fill;
  }
  Fill try_soup(double cell_size) {
    Fill fill{make_checked_frame(cell_size), {}, true};
    fill.kept = keep_crossed_tets(soup_, fill.frame, watch_);
    return fill;
  }

  /// The same with the next whole number of cells along the longest axis, so that the lattice ends where the box does,
  /// if that meets the volume much better: a block is then met exactly.
  Fill with_whole_cells(Fill fill) {
    const double miss = volume_miss(fill);
    if (miss < kVolumeMiss) return fill;
    const double longest = longest_edge(grid_box(grid_)), cells = longest / fill.frame.cell_size;
    for (const double whole : {std::round(cells), std::round(cells) > cells ? std::floor(cells) : std::ceil(cells)}) {
      if (whole < 1 || longest / whole < smallest_cell()) continue;
      Fill other = try_density(longest / whole);
      const double tets_missed = std::abs(static_cast<double>(other.kept.tet_count) / kDefaultTets - 1);
      if (tets_missed <= kWholeCells && volume_miss(other) < miss / 2 && holds_together(other.kept)) return other;
    }
    return fill;
  }

  /// Relative difference between the volumes of the kept tets and of the inside voxels.
  double volume_miss(const Fill& fill) const {
    double cells = 0;  // the middle tet is a third of its cube, each corner a sixth
    for (const KeptCell& k : fill.kept.cells)
      cells += ((k.tets & 1U) != 0 ? 1.0 / 3 : 0) + std::popcount(k.tets & 0b11110U) / 6.0;
    return std::abs(cells * std::pow(fill.frame.cell_size, 3) / volume_.report.volume - 1);
  }

  double smallest_cell() const { return std::max(kSmallestCellVoxels * grid_.voxel_size, finest_cell_size(grid_)); }

  LatticeFrame make_checked_frame(double cell_size) const {
    const Box3 box = grid_box(grid_);
    const Vec3d e = (box.hi - box.lo) * (1 / cell_size);
    const double tets = (e.x + 1) * (e.y + 1) * (e.z + 1) * kTetsPerCell;
    require(tets < kMaxTets && longest_edge(box) / cell_size <= 4 * kMaxCells, "cell_size", cell_size,
            "large enough for at most 2^31 tets and 4096 cells along the longest axis");
    return make_lattice_frame(grid_, options_, cell_size);
  }

  /// The count goes as edge^-power; each try corrects the edge by what the last one missed.
  template <class Try>
  Fill search(double cell_size, double power, const Try& try_size) {
    const double smallest = smallest_cell();
    const double largest = longest_edge(grid_box(grid_));
    Fill best;
    double best_miss = 1e300;
    for (int i = 0; i < kMaxFills; ++i) {
      cell_size = std::clamp(cell_size, smallest, std::max(smallest, largest));
      Fill fill = try_size(cell_size);
      const double ratio = std::max(1.0, static_cast<double>(fill.kept.tet_count)) / kDefaultTets;
      if (std::abs(std::log(ratio)) < best_miss) {
        best_miss = std::abs(std::log(ratio));
        best = std::move(fill);
      }
      if (std::abs(ratio - 1) < kGoodEnough) break;
      const double previous = cell_size;
      cell_size *= std::clamp(std::pow(ratio, 1 / power), 0.5, 2.0);
      if (std::clamp(cell_size, smallest, std::max(smallest, largest)) == previous) break;
    }
    return best;
  }

  const PseudoVolume& volume_;
  const CleanSoup& soup_;
  const LatticeOptions& options_;
  StageWatch& watch_;
  const GridFrame& grid_;
  InsideBlocks inside_;
};

/// Vertices in lattice order, tets by cell and then by number.
TetMesh make_mesh(const Fill& fill) {
  TETSOUP_ASSERT(!fill.kept.cells.empty());  // a finite triangle always touches a tet
  const auto for_each_corner = [&](const auto& visit) {
    for (const KeptCell& k : fill.kept.cells)
      for (std::size_t t = 0; t < kTetsPerCell; ++t)
        if (k.tets >> t & 1U)
          for (const unsigned corner : tet_corners(t, is_odd(k.cell))) visit(k.cell, corner);
  };
  LatticeVertices vertices(fill.kept.cells);
  for_each_corner([&](const Cell& cell, unsigned corner) { vertices.add(cell, corner); });
  vertices.give_numbers();

  TetMesh mesh;
  mesh.vertices.reserve(vertices.count());
  vertices.for_each([&](const Cell& at) {
    mesh.vertices.push_back(to_float(
        fill.frame.to_point({static_cast<double>(at[0]), static_cast<double>(at[1]), static_cast<double>(at[2])})));
  });
  mesh.tets.resize(fill.kept.tet_count);
  std::size_t i = 0;
  for_each_corner([&](const Cell& cell, unsigned corner) {
    mesh.tets[i / 4][i % 4] = vertices.number(cell, corner);
    ++i;
  });
  return mesh;
}

double volume_of(const TetMesh& mesh) {
  double sum = 0;
  for (const Tet& t : mesh.tets)
    sum += signed_volume(to_double(mesh.vertices[t[0]]), to_double(mesh.vertices[t[1]]), to_double(mesh.vertices[t[2]]),
                         to_double(mesh.vertices[t[3]]));
  return sum;
}

}  // namespace

LatticeMesh fill_lattice(const PseudoVolume& volume, const CleanSoup& soup, const LatticeOptions& options,
                         const Progress& progress) {
  check_options(options);
  if (soup.report.used_triangles == 0) throw InvalidInput("the soup has no finite triangle");
  StageWatch watch(progress, "lattice");
  Filler filler(volume, soup, options, watch);
  const Fill fill = options.cells       ? filler.with_cells(*options.cells)
                    : options.cell_size ? filler.with_cell_size(*options.cell_size)
                                        : filler.with_default_size();

  LatticeMesh result;
  result.mesh = make_mesh(fill);
  LatticeReport& report = result.report;
  report.cells = fill.frame.count;
  report.cell_size = fill.frame.cell_size;
  report.used_cells = fill.kept.cells.size();
  report.tet_count = fill.kept.tet_count;
  report.sampled_tets = fill.kept.sampled_tets;
  report.kept_volume = volume_of(result.mesh);
  report.pseudo_volume = volume.report.volume;
  report.kept_by_soup = fill.by_soup;
  return result;
}

}  // namespace tetsoup
