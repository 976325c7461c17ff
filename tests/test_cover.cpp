// What the lattice covers besides what is dense: thin parts, the soup's vertices; and what it leaves out.
#include <gtest/gtest.h>

#include "base/bits.h"
#include "lattice/body_voxels.h"
#include "base/tet_locator.h"
#include "lattice_shapes.h"
#include "shapes.h"
#include "stages.h"
#include "tetsoup/lattice.h"
#include "tetsoup/quality.h"
#include "tetsoup/samples.h"

namespace tetsoup {
namespace {

using test::classify;
using test::fill;
using test::joined;
using test::make_ball;
using test::Stages;

/// Cells of this edge; density and thin parts only, no clean-up.
LatticeOptions plain(double cell_size, LatticeKind kind = LatticeKind::Five) {
  LatticeOptions options;
  options.cell_size = cell_size;
  options.kind = kind;
  options.separate = Separate::Together;
  options.topology = {Touching::Leave, 0, Bubbles::Keep, BoundaryOnly::Leave};
  return options;
}

/// A closed rod with round ends, down from a point.
TriangleSoup make_rod(Vec3d top, double length, double radius) {
  return test::make_globe(12, 16, [=](Vec3d p) {
    return top + Vec3d{p.x * radius, p.y * radius, p.z * radius - (p.z < 0 ? length : 0)};
  });
}

TriangleSoup ball_on_rod(double radius) {
  return joined(make_ball(1), make_rod({0.03, 0.04, -0.7}, 2.5, radius));
}

double lowest(const TetMesh& mesh) {
  double z = 1e300;
  for (const Vec3& v : mesh.vertices) z = std::min(z, static_cast<double>(v.z));
  return z;
}

class Kinds : public testing::TestWithParam<std::tuple<LatticeKind, double>> {
 protected:
  LatticeOptions options(double cell_size) const {
    LatticeOptions o = plain(cell_size, std::get<0>(GetParam()));
    const double shift = std::get<1>(GetParam());
    o.translate_cells = {shift, shift, shift};
    return o;
  }
};
INSTANTIATE_TEST_SUITE_P(Lattice, Kinds,
                         testing::Combine(testing::Values(LatticeKind::Five, LatticeKind::Bcc),
                                          testing::Values(0, 0.3, 0.5)));

TEST_P(Kinds, a_rod_too_thin_for_any_tet_stays_on_its_ball_down_to_its_end) {
  const double cell = 0.4, radius = 0.08, end = -0.7 - 2.5 - radius;
  const Stages s = classify(ball_on_rod(radius), 100);
  LatticeOptions o = options(cell);
  const LatticeMesh kept = fill(s, o);
  EXPECT_GT(kept.report.thin_tets, 5U);
  EXPECT_LT(lowest(kept.mesh), end + 1.2 * cell);  // a tip shorter than the next tet may be lost
  EXPECT_EQ(measure_quality(kept.mesh).components, 1U);
  o.thin = Thin::Drop;
  EXPECT_LT(fill(s, o).report.tet_count + 5, kept.report.tet_count);
  for (const Vec3& v : kept.mesh.vertices) {
    if (v.z < -1.6F) {
      EXPECT_LT(std::hypot(v.x, v.y), 1.5 * cell);
    }
  }
}

TEST_P(Kinds, a_rod_that_density_cuts_in_pieces_is_joined) {
  const double cell = 0.4;
  const Stages s = classify(ball_on_rod(0.16), 100);
  LatticeOptions o = options(cell);
  const LatticeMesh kept = fill(s, o);
  EXPECT_EQ(measure_quality(kept.mesh).components, 1U);
  EXPECT_LT(lowest(kept.mesh), -0.7 - 2.5 + 0.6 * cell);
  o.thin = Thin::Drop;
  EXPECT_LE(fill(s, o).report.tet_count, kept.report.tet_count);
}

TEST_P(Kinds, what_is_covered_gets_no_thicker) {
  for (const TriangleSoup& soup : {make_ball(1), test::make_box({-0.93, -0.57, -0.31}, {1, 0.61, 0.33})}) {
    const Stages s = classify(soup, 64);
    LatticeOptions o = options(0.25);
    const LatticeMesh kept = fill(s, o);
    o.thin = Thin::Drop;
    const LatticeMesh dropped = fill(s, o);
    EXPECT_EQ(kept.report.thin_tets, 0U);
    EXPECT_EQ(kept.mesh.tets, dropped.mesh.tets);
    EXPECT_EQ(kept.mesh.vertices, dropped.mesh.vertices);
  }
}

TEST_P(Kinds, every_vertex_is_enclosed_by_no_more_tets_than_hold_one) {
  for (const char* name : {"torus", "robot"}) {
    const Stages s = classify(make_sample(name), 64);
    LatticeOptions o;
    o.tets = 1000;
    o.kind = std::get<0>(GetParam());
    o.cover = Cover::Enclose;
    const LatticeMesh enclosed = fill(s, o);
    EXPECT_GT(enclosed.report.enclosing_tets, 0U);
    const TetLocator locator(enclosed.mesh);
    for (const Vec3& v : s.soup.soup.vertices) {
      std::size_t holders = 0;
      locator.visit_holders(to_double(v), [&](std::uint32_t) { ++holders; });
      ASSERT_GT(holders, 0U) << name;
    }
    EXPECT_TRUE(measure_quality(enclosed.mesh).boundary_manifold);

    o = plain(enclosed.report.cell_size, o.kind);
    o.thin = Thin::Drop;
    const std::size_t before = fill(s, o).mesh.tets.size();
    o.cover = Cover::Enclose;
    const LatticeMesh least = fill(s, o);
    EXPECT_EQ(least.mesh.tets.size(), before + least.report.enclosing_tets);
  }
}

TEST_P(Kinds, the_inside_cover_adds_nothing_beyond_the_volume) {
  const Stages s = classify(ball_on_rod(0.16), 100);
  LatticeOptions o = options(0.2);
  o.cover = Cover::Inside;
  o.topology = {};
  const LatticeMesh inside = fill(s, o);
  EXPECT_GT(inside.report.tet_count, 100U);
  EXPECT_LT(inside.report.excess_volume, 0.002 * inside.report.pseudo_volume);
  o.cover = Cover::Density;
  EXPECT_GT(fill(s, o).report.excess_volume, 0.02 * inside.report.pseudo_volume);
}

TEST(Cover, the_inside_cover_of_a_body_without_a_full_tet_is_not_empty) {
  const Stages s = classify(make_ball(1), 40);
  LatticeOptions o = plain(1.9);
  o.cover = Cover::Inside;
  EXPECT_GT(fill(s, o).report.tet_count, 0U);
}

TEST(Cover, a_leaf_without_volume_is_covered_where_a_body_has_it) {
  TriangleSoup leaf;
  constexpr std::uint32_t kRow = 13;
  for (std::uint32_t i = 0; i < kRow; ++i)
    for (const double y : {-0.4, 0.4}) leaf.vertices.push_back(to_float({0.6 + 0.2 * i, y, 0.1 + 0.02 * i}));
  for (std::uint32_t i = 0; i + 1 < kRow; ++i) {
    leaf.triangles.push_back({2 * i, 2 * i + 1, 2 * i + 2});
    leaf.triangles.push_back({2 * i + 1, 2 * i + 3, 2 * i + 2});
  }
  // The volume of the ball alone: what becomes of a leaf in it is another stage's matter.
  const Stages both = classify(joined(make_ball(1), leaf), 100);
  DistanceOptions options;
  options.voxels = 100;
  options.box = both.soup.report.box;
  const Stages s{both.soup, classify_volume(unsigned_distance(clean_soup(make_ball(1)), options))};
  const auto farthest = [](const TetMesh& mesh) {
    float x = 0;
    for (const Vec3& v : mesh.vertices) x = std::max(x, v.x);
    return x;
  };
  LatticeOptions o = plain(0.35);
  o.thin = Thin::Drop;
  EXPECT_LT(farthest(fill(s, o).mesh), 1.8);
  o.thin = Thin::Keep;
  const LatticeMesh kept = fill(s, o);
  EXPECT_GT(farthest(kept.mesh), 2.7);
  EXPECT_EQ(measure_quality(kept.mesh).components, 1U);
}

TEST(Cover, boxes_with_a_slit_of_a_third_of_a_cell_are_two_unless_asked_for_together) {
  const double cell = 0.25, slit = 0.3 * cell;
  const Stages s = classify(joined(test::make_box({-1, -0.5, -0.5}, {-slit / 2, 0.5, 0.5}),
                                   test::make_box({slit / 2, -0.5, -0.5}, {1, 0.5, 0.5})),
                            128);
  LatticeOptions o;
  o.cell_size = cell;
  o.translate_cells = {0.4, 0, 0};
  const LatticeMesh apart = fill(s, o);
  EXPECT_EQ(measure_quality(apart.mesh).components, 2U);
  EXPECT_GT(apart.report.parted_vertices, 0U);
  o.separate = Separate::Together;
  EXPECT_EQ(measure_quality(fill(s, o).mesh).components, 1U);
}

TEST(TetLocator, slivers_as_long_as_the_body_and_flat_tets_take_no_more_than_their_share) {
  // Needles along the diagonal of a cube: each box is all of it.
  TetMesh mesh;
  test::Random random(5);
  for (std::uint32_t t = 0; t < 300; ++t) {
    const auto near = [&](float at) {
      const auto c = [&] { return at + 0.01F * static_cast<float>(random.uniform(-1, 1)); };
      mesh.vertices.push_back({c(), c(), c()});
    };
    for (const float at : {0.0F, 0.0F, 0.0F, 1.0F}) near(at);
    Tet tet{4 * t, 4 * t + 1, 4 * t + 2, 4 * t + 3};
    if (signed_volume(corners_of(mesh, tet)) < 0) std::swap(tet[0], tet[1]);
    mesh.tets.push_back(tet);
  }
  const std::size_t needles = mesh.tets.size();
  for (std::size_t t = 0; t < needles; ++t)
    mesh.tets.push_back({mesh.tets[t][0], mesh.tets[t][1], mesh.tets[t][2], mesh.tets[t][0]});
  const TetLocator locator(mesh);
  EXPECT_LE(locator.entry_count(), 250 * needles);
  for (std::uint32_t t = 0; t < needles; ++t) {
    Vec3d middle;
    for (const Vec3d& corner : corners_of(mesh, mesh.tets[t])) middle += corner * 0.25;
    bool found = false;
    locator.visit_holders(middle, [&](std::uint32_t holder) { found = found || holder == t; });
    EXPECT_TRUE(found) << t;
  }
}

TEST(TetLocator, finds_the_tets_that_hold_a_point) {
  const TetMesh mesh = block_mesh({4, 3, 2}, 0.7);
  const TetLocator locator(mesh);
  test::Random random(3);
  for (int i = 0; i < 2000; ++i) {
    const Vec3d p{random.uniform(-0.5, 3.3), random.uniform(-0.5, 2.6), random.uniform(-0.5, 1.9)};
    std::vector<std::uint32_t> found, expected;
    locator.visit_holders(p, [&](std::uint32_t t) { found.push_back(t); });
    bool is_clear = true;  // no face so near that rounding decides
    for (std::uint32_t t = 0; t < mesh.tets.size(); ++t) {
      double least = 1e300;
      for (std::size_t k = 0; k < 4; ++k) {
        TetCorners c;
        for (std::size_t j = 0; j < 4; ++j) c[j] = j == k ? p : to_double(mesh.vertices[mesh.tets[t][j]]);
        least = std::min(least, signed_volume(c));
      }
      is_clear = is_clear && std::abs(least) > 1e-4;
      if (least > 0) expected.push_back(t);
    }
    if (is_clear) {
      ASSERT_EQ(found, expected);
    }
  }
  std::size_t far = 0;
  locator.visit_holders({1e300, -1e300, 0}, [&](std::uint32_t) { ++far; });
  EXPECT_EQ(far, 0U);
}

TEST(BodyVoxels, hold_what_is_inside_and_the_soup_where_it_has_nothing_inside_beside_it) {
  const TriangleSoup confetti = test::make_confetti(40, 0.3, 7);
  const Stages s = classify(confetti, 50);
  const Progress nobody;
  StageWatch watch(nobody, "lattice");
  const BitGrid body = body_voxels(s.volume.inside, s.soup, watch);
  const GridFrame& grid = body.frame;
  for (std::size_t w = 0; w < body.words.size(); ++w) EXPECT_EQ(s.volume.inside.words[w] & ~body.words[w], 0U);
  const BitRows rows(body);
  test::Random random(2);
  int missed = 0, points = 0;
  for (const Triangle& t : s.soup.soup.triangles) {
    for (int i = 0; i < 100; ++i, ++points) {
      double a = random.uniform(), b = random.uniform();
      if (a + b > 1) a = 1 - a, b = 1 - b;
      const auto at = [&](std::size_t k) { return to_double(s.soup.soup.vertices[t[k]]); };
      const Vec3d p = (at(0) * (1 - a - b) + at(1) * a + at(2) * b - grid.origin) * (1 / grid.voxel_size);
      const auto whole = [](double x) { return static_cast<int>(std::floor(x + 0.5)); };
      const int x = whole(p.x);
      missed += (rows.grown(whole(p.y), whole(p.z), static_cast<std::size_t>(x / 64)) >> (x % 64) & 1U) == 0;
    }
  }
  EXPECT_LT(missed, points / 100);
}

TEST(BodyVoxels, of_a_closed_body_are_those_inside) {
  const Stages s = classify(make_ball(1), 50);
  const Progress nobody;
  StageWatch watch(nobody, "lattice");
  EXPECT_EQ(body_voxels(s.volume.inside, s.soup, watch).words, s.volume.inside.words);
}

}  // namespace
}  // namespace tetsoup
