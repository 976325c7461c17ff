#include "lattice/body_voxels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "base/bits.h"
#include "base/vec.h"
#include "base/whole.h"
#include "lattice/voxel_parts.h"

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

/// Adds the parts of the inside that the soup joins with a larger one: a bar of a voxel's thickness is a row of dashes.
void add_lesser_parts(BitGrid& grid, const BitGrid& inside, const BitGrid& surface, StageWatch& watch) {
  const VoxelParts parts(inside, watch);
  if (parts.count() < 2) return;
  BitGrid both = inside;
  for (std::size_t w = 0; w < both.words.size(); ++w) both.words[w] |= surface.words[w];
  const VoxelParts wholes(both, watch);
  std::map<std::uint32_t, std::size_t> voxels;
  std::map<std::uint32_t, std::uint32_t> largest, whole_of;
  parts.visit([&](const VoxelRun& run) { voxels[run.part] += static_cast<std::size_t>(run.end - run.begin); });
  parts.visit([&](const VoxelRun& run) {
    const std::uint32_t whole = whole_of[run.part] = wholes.at(run.begin, run.y, run.z);
    const auto found = largest.try_emplace(whole, run.part).first;
    if (voxels[run.part] > voxels[found->second]) found->second = run.part;
  });
  parts.visit([&](const VoxelRun& run) {
    if (largest[whole_of[run.part]] == run.part) return;
    for (int x = run.begin; x < run.end; ++x)
      grid.words[grid.row(run.y, run.z) + static_cast<std::size_t>(x >> 6)] |= std::uint64_t{1} << (x & 63);
  });
}

}  // namespace

BitGrid soup_voxels(const GridFrame& frame, const CleanSoup& soup, StageWatch& watch) {
  BitGrid grid = make_bit_grid(frame);
  std::vector<Vec3d> points;
  points.reserve(soup.soup.vertices.size());
  for (const Vec3& v : soup.soup.vertices) {
    points.push_back((to_double(v) - frame.origin) * (1 / frame.voxel_size) + Vec3d{0.5, 0.5, 0.5});
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

BitGrid body_voxels(const BitGrid& inside, const CleanSoup& soup, StageWatch& watch) {
  const BitGrid surface = soup_voxels(inside.frame, soup, watch);
  const auto& size = inside.frame.size;
  /// Adds to every word of the grid the voxels of the surface that body(y, z, word) names.
  const auto add_surface = [&](BitGrid& grid, const auto& where) {
    parallel_for(size[2], 1, watch, [&](std::int64_t layer, std::int64_t) {
      const int z = static_cast<int>(layer);
      for (int y = 0; y < size[1]; ++y) {
        const std::size_t row = inside.row(y, z);
        for (std::size_t w = 0; w < inside.words_per_row; ++w)
          if (surface.words[row + w] != 0) grid.words[row + w] |= surface.words[row + w] & where(y, z, w);
      }
    });
  };
  BitGrid bare = make_bit_grid(inside.frame), body = inside;
  const BitRows inside_rows(inside), bare_rows(bare);
  add_surface(bare, [&](int y, int z, std::size_t w) { return ~inside_rows.grown(y, z, w); });
  add_lesser_parts(bare, inside, surface, watch);
  // With those around, so that what is bare hangs together with the volume beside it.
  add_surface(body, [&](int y, int z, std::size_t w) { return bare_rows.grown(y, z, w); });
  return body;
}

}  // namespace tetsoup
