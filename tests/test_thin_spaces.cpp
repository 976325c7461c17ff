// How thick the walls of a soup are, how wide its gaps, and where it is a sheet.
#include <gtest/gtest.h>

#include "bodies/thin_spaces.h"
#include "shapes.h"
#include "tetsoup/regions.h"
#include "tetsoup/soup.h"

namespace tetsoup {
namespace {

using test::joined;
using test::make_box;
using test::make_globe;

/// Every part is closed, or none.
ThinSpaces spaces_of(const TriangleSoup& given, std::uint8_t closed = 1) {
  const TriangleSoup soup = clean_soup(given).soup;
  const std::vector<std::uint32_t> parts = label_parts(soup);
  const std::vector<std::uint8_t> is_closed(soup.triangles.size(), closed);
  const Progress none;
  StageWatch watch(none, "bodies");
  return measure_thin_spaces(soup, parts, is_closed, kThinPoints, watch);
}

/// A prism over the polygon with these corners, counter-clockwise and seen as a fan from the first, from y = 0 to 1.
TriangleSoup make_prism(const std::vector<std::array<double, 2>>& corners) {
  TriangleSoup prism;
  const auto n = static_cast<std::uint32_t>(corners.size());
  for (const double y : {0.0, 1.0})
    for (const auto& [x, z] : corners) prism.vertices.push_back(to_float({x, y, z}));
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t k = (i + 1) % n;
    prism.triangles.push_back({i, k, n + i});
    prism.triangles.push_back({k, n + k, n + i});
    if (i == 0 || k == 0) continue;
    prism.triangles.push_back({0, i, k});
    prism.triangles.push_back({n, n + i, n + k});
  }
  return prism;
}

TEST(ThinSpaces, a_plate_is_as_thick_as_it_is_and_two_plates_have_a_gap) {
  const TriangleSoup plate = make_box({0, 0, 0}, {2, 1, 0.01});
  const ThinSpaces one = spaces_of(plate);
  EXPECT_NEAR(*one.thinnest(SpaceKind::Wall, 0.02), 0.01, 1e-6);
  EXPECT_NEAR(*one.distance_below(SpaceKind::Wall, 0.9), 0.01, 1e-6);
  EXPECT_FALSE(one.thinnest(SpaceKind::Gap, 0.001));
  EXPECT_NEAR(one.area, 4 + 2 * 0.03, 1e-5);

  const ThinSpaces two = spaces_of(joined(plate, make_box({0, 0, 0.015}, {2, 1, 0.035})));
  EXPECT_NEAR(*two.thinnest(SpaceKind::Gap, 0.02), 0.005, 1e-6);
  EXPECT_NEAR(*two.thinnest(SpaceKind::Wall, 0.02), 0.01, 1e-6);
  EXPECT_NEAR(*two.distance_below(SpaceKind::Wall, 0.9), 0.02, 1e-6);
}

TEST(ThinSpaces, a_hollow_ball_has_a_wall_between_its_surfaces_whatever_the_winding) {
  const TriangleSoup shell =
      joined(make_globe(40, 80, [](Vec3d p) { return p; }), make_globe(40, 80, [](Vec3d p) { return p * 0.95; }));
  const ThinSpaces spaces = spaces_of(shell), turned = spaces_of(test::scrambled(shell, 5));
  EXPECT_NEAR(*spaces.thinnest(SpaceKind::Wall, 0.5), 0.05, 0.002);
  ASSERT_EQ(spaces.samples.size(), turned.samples.size());
  for (std::size_t i = 0; i < spaces.samples.size(); ++i) {
    ASSERT_EQ(spaces.samples[i].distance, turned.samples[i].distance);
    ASSERT_EQ(spaces.samples[i].kind, turned.samples[i].kind);
  }
  for (const FacingSample& s : spaces_of(shell, 0).samples) ASSERT_EQ(s.kind, SpaceKind::Unknown);
}

TEST(ThinSpaces, the_tip_of_a_wedge_is_no_thin_wall) {
  // 20 degrees; its edge is cut off, so that the sides share no corners and are seen to face each other.
  const ThinSpaces wedge = spaces_of(make_prism({{0.001, 0}, {1, 0}, {1, 0.364}, {0.001, 0.000364}}));
  EXPECT_LT(*wedge.distance_below(SpaceKind::Wall, 0.05), 0.1);
  const std::optional<double> thinnest = wedge.thinnest(SpaceKind::Wall, 0.02);
  EXPECT_TRUE(!thinnest || *thinnest > 0.1) << *thinnest;
  // With a thin fin on it, the fin is.
  const TriangleSoup fin = make_box({0.3, 0.2, -0.5}, {0.8, 0.21, 0.0625});
  EXPECT_NEAR(*spaces_of(joined(make_prism({{0.001, 0}, {1, 0}, {1, 0.364}, {0.001, 0.000364}}), fin))
                   .thinnest(SpaceKind::Wall, 0.02),
              0.01, 0.001);
}

TEST(ThinSpaces, sheets_are_free_and_doubled_sheets_are_doubled) {
  TriangleSoup sheet;
  sheet.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  sheet.triangles = {{0, 1, 2}, {1, 3, 2}};
  const ThinSpaces lone = spaces_of(sheet, 0);
  EXPECT_EQ(lone.free_share, 1);
  EXPECT_EQ(lone.doubled_share, 0);
  EXPECT_TRUE(lone.samples.empty());
  TriangleSoup other = sheet;
  other.triangles = {{0, 1, 3}, {0, 3, 2}};
  for (Vec3& v : other.vertices) v.z = 1e-5F;
  EXPECT_EQ(spaces_of(joined(sheet, other), 0).doubled_share, 1);
}

TEST(ThinSpaces, nothing_is_measured_where_nothing_has_an_area) {
  EXPECT_EQ(spaces_of({}).point_count, 0U);
  const ThinSpaces segment = spaces_of({{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}});
  EXPECT_EQ(segment.point_count, 0U);
  EXPECT_FALSE(segment.distance_below(SpaceKind::Wall, 0.1));
}

}  // namespace
}  // namespace tetsoup
