// What a tet mesh is like: shapes against closed formulas, boundaries against hand-counted cases.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <random>

#include "base/tet_faces.h"
#include "lattice_shapes.h"
#include "tetsoup/quality.h"
#include "tetsoup/progress.h"

namespace tetsoup {

namespace {

constexpr double kDegree = std::numbers::pi / 180;

TetMesh corner_tet() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2, 3}}};
}

TetMesh regular_tet() {
  return {{{0, 0, 0}, {1, 1, 0}, {1, 0, 1}, {0, 1, 1}}, {{0, 1, 3, 2}}};
}

/// Two corner tets of which `shared` vertices are the same and the others apart.
TetMesh two_tets(std::uint32_t shared) {
  TetMesh mesh = corner_tet();
  Tet second{};
  for (std::uint32_t i = 0; i < 4; ++i) {
    second[i] = i < shared ? i : 4 + i - shared;
    if (i >= shared) mesh.vertices.push_back({-1.0F - static_cast<float>(i), -2.0F, -3.0F});
  }
  mesh.tets.push_back(second);
  return mesh;
}

BitGrid empty_grid(std::array<int, 3> size, double voxel, Vec3d origin) {
  BitGrid grid;
  grid.frame = {size, 0, origin, voxel};
  grid.words_per_row = static_cast<std::size_t>(size[0] + 63) / 64;
  grid.words.assign(grid.words_per_row * static_cast<std::size_t>(size[1]) * static_cast<std::size_t>(size[2]), 0);
  return grid;
}

template <class Inside>
BitGrid grid_of(std::array<int, 3> size, double voxel, Vec3d origin, const Inside& inside) {
  BitGrid grid = empty_grid(size, voxel, origin);
  for (int z = 0; z < size[2]; ++z) {
    for (int y = 0; y < size[1]; ++y) {
      for (int x = 0; x < size[0]; ++x) {
        if (inside(origin + Vec3d{x * voxel, y * voxel, z * voxel})) {
          grid.words[grid.row(y, z) + static_cast<std::size_t>(x / 64)] |= std::uint64_t{1} << (x % 64);
        }
      }
    }
  }
  return grid;
}

}  // namespace

TEST(Quality, an_empty_mesh_is_all_zeros_and_closed) {
  const Quality q = measure_quality({});
  EXPECT_EQ(q.tet_count, 0U);
  EXPECT_EQ(q.components, 0U);
  EXPECT_EQ(q.min_dihedral, 0);
  EXPECT_EQ(q.min_tet_volume, 0);
  EXPECT_EQ(q.mean_ratio_mean, 0);
  EXPECT_TRUE(q.boundary_closed);
}

