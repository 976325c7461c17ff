#include "lattice/densities.h"

#include <bit>
#include <cmath>

#include "base/whole.h"
#include "lattice/cell_rows.h"
#include "lattice/tet_rows.h"

namespace tetsoup {
namespace {

constexpr unsigned kSampleOrder = 4;  ///< 35 points in a tet that holds no voxel centre.

using CellCounts = std::array<VoxelCount, kMostTetsPerCell>;

Vec3d lower_corner(const Cell& cell) {
  return {static_cast<double>(cell[0]), static_cast<double>(cell[1]), static_cast<double>(cell[2])};
}

/// Judges the tets of one cell by the voxels whose centres they hold. The space beyond the grid is outside.
class CellJudge {
 public:
  CellJudge(const InsideBlocks& inside, const LatticeFrame& frame, const LatticeTable& table, double rho_min)
      : inside_(inside),
        cell_rows_(inside, frame),
        tet_rows_(inside, frame, table),
        frame_(frame),
        table_(table),
        is_five_(&table == &lattice_table(LatticeKind::Five)),
        rho_min_(rho_min) {}

  /// Appends the cells [x_begin, x_end) of a row that are not wholly outside.
  void judge(int x_begin, int x_end, int y, int z, FilledCells& filled) const {
    const int count = x_end - x_begin;
    const VoxelRange range = voxels_around({x_begin, y, z}, {x_end - 1, y, z}, count > 1 ? 1 : 0);
    switch (inside_.content(range)) {
      case Content::Outside:
        return;
      case Content::Inside:
        for (int x = x_begin; x < x_end; ++x) filled.cells.push_back({{x, y, z}, table_.all_tets()});
        filled.densities.insert(filled.densities.end(), static_cast<std::size_t>(count) * table_.tet_count, 1.0F);
        filled.kept_tets += static_cast<std::size_t>(count) * table_.tet_count;
        return;
      case Content::Mixed:
        break;
    }
    if (count > 1) {
      const int middle = x_begin + count / 2;
      judge(x_begin, middle, y, z, filled);
      judge(middle, x_end, y, z, filled);
    } else {
      judge_tets({x_begin, y, z}, range, filled);
    }
  }

 private:
  /// Voxels in a box of lattice coordinates, one voxel wider on every side so that sample points fall into it too, and
  /// wider by `margin`.
  VoxelRange voxels_in(const Vec3d& begin, const Vec3d& end, int margin) const {
    const GridFrame& grid = inside_.bits().frame;
    Vec3d lo{1e300, 1e300, 1e300}, hi = lo * -1;
    for (unsigned corner = 0; corner < 8; ++corner) {
      const Vec3d at{(corner & 1U) != 0 ? end.x : begin.x, (corner & 2U) != 0 ? end.y : begin.y,
                     (corner & 4U) != 0 ? end.z : begin.z};
      const Vec3d p = (frame_.to_point(at) - grid.origin) * (1 / grid.voxel_size);
      lo = min(lo, p);
      hi = max(hi, p);
    }
    const auto below = [&](double v) { return floor_to_int(v) - 1 - margin; };
    const auto above = [&](double v) { return floor_to_int(v) + 2 + margin; };
    return {{below(lo.x), below(lo.y), below(lo.z)}, {above(hi.x), above(hi.y), above(hi.z)}};
  }
  VoxelRange voxels_around(const Cell& first, const Cell& last, int margin) const {
    const double reach = static_cast<double>(table_.reach) / kStepsPerCell;
    return voxels_in(lower_corner(first), lower_corner(last) + Vec3d{reach, reach, reach}, margin);
  }

  void judge_tets(const Cell& cell, const VoxelRange& range, FilledCells& filled) const {
    CellCounts counts = count_voxels(cell, range);
    unsigned kept = 0;
    bool any = false;
    for (std::size_t t = 0; t < table_.tet_count; ++t) {
      if (counts[t].total == 0) {
        ++filled.sampled_tets;
        counts[t] = sample_tet(cell, t);
      }
      const double total = static_cast<double>(counts[t].total), in = static_cast<double>(counts[t].inside);
      kept |= static_cast<unsigned>(in >= rho_min_ * total) << t;
      any = any || in > 0;
    }
    if (!any) return;
    filled.cells.push_back({cell, static_cast<std::uint16_t>(kept)});
    filled.kept_tets += static_cast<std::size_t>(std::popcount(kept));
    for (std::size_t t = 0; t < table_.tet_count; ++t)
      filled.densities.push_back(static_cast<float>(counts[t].inside) / static_cast<float>(counts[t].total));
  }

