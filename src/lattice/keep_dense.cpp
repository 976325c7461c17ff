#include <bit>
#include <cmath>

#include "base/tet_geometry.h"
#include "lattice/kept_cells.h"

namespace tetsoup {
namespace {

constexpr unsigned kSampleOrder = 4;  ///< 35 points in a tet that holds no voxel centre.

struct VoxelRange {
  std::array<int, 3> begin{}, end{};
};

/// Judges the tets of one cell by the voxels whose centres they hold. The space beyond the grid is outside.
class CellJudge {
 public:
  CellJudge(const BitGrid& inside, const LatticeFrame& frame, double rho_min)
      : inside_(inside), frame_(frame), rho_min_(rho_min) {
    const GridFrame& grid = inside.frame;
    first_ = frame.to_cell(grid.origin);
    for (std::size_t i = 0; i < 3; ++i) {
      Vec3d along;
      (i == 0 ? along.x : i == 1 ? along.y : along.z) = grid.voxel_size;
      step_[i] = frame.to_cell(grid.origin + along) - first_;
    }
  }

  KeptCell judge(const Cell& cell, std::size_t& sampled) const {
    const VoxelRange range = voxels_around(cell);
    const std::size_t voxels = volume(range), in = count_inside(range);
    if (in == 0) return {cell, 0};
    if (in == voxels) return {cell, (1U << kTetsPerCell) - 1};
    return {cell, count_each_tet(cell, range, sampled)};
  }

 private:
  /// Voxels in a box around the cell, one voxel wider on every side so that sample points fall into it too.
  VoxelRange voxels_around(const Cell& cell) const {
    const GridFrame& grid = inside_.frame;
    Vec3d lo{1e300, 1e300, 1e300}, hi = lo * -1;
    for (unsigned corner = 0; corner < 8; ++corner) {
      const Vec3d p = (frame_.to_point(corner_of(cell, corner)) - grid.origin) * (1 / grid.voxel_size);
      lo = min(lo, p);
      hi = max(hi, p);
    }
    const auto below = [](double v) { return static_cast<int>(std::floor(v)) - 1; };
    return {{below(lo.x), below(lo.y), below(lo.z)}, {below(hi.x) + 3, below(hi.y) + 3, below(hi.z) + 3}};
  }

  static std::size_t volume(const VoxelRange& r) {
    std::size_t v = 1;
    for (std::size_t i = 0; i < 3; ++i) v *= static_cast<std::size_t>(r.end[i] - r.begin[i]);
    return v;
  }

  std::size_t count_inside(const VoxelRange& range) const {
    const auto& size = inside_.frame.size;
    const int x0 = std::max(range.begin[0], 0), x1 = std::min(range.end[0], size[0]);
    if (x0 >= x1) return 0;
    std::size_t count = 0;
    for (int z = std::max(range.begin[2], 0); z < std::min(range.end[2], size[2]); ++z) {
      for (int y = std::max(range.begin[1], 0); y < std::min(range.end[1], size[1]); ++y) {
        const std::uint64_t* row = inside_.words.data() + inside_.row(y, z);
        for (int w = x0 >> 6; w <= (x1 - 1) >> 6; ++w) {
          std::uint64_t bits = row[w];
          if (w == x0 >> 6) bits &= ~std::uint64_t{0} << (x0 & 63);
          if (w == (x1 - 1) >> 6) bits &= ~std::uint64_t{0} >> (63 - ((x1 - 1) & 63));
          count += static_cast<std::size_t>(std::popcount(bits));
        }
      }
    }
    return count;
  }

  bool is_inside(int x, int y, int z) const { return inside_.frame.contains(x, y, z) && inside_.test(x, y, z); }

