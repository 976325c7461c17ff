// Many boxes, eight side by side, and which of them hold a point.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tetsoup/types.h"

namespace tetsoup::kernel {

inline constexpr std::size_t kBoxGroup = 8;

/// What is left empty holds no point.
struct alignas(32) BoxGroup {
  std::array<std::array<float, kBoxGroup>, 3> lo, hi;
};

/// Groups of boxes; the box around a group is in a group of the next level, whose last has one group.
struct BoxTree {
  std::vector<std::vector<BoxGroup>> levels;
};

/// Levels for so many boxes, all of them empty.
BoxTree make_box_tree(std::size_t box_count);

inline void set_box(BoxTree& tree, std::size_t box, const Vec3& lo, const Vec3& hi) {
  BoxGroup& group = tree.levels[0][box / kBoxGroup];
  const std::size_t i = box % kBoxGroup;
  group.lo[0][i] = lo.x, group.lo[1][i] = lo.y, group.lo[2][i] = lo.z;
  group.hi[0][i] = hi.x, group.hi[1][i] = hi.y, group.hi[2][i] = hi.z;
}

/// Fits the upper levels to the first, once that is filled.
void fit_upper_levels(BoxTree& tree);

struct NumberedPoint {
  Vec3 place;
  std::uint32_t number = 0;
  Vec3 rest;    ///< Where it was when nothing had moved; for `Neighbours`.
  Vec3 half{};  ///< Of a box around it that is looked for instead.
};
struct PointInBox {
  std::uint32_t point = 0;  ///< Its number.
  std::uint32_t box = 0;
  bool operator==(const PointInBox&) const = default;
};

/// Eight of the first level's boxes: the middles of what they hold, when nothing had moved.
struct alignas(32) MiddleGroup {
  std::array<std::array<float, kBoxGroup>, 3> at;
};
/// Boxes whose middles lay nearer than this to a point are passed over; none without middles.
struct Neighbours {
  std::span<const MiddleGroup> middles;
  float square = 0;  ///< Of the distance.
};

/// Appends which points lie in which boxes, or within a margin of them along each axis: point after point, boxes
/// ascending.
void find_boxes_around(const BoxTree& tree, std::span<const NumberedPoint> points, float margin,
                       const Neighbours& neighbours, std::vector<PointInBox>& found);

}  // namespace tetsoup::kernel
