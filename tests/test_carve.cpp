// Carving: the cover of a body becomes the mesh, and neither pieces nor tunnels nor thin parts are lost on the way.
#include <gtest/gtest.h>

#include <cmath>

#include "lattice_shapes.h"
#include "shapes.h"
#include "solid_candidates.h"
#include "stages.h"
#include "tetsoup/lattice.h"
#include "tetsoup/tetsoup.h"
#include "tetsoup/quality.h"
#include "tetsoup/samples.h"

namespace tetsoup {
namespace {

using test::classify;
using test::euler_characteristic;
using test::fill;
using test::Stages;

/// A box, turned about all axes so that no side lies along the lattice.
TriangleSoup turned_box(const Vec3d& half) {
  TriangleSoup soup = test::make_box(half * -1, half);
  for (Vec3& v : soup.vertices) {
    const Vec3d p = to_double(v);
    const Vec3d q{0.8 * p.x - 0.6 * p.y, 0.6 * p.x + 0.8 * p.y, p.z};
    v = to_float({q.x, 0.8 * q.y - 0.6 * q.z, 0.6 * q.y + 0.8 * q.z});
  }
  return soup;
}

TEST(Carve, a_plate_a_tenth_of_a_tet_thick_is_one_layer_without_a_hole) {
  const Stages s = classify(turned_box({1, 1, 0.015}), 200);
  LatticeOptions options;
  for (const std::size_t tets : {300U, 1000U}) {
    options.tets = tets;
    const LatticeMesh plate = fill(s, options);
    EXPECT_EQ(euler_characteristic(plate.mesh), 1) << tets;
    EXPECT_EQ(measure_quality(plate.mesh).components, 1U);
    EXPECT_LT(plate.report.kept_volume, 4 * 1.0 * plate.report.mean_edge) << "no more than an edge thick";
  }
}

TEST(Carve, a_rod_a_tenth_of_a_tet_thick_is_one_string_to_its_ends) {
  const Stages s = classify(turned_box({1, 0.012, 0.012}), 300);
  LatticeOptions options;
  options.tets = 150;
  const LatticeMesh rod = fill(s, options);
  EXPECT_EQ(euler_characteristic(rod.mesh), 1);
  for (const double end : {-1.0, 1.0}) {
    const Vec3d tip = Vec3d{0.8, 0.48, 0.36} * end;
    double nearest = 1e300;
    for (const Vec3& v : rod.mesh.vertices) nearest = std::min(nearest, length(to_double(v) - tip));
    EXPECT_LT(nearest, rod.report.mean_edge);
  }
}

/// A bar with three sides from `from` to `to`, whose corners are `radius` from its middle.
TriangleSoup make_spar(const Vec3d& from, const Vec3d& to, double radius) {
  const Vec3d along = to - from;
  Vec3d u = cross(along, {0, 0, 1}), v = cross(along, u);
  u = u * (radius / length(u));
  v = v * (radius / length(v));
  TriangleSoup spar;
  for (const Vec3d& end : {from, to})
    for (const double angle : {0.0, 2.0944, 4.1888})
      spar.vertices.push_back(to_float(end + u * std::cos(angle) + v * std::sin(angle)));
  spar.triangles = {{0, 2, 1}, {3, 4, 5}};
  for (std::uint32_t i = 0; i < 3; ++i) {
    const std::uint32_t j = (i + 1) % 3;
    spar.triangles.push_back({i, j, 3 + i});
    spar.triangles.push_back({j, 3 + j, 3 + i});
  }
  return spar;
}

TEST(Carve, a_bar_of_a_voxel_that_sticks_out_of_a_box_is_one_piece_with_it) {
  struct Case {
    Vec3d tip;
    double radius;
  };
  const TriangleSoup box = test::make_box({-1, -1, -1}, {1, 1, 1});
  // Its voxels are dashes.
  for (const auto& [tip, radius] : {Case{{5, 2.3, 1.1}, 0.02}, {{4, 0.7, 0.9}, 0.03}, {{4, 0.7, 0.9}, 0.02}}) {
    MeshOptions options;
    options.lattice.tets = 2000;
    const TetMesh mesh = mesh_soup(test::joined(box, make_spar({0, 0, 0.2}, tip, radius)), options);
    EXPECT_EQ(measure_quality(mesh).components, 1U) << tip.x << ", " << radius;
  }
}

TEST(Carve, a_thin_ring_keeps_its_hole) {
  const Stages s = classify(make_sample("torus"), 128);
  LatticeOptions options;
  options.tets = 150;
  EXPECT_EQ(euler_characteristic(fill(s, options).mesh), 0);
}

TEST(Carve, what_encloses_the_vertices_of_a_body_is_one_piece_with_it) {
  for (const TriangleSoup& soup : {turned_box({1, 0.7, 0.4}), make_sample("torus"), test::make_ball(1)}) {
    const Stages s = classify(soup, 100);
    LatticeOptions options;
    options.cover = Cover::Enclose;
    const LatticeMesh mesh = fill(s, options);
    EXPECT_EQ(measure_quality(mesh.mesh).components, 1U);
    EXPECT_TRUE(measure_quality(mesh.mesh).boundary_manifold);
  }
}

}  // namespace
}  // namespace tetsoup
