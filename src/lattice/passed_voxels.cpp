#include "lattice/passed_voxels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/vec.h"
#include "base/whole.h"

namespace tetsoup {
namespace {

/// Voxels between points on a triangle: the voxels of two neighbouring points touch, so a triangle hangs together.
constexpr double kSpacing = 1;

void set_voxel(BitGrid& grid, const Vec3d& at) {
  const int x = floor_to_int(at.x), y = floor_to_int(at.y), z = floor_to_int(at.z);
  if (!grid.frame.contains(x, y, z)) return;
  grid.words[grid.row(y, z) + static_cast<std::size_t>(x >> 6)] |= std::uint64_t{1} << (x & 63);
}

/// Points at most kSpacing apart, but for the corners.
void draw_triangle(BitGrid& grid, const std::array<Vec3d, 3>& p) {
  const Vec3d u = p[1] - p[0], v = p[2] - p[0];
  const double longest = std::max({squared_length(u), squared_length(v), squared_length(p[2] - p[1])});
  if (longest <= kSpacing * kSpacing) return;
  const int n = ceil_to_int(std::sqrt(longest) / kSpacing);
  for (int i = 0; i <= n; ++i)
    for (int j = 0; i + j <= n; ++j)
      set_voxel(grid, p[0] + u * (static_cast<double>(i) / n) + v * (static_cast<double>(j) / n));
}

}  // namespace

BitGrid passed_voxels(const BitGrid& inside, const CleanSoup& soup, StageWatch& watch) {
  BitGrid grid = inside;
  std::vector<Vec3d> points;
  points.reserve(soup.soup.vertices.size());
  for (const Vec3& v : soup.soup.vertices) {
    points.push_back((to_double(v) - grid.frame.origin) * (1 / grid.frame.voxel_size) + Vec3d{0.5, 0.5, 0.5});
    set_voxel(grid, points.back());
  }
  std::size_t done = 0;
  for (const Triangle& t : soup.soup.triangles) {
    draw_triangle(grid, {points[t[0]], points[t[1]], points[t[2]]});
    if (++done % 1024 == 0) watch.poll();
  }
  watch.throw_if_stopped();
  return grid;
}

void add_passed(const FilledCells& passed, std::size_t tets_per_cell, FilledCells& filled) {
  FilledCells all;
  all.cells = passed.cells;
  all.passed = passed.densities;
  all.densities.assign(passed.densities.size(), 0);
  all.kept_tets = filled.kept_tets;
  all.sampled_tets = filled.sampled_tets;
  std::size_t next = 0;
  for (std::size_t c = 0; c < all.cells.size(); ++c) {
    all.cells[c].kept = 0;
    if (next == filled.cells.size() || filled.cells[next].cell != all.cells[c].cell) continue;
    all.cells[c].kept = filled.cells[next].kept;
    std::copy_n(filled.densities.begin() + static_cast<std::ptrdiff_t>(next * tets_per_cell), tets_per_cell,
                all.densities.begin() + static_cast<std::ptrdiff_t>(c * tets_per_cell));
    ++next;
  }
  filled = std::move(all);
}

}  // namespace tetsoup