TEST(Quality, a_corner_tet_has_known_angles_and_ratios) {
  const Quality q = measure_quality(corner_tet());
  EXPECT_DOUBLE_EQ(q.volume, 1.0 / 6);
  EXPECT_DOUBLE_EQ(q.min_tet_volume, q.max_tet_volume);
  EXPECT_NEAR(q.min_dihedral, std::acos(1 / std::sqrt(3.0)), 1e-12);
  EXPECT_NEAR(q.max_dihedral, 90 * kDegree, 1e-12);
  EXPECT_NEAR(q.max_edge_ratio, std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(q.mean_ratio_min, 12 * std::pow(0.5, 2.0 / 3) / 9, 1e-12);
  EXPECT_EQ(q.dihedral_histogram[10], 3U);  // 54.7 degrees
  EXPECT_EQ(q.components, 1U);
  EXPECT_EQ(q.boundary_triangles, 4U);
  EXPECT_EQ(q.boundary_vertices, 4U);
  EXPECT_EQ(q.boundary_only_tets, 1U);
  EXPECT_TRUE(q.boundary_manifold);
}

TEST(Quality, a_regular_tet_has_mean_ratio_one) {
  const Quality q = measure_quality(regular_tet());
  EXPECT_EQ(q.inverted_tets, 0U);
  EXPECT_NEAR(q.mean_ratio_min, 1, 1e-12);
  EXPECT_NEAR(q.max_edge_ratio, 1, 1e-12);
  EXPECT_NEAR(q.min_dihedral, std::acos(1.0 / 3), 1e-12);
  EXPECT_EQ(q.dihedral_histogram[14], 6U);
}

TEST(Quality, a_cube_of_five_tets_adds_up) {
  const Quality q = measure_quality(block_mesh({1, 1, 1}));
  EXPECT_EQ(q.tet_count, 5U);
  EXPECT_EQ(q.vertex_count, 8U);
  EXPECT_NEAR(q.volume, 1, 1e-12);
  EXPECT_NEAR(q.max_tet_volume, 1.0 / 3, 1e-12);
  EXPECT_EQ(q.boundary_triangles, 12U);
  EXPECT_EQ(q.boundary_only_tets, 5U);
  EXPECT_TRUE(q.boundary_manifold);
  EXPECT_EQ(std::accumulate(q.dihedral_histogram.begin(), q.dihedral_histogram.end(), std::size_t{0}), 30U);
}

TEST(Quality, mirrored_cells_join_into_one_block) {
  const Quality q = measure_quality(block_mesh({4, 3, 2}));
  EXPECT_EQ(q.components, 1U);
  EXPECT_EQ(q.vertex_count, 60U);
  EXPECT_EQ(q.boundary_triangles, 2U * 2 * (12 + 8 + 6));
  EXPECT_EQ(q.inverted_tets, 0U);
  EXPECT_NEAR(q.volume, 24, 1e-9);
  EXPECT_TRUE(q.boundary_manifold);
}

TEST(Quality, tets_that_share_a_face_are_one_manifold_component) {
  const Quality q = measure_quality(two_tets(3));
  EXPECT_EQ(q.components, 1U);
  EXPECT_EQ(q.boundary_triangles, 6U);
  EXPECT_TRUE(q.boundary_manifold);
}

TEST(Quality, tets_that_share_only_an_edge_are_closed_but_not_manifold) {
  const Quality q = measure_quality(two_tets(2));
  EXPECT_EQ(q.components, 2U);
  EXPECT_TRUE(q.boundary_closed);
  EXPECT_EQ(q.non_manifold_edges, 1U);
  EXPECT_EQ(q.non_manifold_vertices, 2U);
  EXPECT_FALSE(q.boundary_manifold);
}

TEST(Quality, tets_that_share_only_a_vertex_have_one_bad_vertex) {
  const Quality q = measure_quality(two_tets(1));
  EXPECT_EQ(q.components, 2U);
  EXPECT_EQ(q.non_manifold_edges, 0U);
  EXPECT_EQ(q.non_manifold_vertices, 1U);
  EXPECT_TRUE(q.boundary_closed);
  EXPECT_FALSE(q.boundary_manifold);
}

TEST(Quality, a_face_with_three_tets_is_not_closed) {
  TetMesh mesh = two_tets(3);
  mesh.vertices.push_back({0, 0, 2});
  mesh.tets.push_back({0, 1, 2, 5});
  const Quality q = measure_quality(mesh);
  EXPECT_FALSE(q.boundary_closed);
  EXPECT_FALSE(q.boundary_manifold);
  EXPECT_EQ(q.components, 1U);
  EXPECT_EQ(q.boundary_triangles, 9U);
}

TEST(Quality, a_bubble_has_an_inner_boundary) {
  int index = 0;
  const TetMesh mesh = lattice_mesh({0, 0, 0}, {3, 3, 3}, 1, [&](const TetCorners&) { return index++ / 5 != 13; });
  const Quality q = measure_quality(mesh);
  EXPECT_NEAR(q.volume, 26, 1e-9);
  EXPECT_EQ(q.boundary_triangles, 108U + 12);
  EXPECT_TRUE(q.boundary_manifold);
  EXPECT_EQ(q.components, 1U);
}

TEST(Quality, boundary_triangles_look_outwards_and_enclose_the_volume) {
  const TetMesh mesh = lattice_of({-1, -1, -1}, {1, 1, 1}, 0.2, [](const Vec3d& p) { return length(p) < 0.9; });
  double volume = 0;
  for (const Triangle& t : boundary_triangles(mesh)) {
    volume += signed_volume({}, to_double(mesh.vertices[t[0]]), to_double(mesh.vertices[t[1]]),
                            to_double(mesh.vertices[t[2]]));
  }
  EXPECT_NEAR(volume, measure_quality(mesh).volume, 1e-6);
}

TEST(Quality, inverted_flat_and_endless_tets_are_counted_as_inverted) {
  TetMesh mesh = corner_tet();
  mesh.tets = {{1, 0, 2, 3}};
  EXPECT_EQ(measure_quality(mesh).inverted_tets, 1U);
  EXPECT_EQ(measure_quality(mesh).mean_ratio_min, 0);
  EXPECT_NEAR(measure_quality(mesh).max_dihedral, 90 * kDegree, 1e-12);
  mesh.vertices[3] = {1, 1, 0};
  EXPECT_EQ(measure_quality(mesh).inverted_tets, 1U);
  EXPECT_EQ(measure_quality(mesh).min_dihedral, 0);
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    mesh.vertices[3] = {0, bad, 1};
    const Quality q = measure_quality(mesh);
    EXPECT_EQ(q.inverted_tets, 1U);
    EXPECT_EQ(q.volume, 0);
    EXPECT_EQ(q.boundary_triangles, 4U);
  }
}

