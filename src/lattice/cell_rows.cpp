#include "lattice/cell_rows.h"

#include <cmath>

#include "base/bits.h"

namespace tetsoup {
namespace {

/// In cells: what is farther from a face than this lies on the side that the formula says. Cell coordinates are below
/// some 1e6, so that rounding moves them by about 1e-10.
constexpr double kUnsure = 1e-7;
constexpr double kRounding = 1e-9;  ///< Voxels, of a crossing.
constexpr double kParallel = 1e-6;  ///< In cells a voxel: below, a row has no crossing worth the name.

Vec3d local_to(const Cell& cell, const Vec3d& p) {
  return {p.x - cell[0], p.y - cell[1], p.z - cell[2]};
}

bool is_in(const Vec3d& p, const Cell& cell, std::size_t axis) {
  const double coordinate = axis == 0 ? p.x : axis == 1 ? p.y : p.z;
  return coordinate >= cell[axis] && coordinate < cell[axis] + 1;
}

/// The first voxel beyond a crossing that lies at a voxel but for rounding, as `holds` has it. `beyond` is what the
/// formula says, `rest` how far before it the crossing lies.
template <class Holds>
int settled(int beyond, double rest, bool rises, const Holds& holds) {
  const int near = rest < 0.5 ? beyond - 1 : beyond;
  return near + static_cast<int>(holds(near) != rises);
}

}  // namespace

CellRows::CellRows(const InsideBlocks& inside, const LatticeFrame& frame) : inside_(inside) {
  const GridFrame& grid = inside.bits().frame;
  first_ = frame.to_cell(grid.origin);
  for (std::size_t i = 0; i < 3; ++i) {
    Vec3d along;
    (i == 0 ? along.x : i == 1 ? along.y : along.z) = grid.voxel_size;
    step_[i] = frame.to_cell(grid.origin + along) - first_;
  }
  aligned_ = step_[0].y == 0 && step_[0].z == 0 && step_[1].x == 0 && step_[2].x == 0;
  cell_faces_ = {{{half_space({1, 0, 0}, 0), half_space({-1, 0, 0}, 1)},
                  {half_space({0, 1, 0}, 0), half_space({0, -1, 0}, 1)},
                  {half_space({0, 0, 1}, 0), half_space({0, 0, -1}, 1)}}};
  // The conditions of owner_tet(); in odd cells with 1 - x for x.
  corner_tets_[0] = corner_tets(
      {half_space({1, -1, -1}, 0), half_space({-1, 1, -1}, 0), half_space({-1, -1, 1}, 0), half_space({1, 1, 1}, -2)});
  corner_tets_[1] = corner_tets({half_space({-1, -1, -1}, 1), half_space({1, 1, -1}, -1), half_space({1, -1, 1}, -1),
                                 half_space({-1, 1, 1}, -1)});
}

CellRows::HalfSpace CellRows::half_space(const Vec3d& normal, double offset) const {
  const double slope = dot(normal, step_[0]);
  const bool is_parallel = std::abs(slope) < kParallel;
  return {normal, offset, slope, 1 / slope, is_parallel ? 1 : kUnsure / std::abs(slope) + kRounding};
}

CellRows::CornerTets CellRows::corner_tets(const std::array<HalfSpace, kCorners>& half) const {
  CornerTets tets{half, {}, {}, {}, {}, {}, {}};
  for (std::size_t i = 0; i < kCorners; ++i) {
    tets.x[i] = half[i].normal.x;
    tets.y[i] = half[i].normal.y;
    tets.z[i] = half[i].normal.z;
    tets.offset[i] = half[i].offset;
    tets.inverse[i] = half[i].inverse;
    tets.reach[i] = half[i].reach;
  }
  return tets;
}

TetCounts CellRows::count(const Cell& cell, const VoxelRange& range) const {
  TetCounts counts;
  Run run_of_all{range.begin[0], range.end[0]};
  if (aligned_) narrow_to_cell(cell, first_, 0, run_of_all);
  for (int z = range.begin[2]; z < range.end[2]; ++z) {
    for (int y = range.begin[1]; y < range.end[1]; ++y) {
      const Row row{first_ + step_[1] * y + step_[2] * z, y, z};
      Run run = run_of_all;
      bool is_sure = true;
      if (aligned_) {
        if (!is_in(row.at_zero, cell, 1) || !is_in(row.at_zero, cell, 2)) continue;
      } else {
        for (const std::size_t axis : {2U, 1U, 0U})
          is_sure = is_sure && (run.begin == run.end || narrow_to_cell(cell, row.at_zero, axis, run));
      }
      if (run.begin == run.end) continue;
      if (!is_sure || !count_row(cell, row, run, counts)) count_one_by_one(cell, row, range, counts);
    }
  }
  return counts;
}

/// To the voxels in the half space; `holds` tells about a voxel where rounding decides. False if it decides about more.
template <class Holds>
bool CellRows::narrow(const HalfSpace& half, const Vec3d& at_zero, Run& run, const Holds& holds) {
  const double sum = dot(half.normal, at_zero) + half.offset;
  if (std::abs(half.slope) < kParallel) {
    const double first = sum + half.slope * run.begin, last = sum + half.slope * run.end;
    if (std::min(first, last) > kUnsure) return true;
    if (std::max(first, last) >= -kUnsure) return false;
    run.end = run.begin;
    return true;
  }
  // Counted from the voxel before the run, so that the whole part is the number of voxels up to the crossing.
  const double way = std::clamp(-sum * half.inverse - (run.begin - 1), 0.5, run.end - run.begin + 0.5);
  const int whole = static_cast<int>(way);
  const double rest = way - whole;
  int beyond = run.begin + whole;
  if (rest < half.reach || rest > 1 - half.reach) beyond = settled(beyond, rest, half.slope > 0, holds);
  (half.slope > 0 ? run.begin : run.end) = std::clamp(beyond, run.begin, run.end);
  return true;
}

/// The same for the four corner tets at once: arithmetic on four numbers without a branch, for the compiler to do with
/// vectors, and then what rounding decides.
template <class Holds>
bool CellRows::narrow_to_corners(const CornerTets& tets, const Vec3d& at_zero, const Run& run, CornerRuns& runs,
                                 const Holds& holds) {
  const double before = run.begin - 1, most = run.end - run.begin + 0.5;
  std::array<double, kCorners> way, rest, off;
  std::array<int, kCorners> beyond;
  for (std::size_t i = 0; i < kCorners; ++i) {
    const double sum = tets.x[i] * at_zero.x + tets.y[i] * at_zero.y + tets.z[i] * at_zero.z + tets.offset[i];
    way[i] = std::min(std::max(-sum * tets.inverse[i] - before, 0.5), most);
  }
  for (std::size_t i = 0; i < kCorners; ++i) beyond[i] = static_cast<int>(way[i]);
  for (std::size_t i = 0; i < kCorners; ++i) rest[i] = way[i] - beyond[i];
  for (std::size_t i = 0; i < kCorners; ++i) off[i] = std::abs(rest[i] - 0.5) + tets.reach[i];
  for (std::size_t i = 0; i < kCorners; ++i) beyond[i] += run.begin;
  for (std::size_t i = 0; i < kCorners; ++i) {
    const auto holds_i = [&](int x) { return holds(i, x); };
    if (tets.reach[i] >= 0.5) {
      runs[i] = run;
      if (!narrow(tets.half[i], at_zero, runs[i], holds_i)) return false;
      continue;
    }
    if (off[i] >= 0.5)
      beyond[i] = std::clamp(settled(beyond[i], rest[i], tets.half[i].slope > 0, holds_i), run.begin, run.end);
    runs[i] = tets.half[i].slope > 0 ? Run{beyond[i], run.end} : Run{run.begin, beyond[i]};
  }
  return true;
}

bool CellRows::narrow_to_cell(const Cell& cell, const Vec3d& at_zero, std::size_t axis, Run& run) const {
  const Vec3d local = local_to(cell, at_zero);
  const auto holds = [&](int x) { return is_in(point(at_zero, x), cell, axis); };
  return narrow(cell_faces_[axis][0], local, run, holds) && narrow(cell_faces_[axis][1], local, run, holds);
}

/// The voxels of the run are in the cell. False, and nothing counted, if rounding decides about several.
bool CellRows::count_row(const Cell& cell, const Row& row, const Run& run, TetCounts& counts) const {
  const bool odd = is_odd(cell);
  const CornerTets& tets = corner_tets_[odd];
  const Vec3d local = local_to(cell, row.at_zero);
  CornerRuns runs;
  const auto holds = [&](std::size_t corner, int x) {
    return owner_tet(local_to(cell, point(row.at_zero, x)), odd) == corner + 1;
  };
  if (!narrow_to_corners(tets, local, run, runs, holds)) return false;
  count_runs(row, run, runs, counts);
  return true;
}

void CellRows::count_runs(const Row& row, const Run& run, const CornerRuns& runs, TetCounts& counts) const {
  constexpr int kWord = 64;
  const auto first_bits = [](int n) { return n == kWord ? ~std::uint64_t{0} : (std::uint64_t{1} << n) - 1; };
  for (int begin = run.begin; begin < run.end; begin += kWord) {
    const int end = std::min(run.end, begin + kWord);
    const std::uint64_t word = inside_.word(begin, end, row.y, row.z);
    counts.inside[0] += bit_count(word);
    if (word == 0) continue;
    const bool all_inside = word == first_bits(end - begin);
    for (std::size_t i = 0; i < kCorners; ++i) {
      const int from = std::clamp(runs[i].begin, begin, end) - begin, to = std::clamp(runs[i].end, begin, end) - begin;
      const std::size_t in =
          all_inside ? static_cast<std::size_t>(to - from) : bit_count(word & first_bits(to) & ~first_bits(from));
      counts.inside[0] -= in;
      counts.inside[i + 1] += in;
    }
  }
  counts.total[0] += static_cast<std::size_t>(run.end - run.begin);
  for (std::size_t i = 0; i < kCorners; ++i) {
    const auto total = static_cast<std::size_t>(runs[i].end - runs[i].begin);
    counts.total[0] -= total;
    counts.total[i + 1] += total;
  }
}

void CellRows::count_one_by_one(const Cell& cell, const Row& row, const VoxelRange& range, TetCounts& counts) const {
  for (int x = range.begin[0]; x < range.end[0]; ++x) {
    const Vec3d p = point(row.at_zero, x);
    if (!is_in(p, cell, 0) || !is_in(p, cell, 1) || !is_in(p, cell, 2)) continue;
    const std::size_t tet = owner_tet(local_to(cell, p), is_odd(cell));
    ++counts.total[tet];
    counts.inside[tet] += inside_.word(x, x + 1, row.y, row.z);
  }
}

}  // namespace tetsoup
