#include "lattice/whole_cells.h"

#include <algorithm>
#include <array>
#include <bit>

#include "base/whole.h"

namespace tetsoup {

namespace {

constexpr double kFilled = 0.95;  // Of the box around them that voxels fill to be a box; along an axis they lie apart
                                  // by their size, which the box is larger by.
constexpr double kMostOfCell = 0.98;  // A box as large as the cell says nothing of what it lacks.
constexpr std::int64_t kCellsPerChunk = 8;

/// Places of voxels in their cell, as far as a box can tell.
struct Spread {
  std::size_t count = 0;
  Vec3d lo{1, 1, 1}, hi{0, 0, 0};

  void add(const Vec3d& p) { ++count, lo = min(lo, p), hi = max(hi, p); }
  /// @param voxel  Extent of one along the cell's axes.
  /// @param share  Of the cell that a voxel takes.
  bool is_box(const Vec3d& voxel, double share) const {
    const Vec3d e = min(hi - lo + voxel, {1, 1, 1});
    const double box = e.x * e.y * e.z;
    return box < kMostOfCell && static_cast<double>(count) * share >= kFilled * box;
  }
};

class CellView {
 public:
  CellView(const BitGrid& inside, const LatticeFrame& frame) : inside_(inside), frame_(frame) {
    const double h = inside.frame.voxel_size;
    const Vec3d first = frame.to_cell(inside.frame.origin);
    double volume = 1;
    for (std::size_t i = 0; i < 3; ++i) {
      Vec3d along;
      (i == 0 ? along.x : i == 1 ? along.y : along.z) = h;
      step_[i] = frame.to_cell(inside.frame.origin + along) - first;
    }
    const auto extent = [&](double Vec3d::*c) {
      return std::max({std::abs(step_[0].*c), std::abs(step_[1].*c), std::abs(step_[2].*c)});
    };
    voxel_ = {extent(&Vec3d::x), extent(&Vec3d::y), extent(&Vec3d::z)};
    volume = std::abs(dot(cross(step_[0], step_[1]), step_[2]));
    share_ = volume;
  }

  /// Whether what is inside the cell, or what is not, is a box.
  bool is_flat(const Cell& cell) const {
    const GridFrame& grid = inside_.frame;
    const Vec3d corner{static_cast<double>(cell[0]), static_cast<double>(cell[1]), static_cast<double>(cell[2])};
    Vec3d lo{1e300, 1e300, 1e300}, hi = lo * -1;
    for (unsigned i = 0; i < 8; ++i) {
      const Vec3d at = corner + Vec3d{(i & 1U) != 0 ? 1.0 : 0.0, (i & 2U) != 0 ? 1.0 : 0.0, (i & 4U) != 0 ? 1.0 : 0.0};
      const Vec3d p = (frame_.to_point(at) - grid.origin) * (1 / grid.voxel_size);
      lo = min(lo, p), hi = max(hi, p);
    }
    Spread in, out;
    const Vec3d first = frame_.to_cell(grid.origin) - corner;
    for (int z = floor_to_int(lo.z); z <= floor_to_int(hi.z) + 1; ++z) {
      for (int y = floor_to_int(lo.y); y <= floor_to_int(hi.y) + 1; ++y) {
        for (int x = floor_to_int(lo.x); x <= floor_to_int(hi.x) + 1; ++x) {
          const Vec3d p = first + step_[0] * x + step_[1] * y + step_[2] * z;
          if (!(p.x >= 0 && p.y >= 0 && p.z >= 0 && p.x < 1 && p.y < 1 && p.z < 1)) continue;
          (grid.contains(x, y, z) && inside_.test(x, y, z) ? in : out).add(p);
        }
      }
    }
    return in.is_box(voxel_, share_) || out.is_box(voxel_, share_);
  }

 private:
  const BitGrid& inside_;
  const LatticeFrame& frame_;
  std::array<Vec3d, 3> step_;  ///< Change of cell coordinates from voxel to voxel.
  Vec3d voxel_;
  double share_ = 0;
};

}  // namespace

void level_flat_cells(const BitGrid& inside, const LatticeFrame& frame, const LatticeTable& table, double rho_min,
                      FilledCells& filled, StageWatch& watch) {
  const CellView view(inside, frame);
  parallel_for(static_cast<std::int64_t>(filled.cells.size()), kCellsPerChunk, watch,
               [&](std::int64_t begin, std::int64_t end) {
                 for (auto c = static_cast<std::size_t>(begin); c < static_cast<std::size_t>(end); ++c) {
                   float* density = &filled.densities[c * table.tet_count];
                   double sum = 0;
                   for (std::size_t t = 0; t < table.tet_count; ++t) {
                     sum += static_cast<double>(density[t]) * table.volume[t];
                   }
                   constexpr double kWhole = 0.1;
                   if (sum < kWhole || sum > 1 - kWhole || !view.is_flat(filled.cells[c].cell)) continue;
                   // What holds nothing of the body goes on doing so: a bar in a cell wants no more than its cover.
                   const bool stays = sum >= rho_min;
                   const auto level = static_cast<float>(sum);
                   for (std::size_t t = 0; t < table.tet_count; ++t) {
                     density[t] = stays ? level : std::min(density[t], level);
                   }
                   filled.cells[c].kept = stays ? table.all_tets() : std::uint16_t{0};
                 }
               });
  filled.kept_tets = 0;
  for (const FilledCell& c : filled.cells) filled.kept_tets += static_cast<std::size_t>(std::popcount(c.kept));
}

}  // namespace tetsoup
