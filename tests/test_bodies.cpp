// Which parts of a soup touch, and which lie inside which.
#include <gtest/gtest.h>

#include <array>
#include <numbers>
#include <numeric>

#include "base/orientation.h"
#include "base/triangle_boxes.h"
#include "base/triangle_contact.h"
#include "bodies/touching_groups.h"
#include "shapes.h"
#include "tetsoup/regions.h"
#include "tetsoup/soup.h"

namespace tetsoup {
namespace {

using test::joined;
using test::make_ball;
using test::make_box;
using test::Random;

using Numbers = std::vector<std::uint32_t>;

struct Parts {
  TriangleSoup soup;
  Numbers labels;
  std::size_t count = 0;
};

/// Parts by their vertices, in the order of the biggest first, then of the canonical soup.
Parts parts_of(const TriangleSoup& given) {
  Parts parts{clean_soup(given).soup, {}, 0};
  parts.labels = label_parts(parts.soup);
  for (const std::uint32_t label : parts.labels) parts.count = std::max(parts.count, std::size_t{label} + 1);
  return parts;
}

Numbers groups_of(const Parts& parts, double near = 0) {
  const Progress none;
  StageWatch watch(none, "bodies");
  return touching_groups(parts.soup, parts.labels, parts.count, near, watch);
}
Numbers groups_of(const TriangleSoup& soup, double near = 0) {
  return groups_of(parts_of(soup), near);
}
Numbers around_of(const TriangleSoup& soup, const std::vector<std::uint8_t>& closed) {
  const Parts parts = parts_of(soup);
  const Progress none;
  StageWatch watch(none, "bodies");
  return part_inside(parts.soup, parts.labels, groups_of(parts), closed, watch);
}

/// A triangle as a soup of its own.
TriangleSoup lone(const Vec3& a, const Vec3& b, const Vec3& c) {
  return {{a, b, c}, {{0, 1, 2}}};
}

/// A tube around a circle in the plane of two axes.
TriangleSoup make_ring(const Vec3d& centre, const Vec3d& u, const Vec3d& v, double tube) {
  constexpr std::uint32_t kAround = 40, kTube = 12;
  const Vec3d w = cross(u, v);
  TriangleSoup ring;
  for (std::uint32_t i = 0; i < kAround; ++i) {
    for (std::uint32_t j = 0; j < kTube; ++j) {
      const double phi = 2 * std::numbers::pi * i / kAround, psi = 2 * std::numbers::pi * j / kTube;
      const Vec3d out = u * std::cos(phi) + v * std::sin(phi);
      ring.vertices.push_back(to_float(centre + out * (1 + tube * std::cos(psi)) + w * (tube * std::sin(psi))));
      const std::uint32_t a = i * kTube + j, b = i * kTube + (j + 1) % kTube;
      const std::uint32_t c = (i + 1) % kAround * kTube + j, d = (i + 1) % kAround * kTube + (j + 1) % kTube;
      ring.triangles.push_back({a, c, b});
      ring.triangles.push_back({b, c, d});
    }
  }
  return ring;
}

TEST(Orientation, is_exact_where_doubles_are_not) {
  // A plane through points whose coordinates differ by 2^40: one step of the last bit beside it.
  const Vec3 a{0x1p20F, 0x1p-20F, 0}, b{0, 0x1p20F, 0x1p-20F}, c{0x1p-20F, 0, 0x1p20F};
  EXPECT_EQ(orientation(a, b, c, a), 0);
  EXPECT_EQ(orientation(a, b, c, Vec3{0x1p20F, 0x1p-20F, 0x1p-60F}), orientation(a, b, c, Vec3{0x1p21F, 1, 1}));
  EXPECT_EQ(orientation(a, b, c, Vec3{0x1p20F, 0x1p-20F, -0x1p-60F}), -orientation(a, b, c, Vec3{0x1p21F, 1, 1}));
  EXPECT_EQ(orientation(PlanePoint{0, 0}, PlanePoint{1, 1}, PlanePoint{0x1p-30F, 0x1.000002p-30F}), 1);
  EXPECT_EQ(orientation(PlanePoint{0x1p30F, 0x1p30F}, PlanePoint{-1, -1}, PlanePoint{0x1p-30F, 0x1p-30F}), 0);
}

TEST(Orientation, agrees_with_whole_numbers_of_any_order_of_the_corners) {
  Random random(7);
  for (int i = 0; i < 20000; ++i) {
    // Flat more often than not, far from the origin: as in files of machine parts.
    std::array<Vec3, 4> p;
    std::array<std::array<std::int64_t, 3>, 4> n;
    for (std::size_t k = 0; k < 4; ++k) {
      for (std::size_t axis = 0; axis < 3; ++axis) n[k][axis] = 1000000 + static_cast<std::int64_t>(random.below(3));
      p[k] = {static_cast<float>(n[k][0]), static_cast<float>(n[k][1]), static_cast<float>(n[k][2])};
    }
    const auto at = [&](std::size_t k, std::size_t axis) { return n[k][axis] - n[0][axis]; };
    const std::int64_t det = (at(1, 1) * at(2, 2) - at(1, 2) * at(2, 1)) * at(3, 0) +
                             (at(1, 2) * at(2, 0) - at(1, 0) * at(2, 2)) * at(3, 1) +
                             (at(1, 0) * at(2, 1) - at(1, 1) * at(2, 0)) * at(3, 2);
    const int sign = det > 0 ? 1 : det < 0 ? -1 : 0;
    ASSERT_EQ(orientation(p[0], p[1], p[2], p[3]), sign);
    ASSERT_EQ(orientation(p[1], p[0], p[2], p[3]), -sign);
    ASSERT_EQ(orientation(p[3], p[2], p[1], p[0]), sign);
  }
}

TEST(TriangleContact, pairs_on_a_small_lattice_meet_where_their_distance_is_zero) {
  Random random(3);
  int met = 0;
  for (int i = 0; i < 40000; ++i) {
    std::array<TriangleCorners, 2> t;
    for (TriangleCorners& corners : t)
      for (Vec3& p : corners)
        p = {static_cast<float>(random.below(5)), static_cast<float>(random.below(5)),
             static_cast<float>(random.below(i % 2 == 0 ? 5 : 2))};
    // Corners to the other face and edges to edges say zero, or an edge goes through a face.
    bool meet = squared_distance(t[0], t[1]) < 1e-20;
    for (std::size_t side = 0; side < 2 && !meet; ++side) {
      const TriangleCorners &face = t[side], &other = t[1 - side];
      for (std::size_t k = 0; k < 3 && !meet; ++k) {
        const Vec3d n = cross(to_double(face[1]) - to_double(face[0]), to_double(face[2]) - to_double(face[0]));
        const Vec3d p = to_double(other[k]), q = to_double(other[(k + 1) % 3]);
        const double hp = dot(n, p - to_double(face[0])), hq = dot(n, q - to_double(face[0]));
        if (hp * hq >= 0) continue;
        const Vec3d x = p + (q - p) * (hp / (hp - hq));
        meet = squared_length(
                   x - closest_on_triangle({to_double(face[0]), to_double(face[1]), to_double(face[2])}, x)) < 1e-20;
      }
    }
    ASSERT_EQ(triangles_meet(t[0], t[1]), meet) << i;
    ASSERT_EQ(triangles_meet(t[1], t[0]), meet) << i;
    met += meet ? 1 : 0;
  }
  EXPECT_GT(met, 4000);
  EXPECT_LT(met, 36000);
}

TEST(TouchingGroups, boxes_that_share_a_face_an_edge_or_a_corner_touch_and_one_bit_apart_they_do_not) {
  const TriangleSoup box = make_box({0, 0, 0}, {1, 1, 1});
  for (const Vec3d& by : {Vec3d{1, 0.25, 0.25}, Vec3d{1, 1, 0.25}, Vec3d{0.5, 0.5, 0.5}}) {
    const Vec3d far = by + Vec3d{0x1p-23, 0, 0};
    EXPECT_EQ(groups_of(joined(box, make_box(by, by + Vec3d{1, 1, 1}))), (Numbers{0, 0})) << by.x << by.y << by.z;
    if (by.x < 1) continue;
    EXPECT_EQ(groups_of(joined(box, make_box(far, far + Vec3d{1, 1, 1}))), (Numbers{0, 1}));
  }
  Parts corner{clean_soup(joined(box, make_box({1, 1, 1}, {2, 2, 2}))).soup, {}, 2};
  for (const auto& [a, b, c] : corner.soup.triangles) {
    const auto& v = corner.soup.vertices;
    corner.labels.push_back(v[a].x + v[b].x + v[c].x > 3 || v[a].y + v[b].y + v[c].y > 3 ? 1 : 0);
  }
  EXPECT_EQ(groups_of(corner), (Numbers{0, 0}));
}

TEST(TouchingGroups, links_of_a_chain_and_a_box_in_a_box_do_not_touch) {
  const TriangleSoup chain =
      joined(make_ring({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0.3), make_ring({1, 0, 0}, {1, 0, 0}, {0, 0, 1}, 0.3));
  EXPECT_EQ(groups_of(chain), (Numbers{0, 1}));
  EXPECT_EQ(groups_of(chain, 0.3), (Numbers{0, 1}));
  EXPECT_EQ(groups_of(chain, 0.5), (Numbers{0, 0}));
  EXPECT_EQ(groups_of(joined(make_box({0, 0, 0}, {3, 3, 3}), make_box({1, 1, 1}, {2, 2, 2}))), (Numbers{0, 1}));
}

TEST(TouchingGroups, what_has_no_area_touches_what_it_lies_on) {
  const TriangleSoup face = lone({0, 0, 0}, {4, 0, 0}, {0, 4, 0});
  const auto with = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    return groups_of(joined(face, lone(a, b, c)))[1];
  };
  EXPECT_EQ(with({1, 1, 0}, {1, 1, 0}, {1, 1, 0}), 0U);
  EXPECT_EQ(with({1, 1, -1}, {1, 1, 0}, {1, 1, 2}), 0U);
  EXPECT_EQ(with({2, 2, 0}, {3, 3, 0}, {4, 4, 0}), 0U);  // the edge's middle
  EXPECT_EQ(with({3, 3, 0}, {4, 4, 0}, {5, 5, 0}), 1U);
  EXPECT_EQ(with({1, 1, 1}, {1, 1, 1}, {1, 1, 1}), 1U);
  const TriangleSoup segment = lone({0, 0, 0}, {1, 1, 1}, {4, 4, 4});
  EXPECT_EQ(groups_of(joined(segment, lone({0, 2, 1}, {1, 2, 1.5F}, {4, 2, 3}))), (Numbers{0, 0}));
  EXPECT_EQ(groups_of(joined(segment, lone({3, 3, 3}, {5, 5, 5}, {6, 6, 6}))), (Numbers{0, 0}));
  EXPECT_EQ(groups_of(joined(segment, lone({5, 5, 5}, {6, 6, 6}, {7, 7, 7}))), (Numbers{0, 1}));
}

TEST(TouchingGroups, are_those_of_all_pairs_of_loose_triangles) {
  for (const double size : {0.02, 0.05, 0.1}) {
    const Parts parts = parts_of(test::make_confetti(600, size, 11));
    ASSERT_EQ(parts.count, 600U);
    Numbers expected(600);
    std::iota(expected.begin(), expected.end(), 0U);
    const auto corners = [&](std::size_t i) {
      const auto [a, b, c] = parts.soup.triangles[i];
      return TriangleCorners{parts.soup.vertices[a], parts.soup.vertices[b], parts.soup.vertices[c]};
    };
    for (std::size_t i = 0; i < 600; ++i)
      for (std::size_t k = 0; k < i; ++k)
        if (triangles_meet(corners(i), corners(k))) {
          const std::uint32_t from = expected[parts.labels[i]], to = expected[parts.labels[k]];
          for (std::uint32_t& g : expected)
            if (g == std::max(from, to)) g = std::min(from, to);
        }
    std::vector<std::uint32_t> names(600, kNoPart);
    std::uint32_t count = 0;
    for (std::uint32_t& g : expected) {
      if (names[g] == kNoPart) names[g] = count++;
      g = names[g];
    }
    EXPECT_EQ(groups_of(parts), expected) << size;
    EXPECT_GT(count, 1U);
  }
}

TEST(PartInside, tells_the_innermost_closed_part_around) {
  // Nested boxes of sides 8, 6, 4, and one beside them; label_parts() keeps their order.
  TriangleSoup soup = make_box({-4, -4, -4}, {4, 4, 4});
  for (const double half : {3.0, 2.0}) soup = joined(soup, make_box({-half, -half, -half}, {half, half, half}));
  soup = joined(soup, make_box({5, -1, -1}, {7, 1, 1}));
  EXPECT_EQ(around_of(soup, {1, 1, 1, 1}), (Numbers{kNoPart, 0, 1, kNoPart}));
  EXPECT_EQ(around_of(soup, {1, 0, 1, 1}), (Numbers{kNoPart, 0, 0, kNoPart}));
  EXPECT_EQ(around_of(soup, {0, 0, 0, 0}), (Numbers{kNoPart, kNoPart, kNoPart, kNoPart}));
}

TEST(PartInside, counts_what_a_ray_meets_at_corners_and_edges_once) {
  // A small box whose lowest corner's ray runs along corners, edges and faces of a ball and of boxes.
  TriangleSoup soup = make_ball(4);
  soup = joined(soup, make_box({-1, 0, 0}, {0, 1, 1}));
  for (const double y : {-1.0, 0.0, 1.0}) soup = joined(soup, make_box({1, y, -1}, {2, y + 0.75, 0}));
  const Numbers around = around_of(soup, {1, 1, 1, 1, 1});
  EXPECT_EQ(around, (Numbers{kNoPart, 0, 0, 0, 0}));
}

}  // namespace
}  // namespace tetsoup
