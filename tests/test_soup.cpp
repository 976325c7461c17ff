// Stage 1: what is kept, what is counted, and that order and winding leave no trace.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>

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

/// A soup of few distinct coordinates: many vertices share one, two or all three of them, many triangles an edge.
TriangleSoup crowded_soup(std::uint64_t seed, std::size_t vertices, std::array<int, 3> values) {
  test::Random random(seed);
  const auto coordinate = [&](int count) {
    const auto step = static_cast<float>(static_cast<int>(random.uniform() * count) - count / 2);
    return random.uniform() < 0.5 ? 0.25F * step : -0.25F * -step;  // both zeros
  };
  TriangleSoup soup;
  for (std::size_t i = 0; i < vertices; ++i)
    soup.vertices.push_back({coordinate(values[0]), coordinate(values[1]), coordinate(values[2])});
  const auto corner = [&] { return static_cast<std::uint32_t>(random.uniform() * static_cast<double>(vertices)); };
  for (std::size_t i = 0; i < 2 * vertices; ++i) soup.triangles.push_back({corner(), corner(), corner()});
  return soup;
}

/// The same by sets, maps and repetition.
CleanSoup obviously_clean(const TriangleSoup& soup) {
  using Position = std::array<float, 3>;
  const auto position = [&](std::uint32_t v) -> Position {
    return {soup.vertices[v].x + 0.0F, soup.vertices[v].y + 0.0F, soup.vertices[v].z + 0.0F};
  };
  CleanSoup clean;
  std::set<Position> positions;
  for (const Triangle& t : soup.triangles)
    for (const std::uint32_t v : t) positions.insert(position(v));
  for (const Position& p : positions) clean.soup.vertices.push_back({p[0], p[1], p[2]});
  std::set<Triangle> triangles;
  std::map<std::array<std::uint32_t, 2>, std::vector<bool>> edges;
  std::vector<std::size_t> part(positions.size());
  std::iota(part.begin(), part.end(), std::size_t{0});
  for (Triangle t : soup.triangles) {
    for (std::uint32_t& v : t)
      v = static_cast<std::uint32_t>(std::distance(positions.begin(), positions.find(position(v))));
    const bool is_line = t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = t[i], b = t[(i + 1) % 3];
      if (!is_line) edges[{std::min(a, b), std::max(a, b)}].push_back(a < b);
      const std::size_t from = part[a];
      std::replace(part.begin(), part.end(), from, part[b]);
    }
    std::sort(t.begin(), t.end());
    triangles.insert(t);
  }
  clean.soup.triangles.assign(triangles.begin(), triangles.end());
  SoupReport& report = clean.report;
  report.duplicates = soup.triangles.size() - triangles.size();
  report.components = std::set<std::size_t>(part.begin(), part.end()).size();
  for (const auto& [edge, upward] : edges) {
    report.boundary_edges += upward.size() == 1;
    report.non_manifold_edges += upward.size() > 2;
    report.inconsistent_edges += upward.size() == 2 && upward[0] == upward[1];
  }
  return clean;
}

TEST(Soup, sorting_without_comparing_gives_what_sets_and_maps_give_at_any_thread_count) {
  const std::array<std::array<int, 3>, 4> values{{{2, 3, 1000}, {1, 1, 1}, {1000, 2, 2}, {9, 9, 9}}};
  for (std::size_t i = 0; i < values.size(); ++i) {
    const TriangleSoup soup = crowded_soup(i, 1500, values[i]);
    const CleanSoup expected = obviously_clean(soup);
    for (const int threads : {1, 5}) {
      set_thread_count(threads);
      const CleanSoup clean = clean_soup(soup);
      set_thread_count(0);
      ASSERT_EQ(clean.soup.vertices, expected.soup.vertices);
      ASSERT_EQ(clean.soup.triangles, expected.soup.triangles);
      EXPECT_EQ(clean.report.duplicates, expected.report.duplicates);
      EXPECT_EQ(clean.report.components, expected.report.components);
      EXPECT_EQ(clean.report.boundary_edges, expected.report.boundary_edges);
      EXPECT_EQ(clean.report.non_manifold_edges, expected.report.non_manifold_edges);
      EXPECT_EQ(clean.report.inconsistent_edges, expected.report.inconsistent_edges);
      for (const Vec3& v : clean.soup.vertices) EXPECT_FALSE(std::signbit(v.x) && v.x == 0);
    }
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
