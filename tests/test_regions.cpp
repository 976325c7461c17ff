// Which part of the input a tet belongs to, and which vertices are to be held.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include "base/tet_geometry.h"
#include "shapes.h"
#include "tetsoup/tetsoup.h"

namespace tetsoup {
namespace {

/// Two balls that overlap along x, and which of them a triangle is of.
struct TwoBalls {
  TriangleSoup soup;
  std::vector<std::uint32_t> labels;
  TetMesh mesh;
  explicit TwoBalls(double right = 1) {
    const TriangleSoup left = test::make_ball(1, {-0.8, 0, 0});
    soup = test::joined(left, test::make_ball(right, {0.8, 0, 0}));
    labels.assign(left.triangles.size(), 0);
    labels.resize(soup.triangles.size(), 1);
    MeshOptions options;
    options.distance.voxels = 48;
    mesh = mesh_soup(soup, options);
  }
  double distance(std::size_t tet, double x) const {
    const TetCorners p = corners_of(mesh, mesh.tets[tet]);
    return length((p[0] + p[1] + p[2] + p[3]) * 0.25 - Vec3d{x, 0, 0});
  }
};

/// Share of the volume whose label is that of the tet it lies in.
template <class LabelAt>
double label_share(const TetMesh& mesh, std::span<const std::uint32_t> labels, const LabelAt& label_at) {
  test::Random random(3);
  double right = 0, all = 0;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const TetCorners p = corners_of(mesh, mesh.tets[t]);
    constexpr int kPoints = 100;
    const double each = signed_volume(p) / kPoints;
    for (int i = 0; i < kPoints; ++i) {
      std::array<double, 4> w{};
      double sum = 0;
      for (double& x : w) sum += x = -std::log(random.uniform(1e-12));
      const Vec3d at = (p[0] * w[0] + p[1] * w[1] + p[2] * w[2] + p[3] * w[3]) * (1 / sum);
      right += label_at(at) == labels[t] ? each : 0;
      all += each;
    }
  }
  return right / all;
}

/// Soups one after the other, and labels from 0.
struct Labelled {
  TriangleSoup soup;
  std::vector<std::uint32_t> labels;
  void add(const TriangleSoup& part) {
    const std::uint32_t label = labels.empty() ? 0 : labels.back() + 1;
    soup = soup.triangles.empty() ? part : test::joined(soup, part);
    labels.resize(soup.triangles.size(), label);
  }
};

TriangleSoup turned(TriangleSoup soup) {
  for (Triangle& t : soup.triangles) std::swap(t[0], t[1]);
  return soup;
}

TEST(Regions, tets_of_closed_parts_take_the_label_they_lie_in) {
  const TwoBalls balls(0.9);
  const auto regions = label_tets(balls.mesh, balls.soup, balls.labels);
  ASSERT_EQ(regions.size(), balls.mesh.tets.size());
  for (std::size_t t = 0; t < regions.size(); ++t) {
    const double away = balls.distance(t, 0.8) - 0.9;
    if (std::abs(away) < 0.1 || balls.distance(t, -0.8) > 1) continue;  // Cut, or by what is nearest.
    EXPECT_EQ(regions[t], away < 0 ? 1U : 0U);  // Where both are around, the lesser one is the inner one.
  }
}

TEST(Regions, tets_of_open_parts_take_the_label_of_the_nearest) {
  TwoBalls balls;
  const std::size_t half = balls.soup.triangles.size() / 2;
  for (const std::size_t gone : {2 * half - 1, half - 1}) {
    balls.soup.triangles.erase(balls.soup.triangles.begin() + static_cast<std::ptrdiff_t>(gone));
    balls.labels.erase(balls.labels.begin() + static_cast<std::ptrdiff_t>(gone));
  }
  const auto regions = label_tets(balls.mesh, balls.soup, balls.labels);
  for (std::size_t t = 0; t < regions.size(); ++t) {
    const double left = std::abs(balls.distance(t, -0.8) - 1), right = std::abs(balls.distance(t, 0.8) - 1);
    if (std::abs(left - right) < 0.15) continue;
    EXPECT_EQ(regions[t], left < right ? 0U : 1U);
  }
  EXPECT_EQ(fit_to_labels(balls.mesh, balls.soup, balls.labels).vertices, balls.mesh.vertices);
}

TEST(Regions, shares_of_nested_balls_are_their_volumes) {
  Labelled nested;
  for (const double radius : {1.0, 0.8, 0.4}) nested.add(test::make_ball(radius));
  MeshOptions options;
  options.lattice.tets = 2000;
  const TetMesh mesh = mesh_soup(nested.soup, options);
  const TetLabels shares = share_tets(mesh, nested.soup, nested.labels);
  ASSERT_EQ(shares.size(), mesh.tets.size());
  std::array<double, 3> volumes{};
  for (std::size_t t = 0; t < shares.size(); ++t) {
    double sum = 0;
    for (const LabelShare& s : shares[t]) {
      volumes[s.label] += static_cast<double>(s.share) * signed_volume(corners_of(mesh, mesh.tets[t]));
      sum += static_cast<double>(s.share);
      EXPECT_LE(s.share, shares[t].front().share);
    }
    EXPECT_NEAR(sum, 1, 1e-6);
  }
  const auto ball = [](double r) { return 4 * std::numbers::pi / 3 * r * r * r; };
  EXPECT_NEAR(volumes[2], ball(0.4), 0.03 * ball(0.4));
  EXPECT_NEAR(volumes[1], ball(0.8) - ball(0.4), 0.03 * ball(0.8));
  EXPECT_EQ(largest_of(shares), label_tets(mesh, nested.soup, nested.labels));
}

TEST(Regions, a_hollow_of_a_label_is_not_in_it) {
  const TetMesh mesh{{{0, 0, 0}, {0.1F, 0, 0}, {0, 0.1F, 0}, {0, 0, 0.1F}}, {{0, 1, 2, 3}}};
  Labelled shell;  // A shell around what is larger than what lies around it all, and smaller than the shell's own.
  shell.add(test::joined(test::make_ball(1), turned(test::make_ball(0.5))));
  shell.add(test::make_ball(2));
  EXPECT_EQ(label_tets(mesh, shell.soup, shell.labels), std::vector<std::uint32_t>({1}));
  Labelled solid;  // Not turned: filled.
  solid.add(test::joined(test::make_ball(1), test::make_ball(0.5)));
  solid.add(test::make_ball(2));
  EXPECT_EQ(label_tets(mesh, solid.soup, solid.labels), std::vector<std::uint32_t>({0}));
}

TEST(Regions, the_innermost_is_the_part_of_the_least_volume_not_the_label) {
  // A label of two parts, of which one is large, within a part of another label.
  const TetMesh mesh{{{0, 0, 0}, {0.1F, 0, 0}, {0, 0.1F, 0}, {0, 0, 0.1F}}, {{0, 1, 2, 3}}};
  Labelled soup;
  soup.add(test::make_ball(1));
  soup.add(test::joined(test::make_ball(0.5), test::make_ball(4, {9, 0, 0})));
  EXPECT_EQ(label_tets(mesh, soup.soup, soup.labels), std::vector<std::uint32_t>({1}));
}

TEST(Regions, windings_and_order_leave_no_trace_in_labels) {
  TwoBalls balls(0.9);
  const auto regions = label_tets(balls.mesh, balls.soup, balls.labels);
  for (std::size_t t = 0; t < balls.soup.triangles.size(); t += 3)
    std::swap(balls.soup.triangles[t][1], balls.soup.triangles[t][2]);
  EXPECT_EQ(label_tets(balls.mesh, balls.soup, balls.labels), regions);
}

TEST(Regions, faces_between_tets_follow_the_borders_of_layers) {
  Labelled layers;
  for (int i = 0; i < 5; ++i) layers.add(test::make_box({0, 0, 0.2 * i}, {1, 1, 0.2 * (i + 1)}));
  const auto layer_at = [](const Vec3d& p) {
    return static_cast<std::uint32_t>(std::clamp(std::floor(p.z / 0.2), 0.0, 4.0));
  };
  MeshOptions options;
  options.lattice.tets = 2000;
  const TetMesh mesh = mesh_soup(layers.soup, options);
  const TetMesh fitted = fit_to_labels(mesh, layers.soup, layers.labels, options.smooth);
  EXPECT_LT(label_share(mesh, label_tets(mesh, layers.soup, layers.labels), layer_at), 0.93);
  EXPECT_GT(label_share(fitted, label_tets(fitted, layers.soup, layers.labels), layer_at), 0.97);
  const Quality before = measure_quality(mesh), after = measure_quality(fitted);
  EXPECT_EQ(fitted.vertices.size(), mesh.vertices.size());
  EXPECT_TRUE(after.boundary_manifold);
  EXPECT_EQ(after.components, 1U);
  EXPECT_EQ(after.inverted_tets, 0U);
  EXPECT_GE(after.min_dihedral, std::min(before.min_dihedral, options.smooth.min_dihedral) - 1e-4);
  EXPECT_NEAR(after.volume, before.volume, 0.003 * before.volume);
  EXPECT_LT(boundary_distance(fitted, layers.soup, 0.1).mean, boundary_distance(mesh, layers.soup, 0.1).mean + 0.01);
  EXPECT_EQ(fit_to_labels(mesh, layers.soup, layers.labels, options.smooth).vertices, fitted.vertices);
}

TEST(Regions, skins_thinner_than_a_tet_are_labelled_rightly_too) {
  Labelled nested;
  for (const double radius : {0.5, 0.4, 0.2}) nested.add(test::make_ball(radius));
  MeshOptions options;
  options.lattice.tets = 2000;
  const TetMesh mesh = mesh_soup(nested.soup, options);
  const TetMesh fitted = fit_to_labels(mesh, nested.soup, nested.labels, options.smooth);
  const auto label_at = [](const Vec3d& p) { return length(p) < 0.2 ? 2U : length(p) < 0.4 ? 1U : 0U; };
  EXPECT_GT(label_share(fitted, label_tets(fitted, nested.soup, nested.labels), label_at), 0.97);
  const Quality before = measure_quality(mesh), after = measure_quality(fitted);
  EXPECT_NEAR(after.volume, before.volume, 0.006 * before.volume);
  EXPECT_EQ(after.inverted_tets, 0U);
  EXPECT_TRUE(after.boundary_manifold);
  EXPECT_GE(after.min_dihedral, std::min(before.min_dihedral, options.smooth.min_dihedral) - 1e-4);
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
