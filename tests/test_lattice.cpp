// Stage 4: the split of a cube, exact counting, and what is kept where density leaves nothing.
#include <gtest/gtest.h>

#include <map>
#include <numbers>
#include <set>

#include "base/tet_geometry.h"
#include "lattice/five_tets.h"
#include "shapes.h"
#include "stages.h"
#include "tetsoup/error.h"
#include "tetsoup/lattice.h"
#include "tetsoup/quality.h"
#include "tetsoup/samples.h"

namespace tetsoup {
namespace {

using test::classify;
using test::fill;
using test::Stages;

LatticeOptions with_cells(int cells) {
  LatticeOptions options;
  options.cells = cells;
  return options;
}

/// Density decides, and nothing is mended afterwards.
LatticeOptions by_density_alone(int cells) {
  LatticeOptions options = with_cells(cells);
  options.stairs = Stairs::Leave;
  options.thin = Thin::Drop;
  options.separate = Separate::Together;
  options.topology = {Touching::Leave, 0, Bubbles::Keep, BoundaryOnly::Leave};
  return options;
}

TEST(FiveTets, fill_the_cube_are_positive_and_own_their_centres) {
  for (const bool odd : {false, true}) {
    double sum = 0;
    for (std::size_t t = 0; t < kTetsPerCell; ++t) {
      TetCorners p;
      Vec3d centre;
      const auto names = tet_corners(t, odd);
      for (std::size_t i = 0; i < 4; ++i) {
        p[i] = corner_offset(names[i]);
        centre += p[i] * 0.25;
      }
      EXPECT_NEAR(signed_volume(p), t == 0 ? 1.0 / 3 : 1.0 / 6, 1e-15);
      EXPECT_EQ(owner_tet(centre, odd), t);
      sum += signed_volume(p);
    }
    EXPECT_NEAR(sum, 1, 1e-15);
  }
}

TEST(FiveTets, the_owner_of_any_point_holds_it) {
  test::Random random(5);
  for (int i = 0; i < 10000; ++i) {
    const Vec3d p{random.uniform(), random.uniform(), random.uniform()};
    const bool odd = i % 2 == 1;
    TetCorners c;
    const auto names = tet_corners(owner_tet(p, odd), odd);
    for (std::size_t k = 0; k < 4; ++k) c[k] = corner_offset(names[k]);
    for (std::size_t k = 0; k < 4; ++k) {
      TetCorners moved = c;
      moved[k] = p;
      ASSERT_GE(signed_volume(moved), -1e-12);
    }
  }
}

TEST(FiveTets, diagonals_of_neighbouring_cells_match) {
  // Two even corners of a face are its diagonal; a neighbour across the face is mirrored.
  const auto diagonal = [](bool odd, std::size_t axis, unsigned side) {
    std::set<unsigned> corners;
    for (const unsigned c : tet_corners(0, odd))
      if ((c >> axis & 1U) == side) corners.insert(c & ~(1U << axis));
    return corners;
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    EXPECT_EQ(diagonal(false, axis, 1), diagonal(true, axis, 0));
    EXPECT_EQ(diagonal(true, axis, 1), diagonal(false, axis, 0));
  }
}

/// Density of every kept tet by looking at every voxel of the grid: quadratic and independent of the cells.
void expect_dense_tets(const TetMesh& mesh, const BitGrid& inside, double rho_min) {
  ASSERT_FALSE(mesh.tets.empty());
  for (const Tet& tet : mesh.tets) {
    TetCorners c;
    for (std::size_t i = 0; i < 4; ++i) c[i] = to_double(mesh.vertices[tet[i]]);
    std::size_t all = 0, in = 0;
    const auto [nx, ny, nz] = inside.frame.size;
    for (int z = -5; z < nz + 5; ++z) {
      for (int y = -5; y < ny + 5; ++y) {
        for (int x = -5; x < nx + 5; ++x) {
          const Vec3d p = test::voxel_centre(inside.frame, x, y, z);
          bool within = true;
          for (std::size_t k = 0; k < 4 && within; ++k) {
            TetCorners moved = c;
            moved[k] = p;
            within = signed_volume(moved) >= 0;
          }
          if (!within) continue;
          ++all;
          in += inside.frame.contains(x, y, z) && inside.test(x, y, z);
        }
      }
    }
    // Float vertices move a face by 1e-7, so a centre that lies on it may fall to either side.
    ASSERT_GE(static_cast<double>(in) + 1, rho_min * static_cast<double>(all) - 1e-9);
  }
}

TEST(Lattice, every_tet_kept_by_density_alone_is_dense_and_counts_are_exact) {
  const Stages s = classify(test::make_ball(), 24);
  LatticeOptions options = by_density_alone(5);
  options.rotate = {0.3, -0.2, 0.5};
  options.translate_cells = {0.31, 0.12, 0.77};
  for (const double rho_min : {0.2, 0.5, 0.9}) {
    options.rho_min = rho_min;
    expect_dense_tets(fill(s, options).mesh, s.volume.inside, rho_min);
  }
  options.kind = LatticeKind::Bcc;
  options.cells = 4;
  options.rho_min = 0.6;
  expect_dense_tets(fill(s, options).mesh, s.volume.inside, 0.6);
}

TEST(Lattice, both_kinds_fill_a_ball_with_tets_of_their_angles) {
  const Stages s = classify(test::make_ball(), 48);
  for (const LatticeKind kind : {LatticeKind::Five, LatticeKind::Bcc}) {
    LatticeOptions options = with_cells(11);  // 12 would lay faces through voxel centres, which then count twice
    options.kind = kind;
    const LatticeMesh lattice = fill(s, options);
    const LatticeReport& r = lattice.report;
    EXPECT_NEAR(r.kept_volume / s.volume.report.volume, 1, 0.04);
    EXPECT_GT(r.overlap, 0.9);
    const double both = r.pseudo_volume - r.lacking_volume;
    EXPECT_NEAR(r.overlap, both / (r.pseudo_volume + r.excess_volume), 1e-9);
    EXPECT_NEAR(both + r.excess_volume, r.kept_volume, 0.01 * r.kept_volume);
    const Quality q = measure_quality(lattice.mesh);
    EXPECT_EQ(q.inverted_tets, 0U);
    EXPECT_TRUE(q.boundary_closed);
    const double degrees = 180 / std::numbers::pi;
    EXPECT_NEAR(q.min_dihedral * degrees, kind == LatticeKind::Five ? 54.7356 : 60, 0.01);
    EXPECT_NEAR(q.max_dihedral * degrees, 90, 0.01);
    EXPECT_NEAR(q.max_edge_ratio, kind == LatticeKind::Five ? std::sqrt(2) : 2 / std::sqrt(3), 1e-4);
  }
}

TEST(Lattice, a_lower_rho_min_keeps_a_superset) {
  const Stages s = classify(make_sample("heart"), 48);
  std::size_t previous = 0;
  for (const double rho_min : {0.95, 0.7, 0.5, 0.3, 0.05}) {
    LatticeOptions options = with_cells(10);
    options.rho_min = rho_min;
    const std::size_t tets = fill(s, options).report.tet_count;
    EXPECT_GT(tets, previous);
    previous = tets;
  }
}

TEST(Lattice, tets_are_positive_and_faces_match) {
  const Stages s = classify(make_sample("robot"), 64);
  const LatticeMesh lattice = fill(s);
  const Quality q = measure_quality(lattice.mesh);
  EXPECT_EQ(q.inverted_tets + q.invalid_tets + q.unused_vertices, 0U);
  EXPECT_TRUE(q.boundary_closed);
  EXPECT_NEAR(q.min_dihedral * 180 / std::numbers::pi, 54.7356, 0.01);
  EXPECT_NEAR(q.volume, lattice.report.kept_volume, 1e-9 * q.volume);
}

TEST(Lattice, the_default_is_about_two_thousand_tets) {
  for (const char* name : {"torus", "heart", "robot", "tree"}) {
    const auto tets = static_cast<double>(fill(classify(make_sample(name), 64)).report.tet_count);
    EXPECT_NEAR(tets, 2000, 100) << name;
  }
}

TEST(Lattice, a_block_is_met_exactly_where_the_count_allows_it) {
  LatticeOptions options;
  options.tets = 1800;  // 7^3 cells are 1,715 tets
  const LatticeReport r = fill(classify(test::make_box({0, 0, 0}, {1, 1, 1}), 64), options).report;
  EXPECT_EQ(r.cells, (std::array<int, 3>{7, 7, 7}));
  EXPECT_NEAR(r.kept_volume, 1, 1e-5);
  EXPECT_GT(r.overlap, 0.99) << "but for voxels whose centres lie on its sides";
}

TEST(Lattice, cells_count_along_the_longest_axis) {
  const Stages s = classify(test::make_box({0, 0, 0}, {4, 2, 1}), 64);
  const LatticeReport r = fill(s, with_cells(8)).report;
  EXPECT_EQ(r.cells, (std::array<int, 3>{8, 4, 2}));
  EXPECT_NEAR(r.cell_size, 0.5, 1e-9);
  EXPECT_NEAR(r.kept_volume, 8, 1e-5) << "the lattice fits the box exactly";
  EXPECT_EQ(r.tet_count, 8U * 4 * 2 * 5);
}

TEST(Lattice, a_whole_turn_and_two_cells_of_translation_change_nothing) {
  const Stages s = classify(test::make_ball(), 32);
  LatticeOptions moved = with_cells(6);
  moved.translate_cells = {2, 0, -2};
  const TetMesh a = fill(s, with_cells(6)).mesh, b = fill(s, moved).mesh;
  EXPECT_EQ(a.tets, b.tets);
  LatticeOptions shifted = with_cells(6);
  shifted.translate_cells = {0.5, 0, 0};
  EXPECT_NE(fill(s, shifted).mesh.vertices, a.vertices);
}

TEST(Lattice, tets_smaller_than_a_voxel_are_sampled_not_dropped) {
  const Stages s = classify(test::make_ball(), 10);
  const LatticeMesh fine = fill(s, by_density_alone(25));
  EXPECT_GT(fine.report.sampled_tets, 0U);
  EXPECT_NEAR(fine.report.kept_volume / s.volume.report.volume, 1, 0.05);
}

TEST(Lattice, a_lone_sheet_a_triangle_a_needle_and_a_point_keep_the_tets_they_pass_through) {
  TriangleSoup triangle;
  triangle.vertices = {{0, 0, 0}, {1, 0.1F, 0.2F}, {0.3F, 1, 0.4F}};
  triangle.triangles = {{0, 1, 2}};
  TriangleSoup flat = triangle;
  for (Vec3& v : flat.vertices) v.z = 0;
  TriangleSoup needle = triangle;
  needle.triangles = {{0, 0, 1}};
  TriangleSoup point = triangle;
  point.triangles = {{2, 2, 2}};
  // A sheet along voxel centres is, by its votes, a slab of one voxel: density may keep that too.
  const std::array<TriangleSoup, 4> soups{triangle, needle, point, flat};
  for (const TriangleSoup& soup : soups) {
    const Stages s = classify(soup, 32);
    for (const LatticeOptions& options : {LatticeOptions{}, with_cells(4)}) {
      const LatticeMesh lattice = fill(s, options);
      const Quality q = measure_quality(lattice.mesh);
      EXPECT_TRUE(lattice.report.kept_by_soup || &soup == &soups.back());
      EXPECT_GT(q.tet_count, 0U);
      EXPECT_EQ(q.inverted_tets, 0U);
      for (const Triangle& t : soup.triangles) {  // its corners lie in the mesh's box, or nearly
        for (const std::uint32_t i : t) {
          Vec3d lo = to_double(lattice.mesh.vertices[0]), hi = lo;
          for (const Vec3& v : lattice.mesh.vertices) lo = min(lo, to_double(v)), hi = max(hi, to_double(v));
          const Vec3d p = to_double(soup.vertices[i]);
          // A tip that reaches a little into the next tet may do without it, and the grid has its limits.
          const double tip = std::max(0.6 * lattice.report.mean_edge, 2.5 * s.volume.inside.frame.voxel_size);
          EXPECT_EQ(max(min(p, hi + Vec3d{tip, tip, tip}), lo - Vec3d{tip, tip, tip}), p);
        }
      }
    }
  }
}

TEST(Lattice, wrong_options_are_refused) {
  const Stages s = classify(test::make_ball(), 16);
  const auto refused = [&](auto change) {
    LatticeOptions options;
    change(options);
    EXPECT_THROW(fill(s, options), InvalidInput);
  };
  refused([](auto& o) { o.cells = 0; });
  refused([](auto& o) { o.cells = 2000; });
  refused([](auto& o) { o.cell_size = -1; });
  refused([](auto& o) { o.cell_size = 1e-7; });
  refused([](auto& o) { o.cells = 4, o.cell_size = 1; });
  refused([](auto& o) { o.tets = 0; });
  refused([](auto& o) { o.vertices = (std::size_t{1} << 27) + 1; });
  refused([](auto& o) { o.edge = std::nan(""); });
  refused([](auto& o) { o.edge = 1e-7; });
  refused([](auto& o) { o.rho_min = 0; });
  refused([](auto& o) { o.rho_min = std::nan(""); });
  refused([](auto& o) { o.translate_cells.y = std::nan(""); });
}

TEST(Lattice, same_bits_at_any_thread_count_and_cancellable) {
  const Stages s = classify(make_sample("torus"), 64);
  set_thread_count(1);
  const TetMesh one = fill(s).mesh;
  set_thread_count(5);
  const TetMesh many = fill(s).mesh;
  set_thread_count(0);
  EXPECT_EQ(one.vertices, many.vertices);
  EXPECT_EQ(one.tets, many.tets);
  EXPECT_THROW(fill_lattice(s.volume, s.soup, {}, [](std::string_view, double f) { return f == 0; }), Cancelled);
}

}  // namespace
}  // namespace tetsoup
