#include "lattice/whole_cells.h"

#include <algorithm>
#include <array>
#include <bit>
#include <optional>

#include "base/whole.h"

namespace tetsoup {

namespace {

constexpr double kFilled = 0.95;  // Of the box around them that voxels fill to be a box; along an axis they lie apart
                                  // by their size, which the box is larger by.
constexpr double kMostOfCell = 0.98;  // A box as large as the cell says nothing of what it lacks.
constexpr double kLeast = 0.05;       // Of a cell: less, inside or outside, leaves it as it is.
constexpr double kBeyond = 1.5;       // Voxels behind a cell's face in which a box goes on.
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

/// Voxels of a cell, and whether what is inside goes on behind its lower and upper faces, by axis.
struct Content {
  Spread in, out;
  std::array<std::array<bool, 2>, 3> goes_on{};
};

/// What decides about a cell, and the density its tets get.
struct Fullness {
  double judged = 0, density = 0;
};

class CellView {
 public:
  CellView(const BitGrid& inside, const LatticeFrame& frame) : inside_(inside), frame_(frame) {
    const double h = inside.frame.voxel_size;
    const Vec3d first = frame.to_cell(inside.frame.origin);
    for (std::size_t i = 0; i < 3; ++i) {
      Vec3d along;
      (i == 0 ? along.x : i == 1 ? along.y : along.z) = h;
      step_[i] = frame.to_cell(inside.frame.origin + along) - first;
    }
    const auto extent = [&](double Vec3d::*c) {
      return std::max({std::abs(step_[0].*c), std::abs(step_[1].*c), std::abs(step_[2].*c)});
    };
    voxel_ = {extent(&Vec3d::x), extent(&Vec3d::y), extent(&Vec3d::z)};
    share_ = std::abs(dot(cross(step_[0], step_[1]), step_[2]));
  }

  /// What of the cell is inside, where that or the rest of it is a box, beside the axes along which a box of the inside
  /// goes on into both neighbours or ends within: a layer or a bar in the cell counts as if it filled it.
  std::optional<Fullness> fullness(const Cell& cell) const {
    const Content content = look_at(cell);
    const Spread& in = content.in;
    const double all = static_cast<double>(in.count) * share_;
    if (!in.is_box(voxel_, share_)) {
      return content.out.is_box(voxel_, share_) ? std::optional(Fullness{all, all}) : std::nullopt;
    }
    const Vec3d e = min(in.hi - in.lo + voxel_, {1, 1, 1});
    const std::array<double, 3> extent{e.x, e.y, e.z};
    double full = 1;
    int narrow = 0;  // axes along which it ends within
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [below, above] = content.goes_on[i];
      if (below != above) full *= extent[i];
      narrow += !below && !above ? 1 : 0;
    }
    if (narrow == 3) return Fullness{all, all};
    // A plate is as good as full; a bar stays, but is no fuller than it must be: bars side by side are not to be
    // joined.
    return Fullness{full, narrow == 1 ? full : all};
  }

 private:
  Content look_at(const Cell& cell) const {
    const GridFrame& grid = inside_.frame;
    const Vec3d corner{static_cast<double>(cell[0]), static_cast<double>(cell[1]), static_cast<double>(cell[2])};
    const Vec3d margin = voxel_ * kBeyond, first = frame_.to_cell(grid.origin) - corner;
    const auto [lo, hi] = voxels_around(corner - margin, corner + Vec3d{1, 1, 1} + margin);
    Content content;
    for (int z = lo[2]; z <= hi[2]; ++z) {
      for (int y = lo[1]; y <= hi[1]; ++y) {
        for (int x = lo[0]; x <= hi[0]; ++x) {
          const Vec3d p = first + step_[0] * x + step_[1] * y + step_[2] * z;
          const bool is_inside = grid.contains(x, y, z) && inside_.test(x, y, z);
          note(p, margin, is_inside, content);
        }
      }
    }
    return content;
  }

  /// A voxel in the cell, or behind one of its faces.
  static void note(const Vec3d& p, const Vec3d& margin, bool is_inside, Content& content) {
    const std::array<double, 3> at{p.x, p.y, p.z}, reach{margin.x, margin.y, margin.z};
    int beyond = 0;
    std::size_t axis = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      if (at[i] < -reach[i] || at[i] > 1 + reach[i]) return;
      if (at[i] < 0 || at[i] >= 1) ++beyond, axis = i;
    }
    if (beyond == 0) (is_inside ? content.in : content.out).add(p);
    if (beyond == 1 && is_inside) content.goes_on[axis][at[axis] < 0 ? 0 : 1] = true;
  }

  /// First and last voxel around a box in cell coordinates.
  std::array<std::array<int, 3>, 2> voxels_around(const Vec3d& begin, const Vec3d& end) const {
    const GridFrame& grid = inside_.frame;
    Vec3d lo{1e300, 1e300, 1e300}, hi = lo * -1;
    for (unsigned i = 0; i < 8; ++i) {
      const Vec3d at{(i & 1U) != 0 ? end.x : begin.x, (i & 2U) != 0 ? end.y : begin.y, (i & 4U) != 0 ? end.z : begin.z};
      const Vec3d p = (frame_.to_point(at) - grid.origin) * (1 / grid.voxel_size);
      lo = min(lo, p), hi = max(hi, p);
    }
    return {{{floor_to_int(lo.x), floor_to_int(lo.y), floor_to_int(lo.z)},
             {floor_to_int(hi.x) + 1, floor_to_int(hi.y) + 1, floor_to_int(hi.z) + 1}}};
  }

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
                   if (sum < kLeast || sum > 1 - kLeast) continue;
                   const std::optional<Fullness> full = view.fullness(filled.cells[c].cell);
                   if (!full) continue;
                   // What holds nothing of the body goes on doing so.
                   const bool stays = full->judged >= rho_min;
                   const auto level = static_cast<float>(stays ? std::max(full->density, rho_min) : full->density);
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