  /// Of tets that are wholly inside or outside one voxel stands for all.
  CellCounts count_voxels(const Cell& cell, const VoxelRange& range) const {
    CellCounts counts{};
    if (is_five_) {
      const TetCounts five = cell_rows_.count(cell, range);
      for (std::size_t t = 0; t < kTetsPerCell; ++t) counts[t] = {five.total[t], five.inside[t]};
      return counts;
    }
    for (std::size_t t = 0; t < table_.tet_count; ++t) {
      const TetCorners corners = table_.corners(t, is_odd(cell));
      const Vec3d lo = min(min(corners[0], corners[1]), min(corners[2], corners[3]));
      const Vec3d hi = max(max(corners[0], corners[1]), max(corners[2], corners[3]));
      const VoxelRange box = voxels_in(lower_corner(cell) + lo, lower_corner(cell) + hi, 0);
      const Content content = inside_.content(box);
      counts[t] = content == Content::Mixed ? tet_rows_.count(cell, t, box) : VoxelCount{1, content == Content::Inside};
    }
    return counts;
  }

  /// Looks up the voxels at 35 points spread over the tet.
  VoxelCount sample_tet(const Cell& cell, std::size_t tet) const {
    const GridFrame& grid = inside_.bits().frame;
    TetCorners corner = table_.corners(tet, is_odd(cell));
    for (Vec3d& p : corner) p = frame_.to_point(lower_corner(cell) + p);
    const auto weight = [](unsigned i) { return (i + 0.25) / (kSampleOrder + 1); };
    VoxelCount count;
    for (unsigned a = 0; a <= kSampleOrder; ++a) {
      for (unsigned b = 0; a + b <= kSampleOrder; ++b) {
        for (unsigned c = 0; a + b + c <= kSampleOrder; ++c) {
          const Vec3d point = corner[0] * weight(a) + corner[1] * weight(b) + corner[2] * weight(c) +
                              corner[3] * weight(kSampleOrder - a - b - c);
          const Vec3d voxel = (point - grid.origin) * (1 / grid.voxel_size) + Vec3d{0.5, 0.5, 0.5};
          ++count.total;
          const int x = floor_to_int(voxel.x);
          count.inside += inside_.word(x, x + 1, floor_to_int(voxel.y), floor_to_int(voxel.z));
        }
      }
    }
    return count;
  }

  const InsideBlocks& inside_;
  CellRows cell_rows_;  ///< Five tets at once,
  TetRows tet_rows_;    ///< or any one.
  const LatticeFrame& frame_;
  const LatticeTable& table_;
  bool is_five_;
  double rho_min_;
};

}  // namespace

FilledCells find_densities(const InsideBlocks& inside, const LatticeFrame& frame, const LatticeTable& table,
                           double rho_min, StageWatch& watch) {
  const CellJudge judge(inside, frame, table, rho_min);
  const std::int64_t rows_y = frame.end[1] - frame.begin[1], rows_z = frame.end[2] - frame.begin[2];
  std::vector<FilledCells> rows(static_cast<std::size_t>(rows_y * rows_z));
  parallel_for(rows_y * rows_z, 1, watch, [&](std::int64_t index, std::int64_t) {
    const int y = frame.begin[1] + static_cast<int>(index % rows_y);
    const int z = frame.begin[2] + static_cast<int>(index / rows_y);
    judge.judge(frame.begin[0], frame.end[0], y, z, rows[static_cast<std::size_t>(index)]);
  });

  FilledCells all;
  for (const FilledCells& row : rows) {
    all.cells.insert(all.cells.end(), row.cells.begin(), row.cells.end());
    all.densities.insert(all.densities.end(), row.densities.begin(), row.densities.end());
    all.kept_tets += row.kept_tets;
    all.sampled_tets += row.sampled_tets;
  }
  return all;
}

}  // namespace tetsoup
