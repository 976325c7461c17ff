// Which part of the input a tet belongs to, and which vertices are to be held.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "base/tet_geometry.h"
#include "shapes.h"
#include "tetsoup/tetsoup.h"

namespace tetsoup {
namespace {

/// Two balls that overlap along x, and which of them a triangle is of.
struct TwoBalls {
  TriangleSoup soup = test::joined(test::make_ball(1, {-0.8, 0, 0}), test::make_ball(1, {0.8, 0, 0}));
  std::vector<std::uint32_t> labels;
  TetMesh mesh;
  TwoBalls() {
    labels.assign(soup.triangles.size() / 2, 0);
    labels.resize(soup.triangles.size(), 1);
    MeshOptions options;
    options.distance.voxels = 48;
    mesh = mesh_soup(soup, options);
  }
};

TEST(Regions, tets_take_the_label_of_the_nearest_piece) {
  const TwoBalls balls;
  const auto regions = label_tets(balls.mesh, balls.soup, balls.labels);
  ASSERT_EQ(regions.size(), balls.mesh.tets.size());
  for (std::size_t t = 0; t < regions.size(); ++t) {
    const TetCorners p = corners_of(balls.mesh, balls.mesh.tets[t]);
    const Vec3d c = (p[0] + p[1] + p[2] + p[3]) * 0.25;
    const double left = std::abs(length(c - Vec3d{-0.8, 0, 0}) - 1), right = std::abs(length(c - Vec3d{0.8, 0, 0}) - 1);
    if (std::abs(left - right) < 0.02) continue;  // The balls have flat triangles.
    EXPECT_EQ(regions[t], left < right ? 0U : 1U) << c.x << " " << c.y << " " << c.z;
  }
}

TEST(Regions, vertices_near_a_named_piece_are_found) {
  const TwoBalls balls;
  const auto of_vertex = label_vertices(balls.mesh, balls.soup, balls.labels);
  for (std::size_t v = 0; v < of_vertex.size(); ++v) {
    const Vec3& p = balls.mesh.vertices[v];
    if (std::abs(p.x) > 1) {
      EXPECT_EQ(of_vertex[v], p.x < 0 ? 0U : 1U);
    }
  }
}

TEST(Regions, of_equally_near_triangles_the_lowest_label_counts) {
  TriangleSoup soup = test::make_box({0, 0, 0}, {1, 1, 1});
  const std::size_t count = soup.triangles.size();
  for (std::size_t i = 0; i < count; ++i) soup.triangles.push_back(Triangle(soup.triangles[i]));
  std::vector<std::uint32_t> labels(count, 7);
  labels.resize(2 * count, 3);
  const TetMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2, 3}}};
  EXPECT_EQ(label_tets(mesh, soup, labels), std::vector<std::uint32_t>({3}));
}

TEST(Regions, unusable_triangles_claim_nothing) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const TetMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2, 3}}};
  const TriangleSoup soup{{{nan, 0, 0}, {0, 0, 0}, {9, 9, 9}}, {{0, 1, 1}, {1, 1, 7}, {2, 2, 2}}};
  EXPECT_EQ(label_tets(mesh, soup, std::vector<std::uint32_t>{4, 5, 6}), std::vector<std::uint32_t>({6}));
  EXPECT_EQ(label_tets(mesh, {}, {}), std::vector<std::uint32_t>({0}));
  EXPECT_THROW(label_tets(mesh, soup, std::vector<std::uint32_t>{1}), InvalidInput);
}

TEST(Regions, parts_are_what_is_connected_and_the_largest_comes_first) {
  const TriangleSoup box = test::make_box({0, 0, 0}, {1, 1, 1});
  TriangleSoup soup = test::joined(test::joined(box, test::make_ball(1, {5, 0, 0})), box);
  const std::size_t ball = soup.triangles.size() - 2 * box.triangles.size();
  for (std::size_t i = 0; i < 8; ++i) soup.vertices[soup.vertices.size() - 1 - i].x += 9;
  std::vector<std::uint32_t> wanted(box.triangles.size(), 1);
  wanted.resize(wanted.size() + ball, 0);
  wanted.resize(wanted.size() + box.triangles.size(), 2);
  EXPECT_EQ(label_parts(soup), wanted);
  EXPECT_EQ(clean_soup(soup).report.components, 3U);
}

TEST(Regions, parts_are_joined_by_equal_positions_not_by_indices) {
  // Three loose triangles of nine vertices: two meet in one corner, where one has -0, the third stands apart.
  const TriangleSoup soup{
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-0.0F, 1, 0}, {5, 5, 5}, {5, 6, 5}, {9, 9, 9}, {9, 8, 9}, {8, 9, 9}},
      {{6, 7, 8}, {0, 1, 2}, {3, 4, 5}}};
  EXPECT_EQ(label_parts(soup), std::vector<std::uint32_t>({1, 0, 0}));
}

TEST(Regions, unusable_triangles_join_no_parts) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const TriangleSoup soup{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 5, 5}, {5, 6, 5}, {6, 5, 5}, {nan, 0, 0}},
                          {{3, 4, 5}, {0, 1, 2}, {0, 3, 6}, {0, 3, 99}}};
  EXPECT_EQ(label_parts(soup), std::vector<std::uint32_t>({0, 1, 0, 0}));
  EXPECT_EQ(label_parts({}), std::vector<std::uint32_t>());
}

TEST(Regions, boxes_and_planes_choose_vertices) {
  const TetMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2, 3}}};
  EXPECT_EQ(vertices_in_box(mesh, {{0, 0, 0}, {1, 0.5, 1}}), std::vector<std::uint32_t>({0, 1, 3}));
  EXPECT_EQ(vertices_in_box(mesh, {{2, 2, 2}, {3, 3, 3}}), std::vector<std::uint32_t>());
  EXPECT_EQ(vertices_below(mesh, {0, 0, 2}, 1), std::vector<std::uint32_t>({0, 1, 2}));
  EXPECT_EQ(vertices_below(mesh, {0, 0, -1}, -1), std::vector<std::uint32_t>({3}));
  EXPECT_THROW(vertices_below(mesh, {0, 0, 0}, 1), InvalidInput);
  EXPECT_THROW(vertices_below(mesh, {0, std::numeric_limits<double>::infinity(), 0}, 1), InvalidInput);
}

}  // namespace
}  // namespace tetsoup