  std::uint8_t count_each_tet(const Cell& cell, const VoxelRange& range, std::size_t& sampled) const {
    const bool odd = is_odd(cell);
    std::array<std::size_t, kTetsPerCell> total{}, in{};
    for (int z = range.begin[2]; z < range.end[2]; ++z) {
      for (int y = range.begin[1]; y < range.end[1]; ++y) {
        const Vec3d row = first_ + step_[1] * y + step_[2] * z;
        for (int x = range.begin[0]; x < range.end[0]; ++x) {
          const Vec3d p = row + step_[0] * x;
          if (std::floor(p.x) != cell[0] || std::floor(p.y) != cell[1] || std::floor(p.z) != cell[2]) continue;
          const std::size_t tet = owner_tet({p.x - cell[0], p.y - cell[1], p.z - cell[2]}, odd);
          ++total[tet];
          in[tet] += is_inside(x, y, z);
        }
      }
    }
    unsigned kept = 0;
    for (std::size_t t = 0; t < kTetsPerCell; ++t) {
      if (total[t] == 0) {
        ++sampled;
        sample_tet(cell, t, odd, total[t], in[t]);
      }
      const bool dense = static_cast<double>(in[t]) >= rho_min_ * static_cast<double>(total[t]);
      kept |= static_cast<unsigned>(dense) << t;
    }
    return static_cast<std::uint8_t>(kept);
  }

  /// Looks up the voxels at 35 points spread over the tet.
  void sample_tet(const Cell& cell, std::size_t tet, bool odd, std::size_t& total, std::size_t& in) const {
    const GridFrame& grid = inside_.frame;
    std::array<Vec3d, 4> corner;
    const auto names = tet_corners(tet, odd);
    for (std::size_t i = 0; i < 4; ++i) corner[i] = frame_.to_point(corner_of(cell, names[i]));
    const auto weight = [](unsigned i) { return (i + 0.25) / (kSampleOrder + 1); };
    for (unsigned a = 0; a <= kSampleOrder; ++a) {
      for (unsigned b = 0; a + b <= kSampleOrder; ++b) {
        for (unsigned c = 0; a + b + c <= kSampleOrder; ++c) {
          const Vec3d point = corner[0] * weight(a) + corner[1] * weight(b) + corner[2] * weight(c) +
                              corner[3] * weight(kSampleOrder - a - b - c);
          const Vec3d voxel = (point - grid.origin) * (1 / grid.voxel_size) + Vec3d{0.5, 0.5, 0.5};
          ++total;
          in += is_inside(static_cast<int>(std::floor(voxel.x)), static_cast<int>(std::floor(voxel.y)),
                          static_cast<int>(std::floor(voxel.z)));
        }
      }
    }
  }

  static Vec3d corner_of(const Cell& cell, unsigned corner) {
    return Vec3d{static_cast<double>(cell[0]), static_cast<double>(cell[1]), static_cast<double>(cell[2])} +
           corner_offset(corner);
  }

  const BitGrid& inside_;
  const LatticeFrame& frame_;
  double rho_min_;
  Vec3d first_;                ///< Cell coordinates of voxel (0, 0, 0)
  std::array<Vec3d, 3> step_;  ///< and their change from voxel to voxel.
};

}  // namespace

KeptCells keep_dense_tets(const BitGrid& inside, const LatticeFrame& frame, double rho_min, StageWatch& watch) {
  struct Row {
    std::vector<KeptCell> cells;
    std::size_t sampled = 0;
  };
  const CellJudge judge(inside, frame, rho_min);
  const std::int64_t rows_y = frame.end[1] - frame.begin[1], rows_z = frame.end[2] - frame.begin[2];
  std::vector<Row> rows(static_cast<std::size_t>(rows_y * rows_z));
  parallel_for(rows_y * rows_z, 1, watch, [&](std::int64_t index, std::int64_t) {
    Row& row = rows[static_cast<std::size_t>(index)];
    const int y = frame.begin[1] + static_cast<int>(index % rows_y);
    const int z = frame.begin[2] + static_cast<int>(index / rows_y);
    for (int x = frame.begin[0]; x < frame.end[0] && !watch.stopped(); ++x) {
      const KeptCell kept = judge.judge({x, y, z}, row.sampled);
      if (kept.tets != 0) row.cells.push_back(kept);
    }
  });

  KeptCells all;
  for (const Row& row : rows) {
    all.cells.insert(all.cells.end(), row.cells.begin(), row.cells.end());
    all.sampled_tets += row.sampled;
    for (const KeptCell& c : row.cells) all.tet_count += static_cast<std::size_t>(std::popcount(c.tets));
  }
  return all;
}

}  // namespace tetsoup
