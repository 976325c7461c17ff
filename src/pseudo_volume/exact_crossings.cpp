#include "pseudo_volume/exact_crossings.h"

#include <algorithm>

#include "base/bits.h"
#include "base/vec.h"
#include "kernel/event_masks.h"
#include "pseudo_volume/crossings.h"

namespace tetsoup {
namespace {

/// Voxels beyond the band of a rim within which events decide: a crossing that the band's own voxels raise lies less
/// than a step away from them.
constexpr double kBeyondRim = 0.9;
/// Voxels: a step of sqrt(3) voxels that crosses the soup begins nearer to it than this.
constexpr double kStepReach = 1.8;

struct Axis {
  int dx, dy, dz;
};

Axis axis_of(std::size_t plane) {
  if (plane == 12) return {1, 0, 0};
  const auto [dy, dz] = kernel::kSheetSteps[plane / 3];
  return {static_cast<int>(plane % 3) - 1, dy, dz};
}

/// Notes the crossings of one axis: its lines are whole numbers (u, v), its voxels follow each other along x, y or z.
class PlaneMarker {
 public:
  PlaneMarker(const Axis& axis, BitGrid& bits) : axis_(axis), bits_(bits), frame_(bits.frame) {}

  void mark(const TriangleSoup& soup, const Triangle& t) const {
    constexpr int kAnywhere = 1 << 29;
    cross_lines({seen(soup.vertices[t[0]]), seen(soup.vertices[t[1]]), seen(soup.vertices[t[2]])}, -kAnywhere,
                kAnywhere, [&](int u, int v, int first, int) { flip(u, v, first - 1); });
  }

 private:
  SeenCorner seen(const Vec3& p) const {
    const Vec3d at = (to_double(p) - frame_.origin) * (1 / frame_.voxel_size);
    if (axis_.dz != 0) return {at.x - axis_.dx * at.z, at.y - axis_.dy * at.z, at.z};
    if (axis_.dy != 0) return {at.x - axis_.dx * at.y, at.z, at.y};
    return {at.y, at.z, at.x};
  }
  void flip(int u, int v, int t) const {
    int x = t, y = u, z = v;
    if (axis_.dz != 0) {
      x = u + axis_.dx * t, y = v + axis_.dy * t, z = t;
    } else if (axis_.dy != 0) {
      x = u + axis_.dx * t, y = t, z = v;
    }
    if (frame_.contains(x, y, z))
      bits_.words[bits_.row(y, z) + static_cast<std::size_t>(x / 64)] ^= std::uint64_t{1} << (x % 64);
  }

  Axis axis_;
  BitGrid& bits_;
  const GridFrame& frame_;
};

/// Takes out the steps between two unsound voxels.
void drop_unsound_steps(const Axis& axis, const BitGrid& unsound, BitGrid& plane) {
  const BitRows rows(unsound);
  const std::size_t words = plane.words_per_row;
  for (int z = 0; z < plane.frame.size[2]; ++z) {
    for (int y = 0; y < plane.frame.size[1]; ++y) {
      const std::uint64_t* next = rows.at(y + axis.dy, z + axis.dz);
      if (next == nullptr) continue;
      std::uint64_t* here = plane.words.data() + plane.row(y, z);
      const std::uint64_t* from = unsound.words.data() + plane.row(y, z);
      for (std::size_t w = 0; w < words; ++w) {
        if ((here[w] & from[w]) == 0) continue;
        const std::uint64_t to = axis.dx == 0  ? next[w]
                                 : axis.dx > 0 ? shifted_down(next, w, words)
                                               : shifted_up(next, w);
        here[w] &= ~(from[w] & to);
      }
    }
  }
}

}  // namespace

CrossingPlanes find_crossings(const TriangleSoup& soup, const GridFrame& frame, StageWatch& watch) {
  CrossingPlanes planes;
  parallel_for(static_cast<std::int64_t>(planes.size()), 1, watch, [&](std::int64_t begin, std::int64_t end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      planes[i] = make_bit_grid(frame);
      const PlaneMarker marker(axis_of(i), planes[i]);
      for (const Triangle& t : soup.triangles) marker.mark(soup, t);
    }
  });
  return planes;
}

ExactCrossings exact_for_band(const CrossingPlanes& planes, const BlockGrid& rims, const BlockGrid& soup,
                              double band_voxels, StageWatch& watch) {
  const auto length = [&](double voxels) { return static_cast<float>(voxels * soup.frame.voxel_size); };
  ExactCrossings exact{planes, find_band(rims, length(band_voxels + kBeyondRim), watch).bits,
                       find_band(soup, length(std::max(band_voxels, kStepReach)), watch)};
  parallel_for(static_cast<std::int64_t>(planes.size()), 1, watch, [&](std::int64_t begin, std::int64_t end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i)
      drop_unsound_steps(axis_of(i), exact.unsound, exact.planes[i]);
  });
  return exact;
}

}  // namespace tetsoup
