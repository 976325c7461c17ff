#include "kernel/brick_query.h"

#include <algorithm>
#include <array>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernel/brick_query.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace tetsoup::kernel::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t kLayer = kBrick * kBrick;
/// A node is skipped only if it is farther than the best by more than rounding, so that no nearest is lost.
constexpr float kSlack = 1.0F + 0x1p-14F;
using Lanes = hn::CappedTag<float, 16>;
using Floats = hn::Vec<Lanes>;

Floats set(float v) {
  return hn::Set(Lanes(), v);
}
Floats squared(Floats v) {
  return hn::Mul(v, v);
}
/// Distance of v to the interval, 0 within.
Floats outside(Floats v, float lo, float hi) {
  return hn::Max(hn::Max(hn::Sub(set(lo), v), hn::Sub(v, set(hi))), set(0));
}
float outside(float v, float lo, float hi) {
  return std::max(std::max(lo - v, v - hi), 0.0F);
}

/// The layers of a brick have their x and y in common.
class Brick {
 public:
  Brick(const PointTreeView& tree, int x0, int y0, int z0, float* squares) : tree_(tree), squares_(squares) {
    for (std::size_t i = 0; i < kLayer; ++i) {
      x_[i] = static_cast<float>(x0 + static_cast<int>(i) % kBrick);
      y_[i] = static_cast<float>(y0 + static_cast<int>(i) / kBrick);
    }
    for (std::size_t i = 0; i < kBrick; ++i) z_[i] = static_cast<float>(z0 + static_cast<int>(i));
  }

  void run(std::uint32_t& hint) {
    ask_leaf(hint);
    std::array<std::uint32_t, kPointTreeDepth> stack;
    std::size_t depth = 0;
    stack[depth++] = 0;
    while (depth > 0) {
      const std::uint32_t at = stack[--depth];
      const PointNode& node = tree_.nodes[at];
      if (!may_hold_nearest(node)) continue;
      if (node.count > 0) {
        if (ask_leaf(at)) hint = at;
        continue;
      }
      const bool swap = from_centre(tree_.nodes[node.next]) < from_centre(tree_.nodes[at + 1]);
      stack[depth++] = swap ? at + 1 : node.next;
      stack[depth++] = swap ? node.next : at + 1;
    }
  }

 private:
  float from_centre(const PointNode& n) const {
    constexpr float kHalf = (kBrick - 1) * 0.5F;
    const float dx = outside(x_[0] + kHalf, n.lo.x, n.hi.x), dy = outside(y_[0] + kHalf, n.lo.y, n.hi.y),
                dz = outside(z_[0] + kHalf, n.lo.z, n.hi.z);
    return dx * dx + dy * dy + dz * dz;
  }

  /// Whether some voxel is as near to the node as to the best point so far.
  bool may_hold_nearest(const PointNode& n) const {
    const Lanes d;
    std::array<float, kBrick> dz;
    for (std::size_t k = 0; k < kBrick; ++k) dz[k] = outside(z_[k], n.lo.z, n.hi.z);
    for (std::size_t i = 0; i < kLayer; i += hn::Lanes(d)) {
      const Floats xy = hn::Add(squared(outside(hn::Load(d, x_ + i), n.lo.x, n.hi.x)),
                                squared(outside(hn::Load(d, y_ + i), n.lo.y, n.hi.y)));
      Floats most = set(0);  // by how much the node is nearer
      for (std::size_t k = 0; k < kBrick; ++k) {
        const Floats best = hn::Mul(hn::LoadU(d, squares_ + k * kLayer + i), set(kSlack));
        most = hn::Max(most, hn::Sub(best, hn::Add(xy, set(dz[k] * dz[k]))));
      }
      if (!hn::AllTrue(d, hn::Eq(most, set(0)))) return true;
    }
    return false;
  }

  /// Whether a point of the leaf is the nearest so far to some voxel.
  bool ask_leaf(std::uint32_t leaf) {
    const Lanes d;
    const std::span points = tree_.points.subspan(tree_.nodes[leaf].next, tree_.nodes[leaf].count);
    bool nearer = false;
    for (std::size_t i = 0; i < kLayer; i += hn::Lanes(d))
      for (std::size_t k = 0; k < kBrick; k += 4) nearer |= ask_four_layers(points, i, k);
    return nearer;
  }

  /// The voxels from `i` on of the layers from `k` on.
  bool ask_four_layers(std::span<const Vec3> points, std::size_t i, std::size_t k) {
    const Lanes d;
    const Floats x = hn::Load(d, x_ + i), y = hn::Load(d, y_ + i);
    float* at = squares_ + k * kLayer + i;
    const float* z = z_.data() + k;
    const Floats before0 = hn::LoadU(d, at), before1 = hn::LoadU(d, at + kLayer),
                 before2 = hn::LoadU(d, at + 2 * kLayer), before3 = hn::LoadU(d, at + 3 * kLayer);
    Floats best0 = before0, best1 = before1, best2 = before2, best3 = before3;
    for (const Vec3& p : points) {
      const Floats xy = hn::Add(squared(hn::Sub(x, set(p.x))), squared(hn::Sub(y, set(p.y))));
      const auto with = [&](float layer) { return hn::Add(xy, set((layer - p.z) * (layer - p.z))); };
      best0 = hn::Min(best0, with(z[0]));
      best1 = hn::Min(best1, with(z[1]));
      best2 = hn::Min(best2, with(z[2]));
      best3 = hn::Min(best3, with(z[3]));
    }
    hn::StoreU(best0, d, at);
    hn::StoreU(best1, d, at + kLayer);
    hn::StoreU(best2, d, at + 2 * kLayer);
    hn::StoreU(best3, d, at + 3 * kLayer);
    return !hn::AllFalse(d, hn::Or(hn::Or(hn::Lt(best0, before0), hn::Lt(best1, before1)),
                                   hn::Or(hn::Lt(best2, before2), hn::Lt(best3, before3))));
  }

  const PointTreeView& tree_;
  float* squares_;
  alignas(64) float x_[kLayer], y_[kLayer];
  std::array<float, kBrick> z_;
};

void lower_brick(const PointTreeView& tree, int x0, int y0, int z0, BrickSquares squares, std::uint32_t& hint) {
  Brick(tree, x0, y0, z0, squares.data()).run(hint);
}

}  // namespace tetsoup::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tetsoup::kernel {

HWY_EXPORT(lower_brick);

void lower_brick(const PointTreeView& tree, int x0, int y0, int z0, BrickSquares squares, std::uint32_t& hint) {
  HWY_DYNAMIC_DISPATCH(lower_brick)(tree, x0, y0, z0, squares, hint);
}

}  // namespace tetsoup::kernel
#endif
