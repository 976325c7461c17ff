#include "lattice/tet_rows.h"

#include <cmath>
#include <numeric>

#include "base/bits.h"

namespace tetsoup {
namespace {

constexpr std::int64_t kOne = std::int64_t{1} << 40;  ///< A cell. Shifts of 1e6 cells then leave room for the sums.

std::int64_t to_fixed(double cells) {
  return std::llround(cells * static_cast<double>(kOne));
}

std::int64_t dot(const std::array<std::int64_t, 3>& a, const std::array<std::int64_t, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Normal of a face, towards where its corners are seen counter-clockwise; without a common factor.
std::array<std::int64_t, 3> face_normal(const Steps& a, const Steps& b, const Steps& c) {
  const auto u = [&](std::size_t i) { return std::int64_t{b[i] - a[i]}; };
  const auto v = [&](std::size_t i) { return std::int64_t{c[i] - a[i]}; };
  std::array<std::int64_t, 3> n{u(1) * v(2) - u(2) * v(1), u(2) * v(0) - u(0) * v(2), u(0) * v(1) - u(1) * v(0)};
  const std::int64_t factor = std::gcd(std::gcd(n[0], n[1]), n[2]);
  for (std::int64_t& member : n) member /= factor;
  return n;
}

}  // namespace

TetRows::TetRows(const InsideBlocks& inside, const LatticeFrame& frame, const LatticeTable& table) : inside_(inside) {
  const GridFrame& grid = inside.bits().frame;
  const auto fixed = [](const Vec3d& p) { return Fixed{to_fixed(p.x), to_fixed(p.y), to_fixed(p.z)}; };
  const Vec3d first = frame.to_cell(grid.origin);
  first_ = fixed(first);
  const double h = grid.voxel_size;
  const std::array<Vec3d, 3> along{{{h, 0, 0}, {0, h, 0}, {0, 0, h}}};
  for (std::size_t i = 0; i < 3; ++i) step_[i] = fixed(frame.to_cell(grid.origin + along[i]) - first);
  for (const bool odd : {false, true})
    for (std::size_t t = 0; t < table.tet_count; ++t) half_spaces_[odd][t] = half_spaces(table.tet(t, odd), table);
}

TetRows::HalfSpaces TetRows::half_spaces(const LatticeTet& tet, const LatticeTable& table) const {
  HalfSpaces all;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto corner = [&](std::size_t k) { return table.steps(tet[static_cast<std::size_t>(kTetFaces[i][k])]); };
    HalfSpace& half = all[i];
    half.normal = face_normal(corner(0), corner(2), corner(1));  // inwards
    const Steps on_face = corner(0);
    half.offset = -dot(half.normal, {on_face[0], on_face[1], on_face[2]}) * (kOne / kStepsPerCell);
    const auto first_member = half.normal[0] != 0   ? half.normal[0]
                              : half.normal[1] != 0 ? half.normal[1]
                                                    : half.normal[2];
    if (first_member < 0) half.offset -= 1;  // a point on the face belongs to the other side
    for (std::size_t axis = 0; axis < 3; ++axis) half.step[axis] = dot(half.normal, step_[axis]);
    half.inverse = half.step[0] == 0 ? 0 : 1 / static_cast<double>(half.step[0]);
  }
  return all;
}

/// To the voxels in the half space; `at_zero` is the sum at voxel 0 of the row.
bool TetRows::narrow(const HalfSpace& half, std::int64_t at_zero, Run& run) {
  const std::int64_t step = half.step[0];
  if (step == 0) return at_zero >= 0;
  // The first voxel beyond the crossing, but for the rounding of the quotient.
  const double way = -static_cast<double>(at_zero) * half.inverse;
  int beyond = static_cast<int>(std::min(std::max(way, run.begin - 1.0), run.end + 1.0));
  const auto holds = [&](int x) { return (at_zero + step * x >= 0) == (step > 0); };  // beyond is where this starts
  while (beyond > run.begin && holds(beyond - 1)) --beyond;
  while (beyond < run.end && !holds(beyond)) ++beyond;
  if (step > 0) {
    run.begin = std::max(run.begin, beyond);
  } else {
    run.end = std::min(run.end, beyond);
  }
  return run.begin < run.end;
}

VoxelCount TetRows::count(const Cell& cell, std::size_t tet, const VoxelRange& range) const {
  Fixed at = first_;  // of voxel (0, 0, 0), relative to the cell
  for (std::size_t i = 0; i < 3; ++i) at[i] -= cell[i] * kOne;
  const HalfSpaces& halves = half_spaces_[is_odd(cell)][tet];
  std::array<std::int64_t, 4> at_origin{};
  for (std::size_t i = 0; i < 4; ++i) at_origin[i] = dot(halves[i].normal, at) + halves[i].offset;
  VoxelCount count;
  for (int z = range.begin[2]; z < range.end[2]; ++z) {
    for (int y = range.begin[1]; y < range.end[1]; ++y) {
      Run run{range.begin[0], range.end[0]};
      bool any = true;
      for (std::size_t i = 0; i < 4 && any; ++i)
        any = narrow(halves[i], at_origin[i] + halves[i].step[1] * y + halves[i].step[2] * z, run);
      if (!any) continue;
      count.total += static_cast<std::size_t>(run.end - run.begin);
      count.inside += count_inside(run, y, z);
    }
  }
  return count;
}

std::size_t TetRows::count_inside(const Run& run, int y, int z) const {
  constexpr int kWord = 64;
  std::size_t sum = 0;
  for (int begin = run.begin; begin < run.end; begin += kWord)
    sum += bit_count(inside_.word(begin, std::min(run.end, begin + kWord), y, z));
  return sum;
}

}  // namespace tetsoup
