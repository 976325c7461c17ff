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

constexpr std::size_t kVoxels = kBrick * kBrick * kBrick;
/// A node is skipped only if it is farther than the best by more than rounding, so that no nearest is lost.
constexpr float kSlack = 1.0F + 0x1p-14F;
using Lanes = hn::CappedTag<float, 16>;
using Floats = hn::Vec<Lanes>;

Floats set(float v) {
  return hn::Set(Lanes(), v);
}

class Brick {
 public:
  Brick(const PointTreeView& tree, int x0, int y0, int z0, float* squares) : tree_(tree), squares_(squares) {
    for (std::size_t i = 0; i < kVoxels; ++i) {
      x_[i] = static_cast<float>(x0 + static_cast<int>(i) % kBrick);
      y_[i] = static_cast<float>(y0 + static_cast<int>(i) / kBrick % kBrick);
      z_[i] = static_cast<float>(z0 + static_cast<int>(i) / kBrick / kBrick);
    }
    constexpr float kHalf = (kBrick - 1) * 0.5F;
    centre_ = {x_[0] + kHalf, y_[0] + kHalf, z_[0] + kHalf};
  }

  void run(std::uint32_t& hint) {
    ask(hint, hint);
    std::array<std::uint32_t, kPointTreeDepth> stack;
    std::size_t depth = 0;
    stack[depth++] = 0;
    while (depth > 0) {
      const std::uint32_t at = stack[--depth];
      const PointNode& node = tree_.nodes[at];
      if (!may_hold_nearest(node)) continue;
      for (std::uint32_t i = node.next; i < node.next + node.count; ++i) ask(i, hint);
      if (node.count > 0) continue;
      const bool swap = from_centre(tree_.nodes[node.next]) < from_centre(tree_.nodes[at + 1]);
      stack[depth++] = swap ? at + 1 : node.next;
      stack[depth++] = swap ? node.next : at + 1;
    }
  }

 private:
  float from_centre(const PointNode& n) const {
    const float dx = std::max(std::max(n.lo.x - centre_.x, centre_.x - n.hi.x), 0.0F);
    const float dy = std::max(std::max(n.lo.y - centre_.y, centre_.y - n.hi.y), 0.0F);
    const float dz = std::max(std::max(n.lo.z - centre_.z, centre_.z - n.hi.z), 0.0F);
    return dx * dx + dy * dy + dz * dz;
  }

  static Floats square(Floats x, Floats y, Floats z) {
    return hn::Add(hn::Add(hn::Mul(x, x), hn::Mul(y, y)), hn::Mul(z, z));
  }

  /// Whether some voxel is as near to the node as to the best point so far.
  bool may_hold_nearest(const PointNode& n) const {
    const Lanes d;
    const auto off = [](Floats v, float lo, float hi) {
      return hn::Max(hn::Max(hn::Sub(set(lo), v), hn::Sub(v, set(hi))), set(0));
    };
    for (std::size_t i = 0; i < kVoxels; i += hn::Lanes(d)) {
      const Floats box = square(off(hn::Load(d, x_ + i), n.lo.x, n.hi.x), off(hn::Load(d, y_ + i), n.lo.y, n.hi.y),
                                off(hn::Load(d, z_ + i), n.lo.z, n.hi.z));
      if (!hn::AllFalse(d, hn::Lt(box, hn::Mul(hn::LoadU(d, squares_ + i), set(kSlack))))) return true;
    }
    return false;
  }

  void ask(std::uint32_t index, std::uint32_t& hint) {
    const Lanes d;
    const Vec3& p = tree_.points[index];
    bool nearer = false;
    for (std::size_t i = 0; i < kVoxels; i += hn::Lanes(d)) {
      const Floats before = hn::LoadU(d, squares_ + i);
      const Floats now = square(hn::Sub(hn::Load(d, x_ + i), set(p.x)), hn::Sub(hn::Load(d, y_ + i), set(p.y)),
                                hn::Sub(hn::Load(d, z_ + i), set(p.z)));
      nearer |= !hn::AllFalse(d, hn::Lt(now, before));
      hn::StoreU(hn::Min(now, before), d, squares_ + i);
    }
    if (nearer) hint = index;
  }

  const PointTreeView& tree_;
  float* squares_;
  Vec3 centre_;
  alignas(64) float x_[kVoxels], y_[kVoxels], z_[kVoxels];
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
