#include <gtest/gtest.h>

#include <random>

#include "kernel/box_tree.h"
#include "kernel/targets.h"

namespace tetsoup::kernel {
namespace {

struct Scattered {
  std::vector<Vec3> lo, hi;
  std::vector<NumberedPoint> points;
  std::vector<MiddleGroup> middles;

  explicit Scattered(std::size_t box_count) {
    std::mt19937 random(11);
    std::uniform_real_distribution<float> place(0, 10), edge(0, 2);
    for (std::size_t i = 0; i < box_count; ++i) {
      lo.push_back({place(random), place(random), place(random)});
      hi.push_back({lo[i].x + edge(random), lo[i].y + edge(random), lo[i].z + edge(random)});
      if (i % kBoxGroup == 0) middles.emplace_back();
      for (auto& row : middles.back().at) row[i % kBoxGroup] = place(random);
    }
    for (std::uint32_t i = 0; i < 300; ++i)
      points.push_back({{place(random), place(random), place(random)}, 3 * i, {place(random), place(random), 5}});
    points.push_back({lo[0], 1000, {}});  // a corner belongs to its box
  }
  BoxTree tree() const {
    BoxTree made = make_box_tree(lo.size());
    for (std::size_t i = 0; i < lo.size(); ++i) set_box(made, i, lo[i], hi[i]);
    fit_upper_levels(made);
    return made;
  }
};

std::vector<PointInBox> asked_one_by_one(const Scattered& s, float margin, const Neighbours& neighbours) {
  std::vector<PointInBox> found;
  for (const NumberedPoint& p : s.points) {
    for (std::uint32_t i = 0; i < s.lo.size(); ++i) {
      const auto within = [&](float at, float lo, float hi) { return at + margin >= lo && at - margin <= hi; };
      if (!within(p.place.x, s.lo[i].x, s.hi[i].x) || !within(p.place.y, s.lo[i].y, s.hi[i].y) ||
          !within(p.place.z, s.lo[i].z, s.hi[i].z))
        continue;
      if (!neighbours.middles.empty()) {
        const auto& at = neighbours.middles[i / kBoxGroup].at;
        const std::size_t b = i % kBoxGroup;
        const float x = p.rest.x - at[0][b], y = p.rest.y - at[1][b], z = p.rest.z - at[2][b];
        if (x * x + y * y + z * z < neighbours.square) continue;
      }
      found.push_back({p.number, i});
    }
  }
  return found;
}

TEST(BoxTree, FindsWhatAskingOneByOneFindsOnAnyTarget) {
  for (const std::size_t count : {std::size_t{1}, std::size_t{8}, std::size_t{9}, std::size_t{700}}) {
    const Scattered s(count);
    const BoxTree tree = s.tree();
    for (const Neighbours& neighbours : {Neighbours{}, Neighbours{s.middles, 16}}) {
      const auto expected = asked_one_by_one(s, 0.25F, neighbours);
      ASSERT_FALSE(expected.empty() && count > 1);
      for_each_simd_target([&](const std::string& target) {
        std::vector<PointInBox> found;
        find_boxes_around(tree, s.points, 0.25F, neighbours, found);
        EXPECT_EQ(found, expected) << target;
      });
    }
  }
}

TEST(BoxTree, ABoxThatMovesTakesItsPointsAlong) {
  BoxTree tree = make_box_tree(100);
  const NumberedPoint point{{5, 5, 5}, 7, {}};
  std::vector<PointInBox> found;
  find_boxes_around(tree, {&point, 1}, 1, {}, found);
  EXPECT_TRUE(found.empty());
  set_box(tree, 42, {4, 4, 4}, {6, 6, 6});
  fit_upper_levels(tree);
  find_boxes_around(tree, {&point, 1}, 0, {}, found);
  EXPECT_EQ(found, (std::vector<PointInBox>{{7, 42}}));
}

}  // namespace
}  // namespace tetsoup::kernel