TEST(Quality, invalid_tets_are_counted_and_otherwise_ignored) {
  TetMesh mesh = corner_tet();
  mesh.vertices.push_back({5, 5, 5});
  mesh.tets.push_back({0, 1, 2, 99});
  mesh.tets.push_back({4, 4, 1, 2});
  const Quality q = measure_quality(mesh);
  EXPECT_EQ(q.tet_count, 3U);
  EXPECT_EQ(q.invalid_tets, 2U);
  EXPECT_EQ(q.unused_vertices, 1U);
  EXPECT_EQ(q.components, 1U);
  EXPECT_EQ(boundary_triangles(mesh).size(), 4U);
}

TEST(Quality, any_tets_at_all_are_measured_without_harm) {
  std::mt19937 random(7);
  std::uniform_int_distribution<std::uint32_t> index(0, 11);
  std::uniform_real_distribution<float> place(-1, 1);
  for (int round = 0; round < 200; ++round) {
    TetMesh mesh;
    for (int v = 0; v < 10; ++v) mesh.vertices.push_back({place(random), place(random), place(random)});
    for (int t = 0; t < 20; ++t) mesh.tets.push_back({index(random), index(random), index(random), index(random)});
    const Quality q = measure_quality(mesh);
    std::size_t valid = 0;
    for (const Tet& tet : mesh.tets) valid += is_valid_tet(tet, 10) ? 1U : 0U;
    EXPECT_EQ(q.invalid_tets, 20 - valid);
    EXPECT_EQ(std::accumulate(q.dihedral_histogram.begin(), q.dihedral_histogram.end(), std::size_t{0}), 6 * valid);
    intersection_over_union(mesh, empty_grid({9, 9, 9}, 0.25, {-1, -1, -1}));
  }
}

TEST(Overlap, a_block_matches_its_own_voxels) {
  // Voxel size and origin are not exact in binary, and the cells' seams run through the voxel centres.
  const double h = 0.1;
  const TetMesh mesh = block_mesh({5, 4, 3}, 4 * h);
  const Vec3d origin{-3 * h, -3 * h, -3 * h};
  const BitGrid grid = grid_of({80, 30, 20}, h, origin, [&](const Vec3d& p) {
    return p.x > -0.01 && p.y > -0.01 && p.z > -0.01 && p.x < 2.01 && p.y < 1.61 && p.z < 1.21;
  });
  EXPECT_GT(intersection_over_union(mesh, grid), 0.95);  // Float rounding may lose the outermost layers, not the seams.
  const BitGrid between = grid_of({80, 30, 20}, h, origin + Vec3d{h / 2, h / 2, h / 2}, [&](const Vec3d& p) {
    return p.x > 0 && p.y > 0 && p.z > 0 && p.x < 2 && p.y < 1.6 && p.z < 1.2;
  });
  EXPECT_EQ(intersection_over_union(mesh, between), 1);
}

