// Stage 1: what is kept, what is counted, and that order and winding leave no trace.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "shapes.h"
#include "tetsoup/error.h"
#include "tetsoup/soup.h"

namespace tetsoup {
namespace {

using test::joined;
using test::make_ball;
using test::make_box;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

TEST(Soup, a_box_is_closed_and_consistent) {
  const SoupReport r = clean_soup(make_box({0, 0, 0}, {1, 2, 3})).report;
  EXPECT_EQ(r.kind, SoupClass::Closed);
  EXPECT_EQ(r.used_triangles, 12U);
  EXPECT_EQ(r.components, 1U);
  EXPECT_EQ(r.boundary_edges + r.non_manifold_edges + r.inconsistent_edges + r.zero_area + r.duplicates, 0U);
  EXPECT_EQ(r.box, (Box3{{0, 0, 0}, {1, 2, 3}}));
}

TEST(Soup, a_missing_triangle_opens_three_edges) {
  TriangleSoup box = make_box({0, 0, 0}, {1, 1, 1});
  box.triangles.pop_back();
  const SoupReport r = clean_soup(box).report;
  EXPECT_EQ(r.kind, SoupClass::Open);
  EXPECT_EQ(r.boundary_edges, 3U);
}

TEST(Soup, a_turned_triangle_makes_its_three_edges_inconsistent) {
  TriangleSoup box = make_box({0, 0, 0}, {1, 1, 1});
  std::swap(box.triangles[5][0], box.triangles[5][1]);
  EXPECT_EQ(clean_soup(box).report.inconsistent_edges, 3U);
}

TEST(Soup, three_triangles_on_an_edge_are_non_manifold) {
  TriangleSoup fins;
  fins.vertices = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, -1, 0}};
  fins.triangles = {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}};
  const SoupReport r = clean_soup(fins).report;
  EXPECT_EQ(r.non_manifold_edges, 1U);
  EXPECT_EQ(r.boundary_edges, 6U);
  EXPECT_EQ(r.kind, SoupClass::Soup);
}

TEST(Soup, vertices_merge_by_position_and_minus_zero_is_zero) {
  TriangleSoup quad;
  quad.vertices = {{0.0F, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-0.0F, -0.0F, 0}, {1, 1, 0}, {0, 1, 0}};
  quad.triangles = {{0, 1, 2}, {3, 4, 5}};
  const CleanSoup clean = clean_soup(quad);
  EXPECT_EQ(clean.report.merged_vertices, 4U);
  EXPECT_EQ(clean.report.components, 1U);
  EXPECT_EQ(clean.report.boundary_edges, 4U);
  for (const Vec3& v : clean.soup.vertices) EXPECT_FALSE(std::signbit(v.x) || std::signbit(v.y) || std::signbit(v.z));
}

TEST(Soup, what_cannot_be_used_is_dropped_and_counted_by_cause) {
  TriangleSoup s = make_box({0, 0, 0}, {1, 1, 1});
  s.vertices.insert(s.vertices.end(), {{kNan, 0, 0}, {0, kInf, 0}, {0, 0, 2e30F}});
  s.triangles.insert(s.triangles.end(), {{0, 1, 8}, {9, 1, 2}, {0, 10, 2}, {0, 1, 11}, {0xffffffffU, 1, 2}});
  const CleanSoup clean = clean_soup(s);
  EXPECT_EQ(clean.report.non_finite, 3U);
  EXPECT_EQ(clean.report.index_out_of_range, 2U);
  EXPECT_EQ(clean.report.used_triangles, 12U);
  EXPECT_EQ(clean.report.kind, SoupClass::Closed);
}

TEST(Soup, degenerate_triangles_are_kept_and_counted) {
  TriangleSoup s;
  s.vertices = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}};
  s.triangles = {{0, 1, 3}, {0, 1, 2}, {0, 0, 1}, {3, 3, 3}};
  const CleanSoup clean = clean_soup(s);
  EXPECT_EQ(clean.report.zero_area, 3U);
  EXPECT_EQ(clean.report.used_triangles, 4U);
}

TEST(Soup, duplicates_in_any_order_are_dropped_but_show_in_the_edges) {
  TriangleSoup s = make_box({0, 0, 0}, {1, 1, 1});
  s.triangles.push_back({s.triangles[3][1], s.triangles[3][0], s.triangles[3][2]});
  const SoupReport r = clean_soup(s).report;
  EXPECT_EQ(r.duplicates, 1U);
  EXPECT_EQ(r.used_triangles, 12U);
  EXPECT_EQ(r.non_manifold_edges, 3U);
}

TEST(Soup, nothing_usable_is_empty_and_not_an_error) {
  EXPECT_EQ(clean_soup({}).report.kind, SoupClass::Empty);
  TriangleSoup s;
  s.vertices = {{kNan, kNan, kNan}};
  s.triangles = {{0, 0, 0}};
  EXPECT_EQ(clean_soup(s).report.kind, SoupClass::Empty);
  EXPECT_EQ(clean_soup(s).report.non_finite, 1U);
}

TEST(Soup, order_and_winding_leave_no_trace) {
  const TriangleSoup s = joined(make_ball(), make_box({0.5, 0, 0}, {2, 1, 1}));
  const CleanSoup a = clean_soup(s);
  for (std::uint64_t seed = 1; seed < 4; ++seed) {
    const CleanSoup b = clean_soup(test::scrambled(s, seed));
    EXPECT_EQ(a.soup.vertices, b.soup.vertices);
    EXPECT_EQ(a.soup.triangles, b.soup.triangles);
  }
}

TEST(Soup, unused_vertices_do_not_widen_the_box) {
  TriangleSoup s = make_box({0, 0, 0}, {1, 1, 1});
  s.vertices.push_back({100, 100, 100});
  EXPECT_EQ(clean_soup(s).report.box.hi, (Vec3d{1, 1, 1}));
}

TEST(Soup, a_callback_that_says_no_cancels) {
  EXPECT_THROW(clean_soup(make_ball(), [](std::string_view, double) { return false; }), Cancelled);
}

}  // namespace
}  // namespace tetsoup
