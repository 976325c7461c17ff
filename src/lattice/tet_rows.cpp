#include "lattice/tet_rows.h"

#include <cmath>
#include <numeric>

#include "base/bits.h"
#include "base/whole.h"

namespace tetsoup {
namespace {

constexpr std::int64_t kOne = std::int64_t{1} << 40;  ///< A cell. Shifts of 1e6 cells then leave room for the sums.

/// Below that a row is parallel to a face: it may cross it anywhere, and whole numbers find out. Above, the quotient
/// that tells where is exact to kUnsure: sums are below 2^57, so that 2^4 is lost of them.
constexpr std::int64_t kParallel = 256;
constexpr double kUnsure = 0.25;  ///< Voxels.

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

TetRows::TetRows(const InsideBlocks& inside, const LatticeFrame& frame, const LatticeTable& table)
    : inside_(inside), frame_(frame), table_(table) {
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
  HalfSpaces halves;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto corner = [&](std::size_t k) { return table.steps(tet[static_cast<std::size_t>(kTetFaces[i][k])]); };
    const auto n = face_normal(corner(0), corner(2), corner(1));  // inwards
    const Steps on_face = corner(0);
    halves.normal[i] = n;
    halves.offset[i] = -dot(n, {on_face[0], on_face[1], on_face[2]}) * (kOne / kStepsPerCell);
    const std::int64_t first_member = n[0] != 0 ? n[0] : n[1] != 0 ? n[1] : n[2];
    if (first_member < 0) halves.offset[i] -= 1;  // a point on the face belongs to the other side
    for (std::size_t axis = 0; axis < 3; ++axis) halves.step[axis][i] = dot(n, step_[axis]);
    const std::int64_t along_row = halves.step[0][i];
    halves.inverse[i] = std::abs(along_row) < kParallel ? 0 : 1 / static_cast<double>(along_row);
  }
  return halves;
}

/// The voxels of a row that lie in all half spaces; `at_zero` are the sums at its voxel 0. Floating point tells to a
/// fraction of a voxel where the row gets in and out, whole numbers decide.
TetRows::Run TetRows::narrowed(const HalfSpaces& halves, const Sums& at_zero, const Run& run) {
  double in = run.begin, out = run.end - 1;
  for (std::size_t i = 0; i < 4; ++i) {
    const double inverse = halves.inverse[i], crossing = -static_cast<double>(at_zero[i]) * inverse;
    in = std::max(in, inverse > 0 ? crossing : in);
    out = std::min(out, inverse < 0 ? crossing : out);
  }
  if (in - out > kUnsure) return {0, 0};
  const auto holds = [&](int x) {
    bool all = true;
    for (std::size_t i = 0; i < 4; ++i) all = all && at_zero[i] + halves.step[0][i] * x >= 0;
    return all;
  };
  int first = std::max(run.begin, ceil_to_int(in - kUnsure)), last = std::min(run.end - 1, floor_to_int(out + kUnsure));
  while (first <= last && !holds(first)) ++first;
  while (first <= last && !holds(last)) --last;
  return {first, last + 1};
}

VoxelCount TetRows::count(const Cell& cell, std::size_t tet, const VoxelRange& range) const {
  Fixed at = first_;  // of voxel (0, 0, 0), relative to the cell
  for (std::size_t i = 0; i < 3; ++i) at[i] -= cell[i] * kOne;
  const HalfSpaces& halves = half_spaces_[is_odd(cell)][tet];
  const TetCorners corners = corners_in_voxels(cell, tet);
  VoxelCount count;
  for (int z = range.begin[2]; z < range.end[2]; ++z) {
    const auto [low, high] = slice(corners, z);
    const int begin = std::max(range.begin[1], low), end = std::min(range.end[1], high);
    Sums at_zero;
    for (std::size_t i = 0; i < 4; ++i)
      at_zero[i] = dot(halves.normal[i], at) + halves.offset[i] + halves.step[1][i] * begin + halves.step[2][i] * z;
    for (int y = begin; y < end; ++y) {
      const Run run = narrowed(halves, at_zero, {range.begin[0], range.end[0]});
      for (std::size_t i = 0; i < 4; ++i) at_zero[i] += halves.step[1][i];
      if (run.begin >= run.end) continue;
      count.total += static_cast<std::size_t>(run.end - run.begin);
      count.inside += count_inside(run, y, z);
    }
  }
  return count;
}

TetCorners TetRows::corners_in_voxels(const Cell& cell, std::size_t tet) const {
  TetCorners corners = table_.corners(tet, is_odd(cell));
  for (Vec3d& p : corners) {
    p += Vec3d{static_cast<double>(cell[0]), static_cast<double>(cell[1]), static_cast<double>(cell[2])};
    p = (frame_.to_point(p) - inside_.bits().frame.origin) * (1 / inside_.bits().frame.voxel_size);
  }
  return corners;
}

/// The rows of a layer that a tet in voxel coordinates may reach. Floating point only has to miss none.
TetRows::Run TetRows::slice(const TetCorners& corners, int z) {
  constexpr double kTouching = 1e-6, kLevel = 1e-3;  // voxels; an edge within a layer is not cut but taken whole
  double low = 1e9, high = -1e9;
  const auto add = [&](double y) {
    low = std::min(low, y);
    high = std::max(high, y);
  };
  for (const auto& edge : kTetEdges) {
    const Vec3d a = corners[static_cast<std::size_t>(edge[0])], b = corners[static_cast<std::size_t>(edge[1])];
    if (z < std::min(a.z, b.z) - kTouching || z > std::max(a.z, b.z) + kTouching) continue;
    if (std::abs(b.z - a.z) < kLevel) {
      add(a.y);
      add(b.y);
    } else {
      add(a.y + std::clamp((z - a.z) / (b.z - a.z), 0.0, 1.0) * (b.y - a.y));
    }
  }
  return low > high ? Run{0, 0} : Run{ceil_to_int(low - kUnsure), floor_to_int(high + kUnsure) + 1};
}

std::size_t TetRows::count_inside(const Run& run, int y, int z) const {
  constexpr int kWord = 64;
  std::size_t sum = 0;
  for (int begin = run.begin; begin < run.end; begin += kWord)
    sum += bit_count(inside_.word(begin, std::min(run.end, begin + kWord), y, z));
  return sum;
}

}  // namespace tetsoup