TEST(Overlap, seams_through_voxel_centres_leave_no_crack) {
  const BitGrid grid = grid_of({70, 20, 20}, 1, {-2, -2, -2}, [](const Vec3d& p) {
    return p.x >= 0 && p.y >= 0 && p.z >= 0 && p.x <= 12 && p.y <= 8 && p.z <= 8;
  });
  EXPECT_EQ(intersection_over_union(block_mesh({3, 2, 2}, 4), grid), 1);
}

TEST(Overlap, a_shifted_block_overlaps_by_the_formula) {
  const auto inside = [](const Vec3d& p) { return p.x > 2 && p.y > 0 && p.z > 0 && p.x < 6 && p.y < 4 && p.z < 4; };
  const BitGrid grid = grid_of({90, 20, 20}, 0.25, {-0.9, -0.9, -0.9}, inside);
  EXPECT_NEAR(intersection_over_union(block_mesh({4, 4, 4}), grid), 1.0 / 3, 1e-12);
}

TEST(Overlap, what_the_mesh_covers_beyond_the_grid_counts_against_it) {
  const auto all = [](const Vec3d&) { return true; };
  EXPECT_NEAR(intersection_over_union(block_mesh({4, 4, 4}), grid_of({4, 4, 4}, 0.5, {0.25, 0.25, 0.25}, all)), 1.0 / 8,
              1e-12);
  EXPECT_NEAR(intersection_over_union(block_mesh({2, 2, 2}), grid_of({2, 2, 4}, 0.5, {1.25, 1.25, 0.25}, all)),
              16.0 / 64, 1e-12);
}

TEST(Overlap, nothing_overlaps_nothing_completely) {
  EXPECT_EQ(intersection_over_union({}, {}), 1);
  EXPECT_EQ(intersection_over_union({}, empty_grid({4, 4, 4}, 1, {})), 1);
  EXPECT_EQ(intersection_over_union(block_mesh({2, 2, 2}), empty_grid({4, 4, 4}, 1, {})), 0);
  EXPECT_EQ(intersection_over_union({}, grid_of({4, 4, 4}, 1, {}, [](const Vec3d&) { return true; })), 0);
}

TEST(Overlap, winding_of_tets_does_not_matter_and_bad_tets_cover_nothing) {
  const BitGrid grid = grid_of({8, 8, 8}, 0.5, {0.25, 0.25, 0.25}, [](const Vec3d&) { return true; });
  TetMesh mesh = block_mesh({4, 4, 4});
  for (Tet& tet : mesh.tets) std::swap(tet[0], tet[1]);
  mesh.tets.push_back({0, 0, 1, 2});
  mesh.tets.push_back({0, 1, 2, 1000000});
  mesh.vertices.push_back({std::numeric_limits<float>::quiet_NaN(), 0, 0});
  mesh.tets.push_back({0, 1, 2, static_cast<std::uint32_t>(mesh.vertices.size() - 1)});
  EXPECT_EQ(intersection_over_union(mesh, grid), 1);
}

TEST(Overlap, a_huge_tet_around_the_grid_is_cut_off_and_counted) {
  const BitGrid grid = grid_of({4, 4, 4}, 1, {}, [](const Vec3d&) { return true; });
  const TetMesh mesh{
      {{-1e30F, -1e30F, -1e30F}, {3e30F, -1e30F, -1e30F}, {-1e30F, 3e30F, -1e30F}, {-1e30F, -1e30F, 3e30F}},
      {{0, 1, 2, 3}}};
  const double iou = intersection_over_union(mesh, grid);
  EXPECT_GT(iou, 0);
  EXPECT_LT(iou, 0.05);
}

TEST(Overlap, is_the_same_at_any_thread_count) {
  const auto ball = [](const Vec3d& p) { return length(p) < 0.9; };
  const TetMesh mesh = lattice_of({-1, -1, -1}, {1, 1, 1}, 0.1, ball);
  const BitGrid grid = grid_of({64, 64, 64}, 1.0 / 32, {-0.99, -0.99, -0.99}, ball);
  set_thread_count(1);
  const double one = intersection_over_union(mesh, grid);
  set_thread_count(0);
  EXPECT_EQ(intersection_over_union(mesh, grid), one);
  EXPECT_GT(one, 0.85);
}

}  // namespace tetsoup
