// Flat sides of the soup: found, met by the lattice, and kept by smoothing.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/soup_planes.h"
#include "lattice/flat_sides.h"
#include "shapes.h"
#include "smooth_shapes.h"
#include "tetsoup/quality.h"
#include "tetsoup/tetsoup.h"

namespace tetsoup {

using test::make_box;

constexpr double kDegrees = std::numbers::pi / 180;

/// About an axis that is none of the soup's own.
TriangleSoup turned(TriangleSoup soup) {
  const double c = std::cos(0.6), s = std::sin(0.6), d = std::cos(0.35), e = std::sin(0.35);
  for (Vec3& v : soup.vertices) {
    const Vec3d p = to_double(v), q{c * p.x - s * p.y, s * p.x + c * p.y, p.z};
    v = to_float({q.x, d * q.y - e * q.z, e * q.y + d * q.z});
  }
  return soup;
}

/// With so many sides, around z.
TriangleSoup prism(std::uint32_t sides, double radius, double height) {
  TriangleSoup soup;
  for (std::uint32_t i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    for (const double z : {0.0, height}) {
      soup.vertices.push_back(to_float({radius * std::cos(angle), radius * std::sin(angle), z}));
    }
  }
  for (std::uint32_t i = 0; i < sides; ++i) {
    const std::uint32_t a = 2 * i, b = 2 * ((i + 1) % sides);
    soup.triangles.push_back({a, b, b + 1});
    soup.triangles.push_back({a, b + 1, a + 1});
    if (i + 2 < sides) {
      soup.triangles.push_back({0, 2 * (i + 2), 2 * (i + 1)});
      soup.triangles.push_back({1, 2 * (i + 1) + 1, 2 * (i + 2) + 1});
    }
  }
  return soup;
}

SoupPlanes planes_of(const TriangleSoup& soup, double width) {
  const Progress none;
  StageWatch watch(none, "test");
  return find_planes(soup, width, watch);
}

/// Share of the boundary's area that is tilted by more than so many degrees against every plane of the soup.
double tilted(const TetMesh& mesh, const SoupPlanes& soup, double degrees) {
  double all = 0, wrong = 0;
  for (const Triangle& t : boundary_triangles(mesh)) {
    const Vec3d a = to_double(mesh.vertices[t[0]]);
    const Vec3d n = cross(to_double(mesh.vertices[t[1]]) - a, to_double(mesh.vertices[t[2]]) - a);
    double most = 0;
    for (const SoupPlane& p : soup.planes) most = std::max(most, std::abs(dot(p.normal, n)) / length(n));
    all += length(n);
    wrong += most < std::cos(degrees * kDegrees) ? length(n) : 0;
  }
  return wrong / all;
}

TEST(SoupPlanes, of_a_box_are_its_six_sides_whatever_the_order_and_winding) {
  const TriangleSoup box = turned(make_box({0, 0, 0}, {3, 2, 1}));
  const SoupPlanes found = planes_of(box, 0.3), other = planes_of(test::scrambled(box, 7), 0.3);
  ASSERT_EQ(found.planes.size(), 6U);
  ASSERT_EQ(other.planes.size(), 6U);
  EXPECT_NEAR(found.area, 22, 1e-5);
  EXPECT_NEAR(found.planes.front().area, 6, 1e-5);
  EXPECT_NEAR(found.planes.back().area, 2, 1e-5);
  for (const std::uint32_t plane : found.plane_of) EXPECT_LT(plane, 6U);
}

TEST(SoupPlanes, that_are_bent_or_narrower_than_asked_for_are_none) {
  EXPECT_TRUE(planes_of(test::make_ball(1), 0.3).planes.empty());
  EXPECT_EQ(planes_of(prism(96, 1, 4), 0.3).planes.size(), 2U) << "the ends";
  EXPECT_EQ(planes_of(make_box({0, 0, 0}, {3, 2, 0.1}), 0.3).planes.size(), 2U);
  EXPECT_TRUE(planes_of({}, 0.3).planes.empty());
}

TEST(FlatSides, of_a_turned_box_are_as_far_apart_as_its_sides_and_of_a_ball_there_are_none) {
  const Progress none;
  StageWatch watch(none, "test");
  EXPECT_FALSE(find_flat_sides(test::make_ball(1), 0.3, watch));
  const auto sides = find_flat_sides(turned(make_box({1, 2, 3}, {4, 4, 4})), 0.3, watch);
  ASSERT_TRUE(sides);
  double volume = 1;
  for (const FlatSides::Axis& axis : sides->axes) volume *= axis.hi - axis.lo;
  EXPECT_NEAR(volume, 6, 1e-5);
}

TEST(FlatSides, boxes_come_out_as_boxes_at_any_count_and_turn) {
  for (const TriangleSoup& box : {make_box({0, 0, 0}, {1, 1, 1}), turned(make_box({0, 0, 0}, {3, 1, 0.5}))}) {
    for (const std::size_t wanted : {500U, 2000U, 5000U}) {
      SCOPED_TRACE(wanted);
      Pipeline pipeline(box);
      MeshOptions options;
      options.lattice.tets = wanted;
      const TetMesh& mesh = pipeline.run(options).mesh;
      const auto count = static_cast<double>(wanted);
      EXPECT_NEAR(static_cast<double>(mesh.tets.size()), count, 0.05 * count);
      EXPECT_LT(tilted(mesh, planes_of(box, 0.1), 2), 0.01);
      const Vec3d s = pipeline.lattice().report.stretch;
      EXPECT_LT(std::max({s.x, s.y, s.z}) / std::min({s.x, s.y, s.z}), 1.301);
    }
  }
}

TEST(FlatSides, a_step_between_the_faces_of_cells_is_flat_too) {
  const TriangleSoup stairs = test::joined(make_box({0, 0, 0}, {2, 1, 1.5}), make_box({0, 0.5, 0}, {1.13, 2.21, 1.5}));
  EXPECT_LT(tilted(mesh_soup(stairs), planes_of(stairs, 0.2), 25), 0.01);
}

TEST(FlatSides, a_plate_thinner_than_a_tet_is_one_flat_layer_to_its_corners) {
  for (const TriangleSoup& plate : {make_box({0, 0, 0}, {2, 1, 0.03}), turned(make_box({0, 0, 0}, {1, 0.05, 1.3}))}) {
    Pipeline pipeline(plate);
    const TetMesh& mesh = pipeline.run().mesh;
    EXPECT_NEAR(static_cast<double>(mesh.tets.size()), 2000, 100);
    const SoupPlanes sides = planes_of(plate, 0.02);
    const double rim = 1 - (sides.planes[0].area + sides.planes[1].area) / sides.area;
    EXPECT_LT(tilted(mesh, sides, 10), rim + 0.01) << "no rim is wider than a tet";
    double largest = 0;
    for (const Vec3& corner : plate.vertices) {
      double least = 1e300;
      for (const Vec3& v : mesh.vertices) least = std::min(least, length(to_double(v) - to_double(corner)));
      largest = std::max(largest, least);
    }
    EXPECT_LT(largest, 0.5 * pipeline.lattice().report.mean_edge);
  }
}

TEST(FlatSides, oblique_sides_come_out_plane_and_their_edges_sharp) {
  for (const std::uint32_t sides : {6U, 8U}) {
    SCOPED_TRACE(sides);
    const TriangleSoup soup = prism(sides, 1, 1.2);
    EXPECT_LT(tilted(mesh_soup(soup), planes_of(soup, 0.2), 25), 0.05);
  }
}

TEST(FlatSides, a_frame_or_a_size_that_is_given_stays) {
  Pipeline pipeline(make_box({0, 0, 0}, {1, 1, 1}));
  const auto stretch = [&](const LatticeOptions& lattice) {
    MeshOptions options;
    options.lattice = lattice;
    pipeline.run_until(Stage::Lattice, options);
    return pipeline.lattice().report.stretch;
  };
  const Vec3d cube{1, 1, 1};
  EXPECT_FALSE(stretch({}) == cube);
  LatticeOptions given;
  given.cells = 7;
  EXPECT_TRUE(stretch(given) == cube);
  given = {}, given.translate_cells = {0.2, 0, 0};
  EXPECT_TRUE(stretch(given) == cube);
  given = {}, given.rotate = {0, 0.1, 0};
  EXPECT_TRUE(stretch(given) == cube);
  given = {}, given.fit = Fit::Search;
  EXPECT_TRUE(stretch(given) == cube);
}

}  // namespace tetsoup
