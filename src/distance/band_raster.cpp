#include "distance/band_raster.h"

#include <cmath>
#include <vector>

namespace tetsoup {
namespace {

constexpr int kSlab = 4;  ///< Layers of voxels that one task owns.

struct IndexRange {
  int begin, end;
};

/// Voxels of [0, size) within `band` of [lo, hi].
IndexRange reach(float lo, float hi, float band, int size) {
  return {std::max(0, static_cast<int>(std::ceil(lo - band))),
          std::min(size, static_cast<int>(std::floor(hi + band)) + 1)};
}

struct Extent {
  Vec3 lo, hi;
};

Extent extent_of(const kernel::TrianglePlan& t) {
  const auto& [a, b, c] = t.corner;
  return {{std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y}), std::min({a.z, b.z, c.z})},
          {std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y}), std::max({a.z, b.z, c.z})}};
}

/// Part of `x` where the row (., y, z) is within `band` of the triangle's plane, so that a large slanted triangle
/// touches its neighbourhood only and not its whole box. A voxel of slack absorbs rounding.
IndexRange near_plane(const kernel::TrianglePlan& t, int y, int z, float band, IndexRange x) {
  const Vec3& n = t.normal;
  constexpr float kFlat = 0.02F;  // a steeper plane cuts less than a fiftieth off the row
  const Vec3& a = t.corner[0];
  const float rest = (static_cast<float>(y) - a.y) * n.y + (static_cast<float>(z) - a.z) * n.z;
  if (std::abs(n.x) < kFlat) {
    const auto height = [&](int at) { return rest + n.x * (static_cast<float>(at) - a.x); };
    const float lowest = std::min(height(x.begin), height(x.end)), highest = std::max(height(x.begin), height(x.end));
    return lowest > band + 1 || highest < -band - 1 ? IndexRange{0, 0} : x;
  }
  const float centre = a.x - rest / n.x, half = (band + 1) / std::abs(n.x);
  const auto limit = [&](float v) { return std::clamp(v, -1.0F, 1e9F); };
  return {std::max(x.begin, static_cast<int>(limit(centre - half))),
          std::min(x.end, static_cast<int>(limit(centre + half)) + 2)};
}

/// Ball around a triangle: cuts the corners off the box around a small one.
struct Ball {
  Vec3 centre;
  float radius_squared;
};

Ball ball_around(const Extent& box, float band) {
  const Vec3 half{(box.hi.x - box.lo.x) / 2, (box.hi.y - box.lo.y) / 2, (box.hi.z - box.lo.z) / 2};
  const float radius = std::sqrt(half.x * half.x + half.y * half.y + half.z * half.z) + band + 0.01F;
  return {{box.lo.x + half.x, box.lo.y + half.y, box.lo.z + half.z}, radius * radius};
}

IndexRange within_ball(const Ball& ball, int y, int z, IndexRange x) {
  const float dy = static_cast<float>(y) - ball.centre.y, dz = static_cast<float>(z) - ball.centre.z;
  const float rest = ball.radius_squared - dy * dy - dz * dz;
  if (rest < 0) return {0, 0};
  const float half = std::sqrt(rest);
  return {std::max(x.begin, static_cast<int>(std::ceil(ball.centre.x - half))),
          std::min(x.end, static_cast<int>(std::floor(ball.centre.x + half)) + 1)};
}

void raster_triangle(const kernel::TrianglePlan& t, float band, IndexRange layers, Grid<float>& squares) {
  constexpr int kLongRow = 12;  // voxels; shorter ones are not worth asking for the plane
  const Extent box = extent_of(t);
  const Ball ball = ball_around(box, band);
  const IndexRange xs = reach(box.lo.x, box.hi.x, band, squares.frame.size[0]);
  const IndexRange ys = reach(box.lo.y, box.hi.y, band, squares.frame.size[1]);
  IndexRange zs = reach(box.lo.z, box.hi.z, band, squares.frame.size[2]);
  zs = {std::max(zs.begin, layers.begin), std::min(zs.end, layers.end)};
  for (int z = zs.begin; z < zs.end; ++z) {
    for (int y = ys.begin; y < ys.end; ++y) {
      IndexRange x = within_ball(ball, y, z, xs);
      if (x.end - x.begin > kLongRow) x = near_plane(t, y, z, band, x);
      if (x.begin >= x.end) continue;
      float* values = squares.values.data() + squares.index(x.begin, y, z);
      kernel::lower_row(t, x.begin, y, z, {values, static_cast<std::size_t>(x.end - x.begin)});
    }
  }
}

/// Which triangles reach into each slab.
std::vector<std::vector<std::uint32_t>> bin_by_slab(std::span<const kernel::TrianglePlan> triangles, float band,
                                                    int nz) {
  std::vector<std::vector<std::uint32_t>> bins(static_cast<std::size_t>((nz + kSlab - 1) / kSlab));
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const Extent box = extent_of(triangles[i]);
    const IndexRange z = reach(box.lo.z, box.hi.z, band, nz);
    for (int slab = z.begin / kSlab; slab * kSlab < z.end; ++slab)
      bins[static_cast<std::size_t>(slab)].push_back(static_cast<std::uint32_t>(i));
  }
  return bins;
}

}  // namespace

RasterWork estimate_work(std::span<const kernel::TrianglePlan> triangles, float band_voxels) {
  RasterWork work;
  for (const kernel::TrianglePlan& t : triangles) {
    const Extent box = extent_of(t);
    const double x = box.hi.x - box.lo.x, y = box.hi.y - box.lo.y, z = box.hi.z - box.lo.z, reach_out = 2 * band_voxels;
    const double nx = std::abs(t.normal.x), ny = std::abs(t.normal.y), nz = std::abs(t.normal.z);
    const double whole = (x + reach_out) * (y + reach_out) * (z + reach_out);
    double slab = whole;  // what is near the plane: its shadow along the steepest axis, as thick as the band is there
    if (nx >= ny && nx >= nz && nx > 0)
      slab = (y + reach_out) * (z + reach_out) * (reach_out + 2) / nx;
    else if (ny >= nz && ny > 0)
      slab = (x + reach_out) * (z + reach_out) * (reach_out + 2) / ny;
    else if (nz > 0)
      slab = (x + reach_out) * (y + reach_out) * (reach_out + 2) / nz;
    work.looks += std::min(whole, slab);
    work.box_voxels += x * y * z;
  }
  return work;
}

void raster_band(std::span<const kernel::TrianglePlan> triangles, float band_voxels, Grid<float>& squares,
                 StageWatch& watch) {
  const int nz = squares.frame.size[2];
  const auto bins = bin_by_slab(triangles, band_voxels, nz);
  const auto layer = static_cast<std::size_t>(squares.frame.size[0]) * static_cast<std::size_t>(squares.frame.size[1]);
  parallel_for(static_cast<std::int64_t>(bins.size()), 1, watch, [&](std::int64_t slab, std::int64_t) {
    const IndexRange layers{static_cast<int>(slab) * kSlab, std::min(nz, (static_cast<int>(slab) + 1) * kSlab)};
    std::fill(squares.values.begin() + static_cast<std::ptrdiff_t>(layer) * layers.begin,
              squares.values.begin() + static_cast<std::ptrdiff_t>(layer) * layers.end, 1e30F);
    std::size_t count = 0;
    for (const std::uint32_t i : bins[static_cast<std::size_t>(slab)]) {
      raster_triangle(triangles[i], band_voxels, layers, squares);
      if (++count % 256 == 0) watch.poll();
      if (watch.stopped()) return;
    }
  });
}

}  // namespace tetsoup
