#include "kernel/box_tree.h"

#include <algorithm>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernel/box_tree.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace tetsoup::kernel::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using BoxLanes = hn::CappedTag<float, kBoxGroup>;

/// test(i) for as many of a group's boxes from i on as there are lanes; bit b: it holds for box b.
template <class Test>
HWY_INLINE std::uint32_t bits_of(const Test& test) {
  const BoxLanes d;
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < kBoxGroup; i += hn::Lanes(d)) {
    std::uint8_t some[8] = {};
    hn::StoreMaskBits(d, test(i), some);
    bits |= static_cast<std::uint32_t>(some[0]) << i;
  }
  return bits;
}

/// A point grown by the margin meets what the point is within the margin of, and saves growing the boxes.
struct Reach {
  Vec3 lo, hi;
};

HWY_INLINE std::uint32_t holding(const BoxGroup& group, const Reach& reach) {
  const BoxLanes d;
  const auto meets = [&](std::size_t axis, float lo, float hi, std::size_t i) {
    return hn::And(hn::Ge(hn::Set(d, hi), hn::Load(d, &group.lo[axis][i])),
                   hn::Le(hn::Set(d, lo), hn::Load(d, &group.hi[axis][i])));
  };
  return bits_of([&](std::size_t i) {
    return hn::And(meets(0, reach.lo.x, reach.hi.x, i),
                   hn::And(meets(1, reach.lo.y, reach.hi.y, i), meets(2, reach.lo.z, reach.hi.z, i)));
  });
}

HWY_INLINE std::uint32_t lying_apart(const MiddleGroup& group, const Vec3& p, float square) {
  const BoxLanes d;
  const auto squared = [&](std::size_t axis, float at, std::size_t i) {
    const auto apart = hn::Sub(hn::Set(d, at), hn::Load(d, &group.at[axis][i]));
    return hn::Mul(apart, apart);
  };
  return bits_of([&](std::size_t i) {
    return hn::Ge(hn::Add(hn::Add(squared(0, p.x, i), squared(1, p.y, i)), squared(2, p.z, i)), hn::Set(d, square));
  });
}

struct Query {
  const BoxTree& tree;
  const NumberedPoint& point;
  Reach reach;
  const Neighbours& neighbours;
  std::vector<PointInBox>& found;
};

void descend(const Query& query, std::size_t level, std::size_t group) {
  std::uint32_t bits = holding(query.tree.levels[level][group], query.reach);
  if (level == 0 && bits != 0 && !query.neighbours.middles.empty())
    bits &= lying_apart(query.neighbours.middles[group], query.point.rest, query.neighbours.square);
  for (; bits != 0; bits &= bits - 1) {
    const std::size_t box = group * kBoxGroup + hwy::Num0BitsBelowLS1Bit_Nonzero32(bits);
    if (level > 0)
      descend(query, level - 1, box);
    else
      query.found.push_back({query.point.number, static_cast<std::uint32_t>(box)});
  }
}

void find_boxes_around(const BoxTree& tree, std::span<const NumberedPoint> points, float margin,
                       const Neighbours& neighbours, std::vector<PointInBox>& found) {
  for (const NumberedPoint& p : points) {
    const auto [x, y, z] = p.place;
    const Vec3 by{p.half.x + margin, p.half.y + margin, p.half.z + margin};
    const Reach reach{{x - by.x, y - by.y, z - by.z}, {x + by.x, y + by.y, z + by.z}};
    descend({tree, p, reach, neighbours, found}, tree.levels.size() - 1, 0);
  }
}

}  // namespace tetsoup::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tetsoup::kernel {
namespace {

constexpr float kFar = std::numeric_limits<float>::infinity();

constexpr BoxGroup empty_group() {
  BoxGroup group{};
  for (auto& row : group.lo) row.fill(kFar);
  for (auto& row : group.hi) row.fill(-kFar);
  return group;
}

}  // namespace

BoxTree make_box_tree(std::size_t box_count) {
  BoxTree tree;
  do {
    box_count = (box_count + kBoxGroup - 1) / kBoxGroup;
    tree.levels.emplace_back(box_count, empty_group());
  } while (box_count > 1);
  return tree;
}

void fit_upper_levels(BoxTree& tree) {
  for (std::size_t level = 1; level < tree.levels.size(); ++level) {
    const std::vector<BoxGroup>& below = tree.levels[level - 1];
    for (std::size_t i = 0; i < below.size(); ++i) {
      BoxGroup& above = tree.levels[level][i / kBoxGroup];
      for (std::size_t axis = 0; axis < 3; ++axis) {
        above.lo[axis][i % kBoxGroup] = *std::min_element(below[i].lo[axis].begin(), below[i].lo[axis].end());
        above.hi[axis][i % kBoxGroup] = *std::max_element(below[i].hi[axis].begin(), below[i].hi[axis].end());
      }
    }
  }
}

HWY_EXPORT(find_boxes_around);

void find_boxes_around(const BoxTree& tree, std::span<const NumberedPoint> points, float margin,
                       const Neighbours& neighbours, std::vector<PointInBox>& found) {
  HWY_DYNAMIC_DISPATCH(find_boxes_around)(tree, points, margin, neighbours, found);
}

}  // namespace tetsoup::kernel
#endif
