#include <bit>
#include <cmath>

#include "base/whole.h"
#include "lattice/cell_rows.h"
#include "lattice/kept_cells.h"

namespace tetsoup {
namespace {

constexpr unsigned kSampleOrder = 4;  ///< 35 points in a tet that holds no voxel centre.

/// Judges the tets of one cell by the voxels whose centres they hold. The space beyond the grid is outside.
class CellJudge {
 public:
  CellJudge(const InsideBlocks& inside, const LatticeFrame& frame, double rho_min)
      : inside_(inside), rows_(inside, frame), frame_(frame), rho_min_(rho_min) {}

  /// Appends what the cells [x_begin, x_end) of a row keep.
  void judge(int x_begin, int x_end, int y, int z, KeptCells& kept) const {
    const int count = x_end - x_begin;
    const VoxelRange range = voxels_around({x_begin, y, z}, {x_end, y + 1, z + 1}, count > 1 ? 1 : 0);
    switch (inside_.content(range)) {
      case Content::Outside:
        return;
      case Content::Inside:
        for (int x = x_begin; x < x_end; ++x) kept.cells.push_back({{x, y, z}, (1U << kTetsPerCell) - 1});
        return;
      case Content::Mixed:
        break;
    }
    if (count > 1) {
      const int middle = x_begin + count / 2;
      judge(x_begin, middle, y, z, kept);
      judge(middle, x_end, y, z, kept);
    } else if (const std::uint8_t tets = dense_tets({x_begin, y, z}, range, kept.sampled_tets); tets != 0) {
      kept.cells.push_back({{x_begin, y, z}, tets});
    }
  }

 private:
  /// Voxels in a box around the cells, one voxel wider on every side so that sample points fall into it too, and
  /// wider by `margin`.
  VoxelRange voxels_around(const Cell& begin, const Cell& end, int margin) const {
    const GridFrame& grid = inside_.bits().frame;
    Vec3d lo{1e300, 1e300, 1e300}, hi = lo * -1;
    for (unsigned corner = 0; corner < 8; ++corner) {
      const auto at = [&](std::size_t i) { return static_cast<double>((corner >> i & 1U) != 0 ? end[i] : begin[i]); };
      const Vec3d p = (frame_.to_point({at(0), at(1), at(2)}) - grid.origin) * (1 / grid.voxel_size);
      lo = min(lo, p);
      hi = max(hi, p);
    }
    const auto below = [&](double v) { return floor_to_int(v) - 1 - margin; };
    const auto above = [&](double v) { return floor_to_int(v) + 2 + margin; };
    return {{below(lo.x), below(lo.y), below(lo.z)}, {above(hi.x), above(hi.y), above(hi.z)}};
  }

  std::uint8_t dense_tets(const Cell& cell, const VoxelRange& range, std::size_t& sampled) const {
    auto [total, in] = rows_.count(cell, range);
    unsigned kept = 0;
    for (std::size_t t = 0; t < kTetsPerCell; ++t) {
      if (total[t] == 0) {
        ++sampled;
        sample_tet(cell, t, total[t], in[t]);
      }
      const bool dense = static_cast<double>(in[t]) >= rho_min_ * static_cast<double>(total[t]);
      kept |= static_cast<unsigned>(dense) << t;
    }
    return static_cast<std::uint8_t>(kept);
  }

  /// Looks up the voxels at 35 points spread over the tet.
  void sample_tet(const Cell& cell, std::size_t tet, std::size_t& total, std::size_t& in) const {
    const GridFrame& grid = inside_.bits().frame;
    std::array<Vec3d, 4> corner;
    const auto names = tet_corners(tet, is_odd(cell));
    for (std::size_t i = 0; i < 4; ++i) corner[i] = frame_.to_point(corner_of(cell, names[i]));
    const auto weight = [](unsigned i) { return (i + 0.25) / (kSampleOrder + 1); };
    for (unsigned a = 0; a <= kSampleOrder; ++a) {
      for (unsigned b = 0; a + b <= kSampleOrder; ++b) {
        for (unsigned c = 0; a + b + c <= kSampleOrder; ++c) {
          const Vec3d point = corner[0] * weight(a) + corner[1] * weight(b) + corner[2] * weight(c) +
                              corner[3] * weight(kSampleOrder - a - b - c);
          const Vec3d voxel = (point - grid.origin) * (1 / grid.voxel_size) + Vec3d{0.5, 0.5, 0.5};
          ++total;
          const int x = floor_to_int(voxel.x);
          in += inside_.word(x, x + 1, floor_to_int(voxel.y), floor_to_int(voxel.z));
        }
      }
    }
  }

  static Vec3d corner_of(const Cell& cell, unsigned corner) {
    return Vec3d{static_cast<double>(cell[0]), static_cast<double>(cell[1]), static_cast<double>(cell[2])} +
           corner_offset(corner);
  }

  const InsideBlocks& inside_;
  CellRows rows_;
  const LatticeFrame& frame_;
  double rho_min_;
};

}  // namespace

KeptCells keep_dense_tets(const InsideBlocks& inside, const LatticeFrame& frame, double rho_min, StageWatch& watch) {
  const CellJudge judge(inside, frame, rho_min);
  const std::int64_t rows_y = frame.end[1] - frame.begin[1], rows_z = frame.end[2] - frame.begin[2];
  std::vector<KeptCells> rows(static_cast<std::size_t>(rows_y * rows_z));
  parallel_for(rows_y * rows_z, 1, watch, [&](std::int64_t index, std::int64_t) {
    const int y = frame.begin[1] + static_cast<int>(index % rows_y);
    const int z = frame.begin[2] + static_cast<int>(index / rows_y);
    judge.judge(frame.begin[0], frame.end[0], y, z, rows[static_cast<std::size_t>(index)]);
  });

  KeptCells all;
  for (const KeptCells& row : rows) {
    all.cells.insert(all.cells.end(), row.cells.begin(), row.cells.end());
    all.sampled_tets += row.sampled_tets;
    for (const KeptCell& c : row.cells) all.tet_count += static_cast<std::size_t>(std::popcount(c.tets));
  }
  return all;
}

}  // namespace tetsoup
