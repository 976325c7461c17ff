// Smoothing: what it promises for any mesh (no tet harmed, volume kept), and that it really smooths.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "smooth_shapes.h"

namespace tetsoup {

TEST(Smooth, no_pass_returns_the_input_bits) {
  const TetMesh mesh = ball(0.25);
  const SmoothResult result = smooth_tets(mesh, {.passes = 0});
  EXPECT_TRUE(same_bits(result.mesh, mesh));
  EXPECT_EQ(result.report.volume_after, result.report.volume_before);
  for (const float ratio : result.report.boundary_volume_ratio) EXPECT_EQ(ratio, 1);
}

TEST(Smooth, an_empty_mesh_stays_empty) {
  const SmoothResult result = smooth_tets({});
  EXPECT_TRUE(result.mesh.vertices.empty());
  EXPECT_EQ(result.report.boundary_vertices, 0U);
}

TEST(Smooth, steps_of_a_ball_are_more_than_halved_and_its_radius_kept) {
  const TetMesh mesh = ball(0.2);
  const SmoothResult result = smooth_tets(mesh, {.min_dihedral = 15 * kDegree, .max_dihedral = 165 * kDegree});
  EXPECT_EQ(measure_quality(result.mesh).inverted_tets, 0U);
  EXPECT_LT(roughness(result.mesh), 0.5 * roughness(mesh));
  const double radius = std::cbrt(measure_quality(mesh).volume * 3 / (4 * std::numbers::pi));
  double spread_before = 0, spread_after = 0;
  std::vector<char> seen(mesh.vertices.size(), 0);
  for (const Triangle& t : boundary_triangles(mesh)) {
    for (const std::uint32_t v : t) {
      if (seen[v]++) continue;
      spread_before += std::abs(length(to_double(mesh.vertices[v])) - radius);
      spread_after += std::abs(length(to_double(result.mesh.vertices[v])) - radius);
    }
  }
  EXPECT_LT(spread_after, 0.5 * spread_before);
}

TEST(Smooth, steps_of_torus_bar_and_plate_fall) {
  for (const TetMesh& mesh : {torus(0.2), turned_box({1, 0.3, 0.3}, 0.13), turned_box({0.15, 1, 1}, 0.17)}) {
    const SmoothResult result = smooth_tets(mesh);
    expect_kept(mesh, result);
    EXPECT_LT(roughness(result.mesh), 0.6 * roughness(mesh));
  }
}

TEST(Smooth, a_ball_comes_closer_to_the_true_ball) {
  const TetMesh mesh = ball(0.25);
  BitGrid grid;
  grid.frame = {{64, 64, 64}, 0, {-1.26, -1.26, -1.26}, 0.04};
  grid.words_per_row = 1;
  grid.words.assign(64 * 64, 0);
  for (int z = 0; z < 64; ++z) {
    for (int y = 0; y < 64; ++y) {
      for (int x = 0; x < 64; ++x) {
        const Vec3d p = grid.frame.origin + Vec3d{0.04 * x, 0.04 * y, 0.04 * z};
        if (length(p) < 1) grid.words[grid.row(y, z)] |= std::uint64_t{1} << x;
      }
    }
  }
  const double before = intersection_over_union(mesh, grid);
  EXPECT_GT(intersection_over_union(smooth_tets(mesh).mesh, grid), before + 0.04);
}

TEST(Smooth, many_passes_converge_and_thin_parts_do_not_collapse) {
  // A ball with a stick one to two cells thick through it: curvature flow alone would eat the stick.
  const TetMesh mesh = lattice_of({-1.4, -0.6, -0.6}, {1.4, 0.6, 0.6}, 0.13, [](const Vec3d& p) {
    return length(p) < 0.5 || (std::abs(p.x) < 1.3 && std::hypot(p.y, p.z) < 0.12);
  });
  const auto half_length = [](const TetMesh& m) {
    float reach = 0;
    for (const Vec3& v : m.vertices) reach = std::max(reach, std::abs(v.x));
    return reach;
  };
  const SmoothResult some = smooth_tets(mesh, {.passes = 40}), more = smooth_tets(mesh, {.passes = 50});
  expect_kept(mesh, more);
  EXPECT_GT(half_length(more.mesh), 0.9F * half_length(mesh));
  double way = 0;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    way += length(to_double(more.mesh.vertices[v]) - to_double(some.mesh.vertices[v]));
  }
  EXPECT_LT(way / static_cast<double>(mesh.vertices.size()), 0.05 * 0.13);  // In ten passes, of a cell.
}

TEST(Smooth, stronger_smoothing_leaves_fewer_steps) {
  const TetMesh mesh = ball(0.25);
  const double weak = roughness(smooth_tets(mesh, {.passes = 2, .strength = 0.2}).mesh);
  EXPECT_LT(roughness(smooth_tets(mesh, {.passes = 2, .strength = 1}).mesh), weak);
}

TEST(Smooth, a_lone_interior_vertex_lies_at_the_average_of_its_neighbours) {
  TetMesh mesh = block_mesh({2, 2, 2});
  const auto centre = static_cast<std::size_t>(std::find(mesh.vertices.begin(), mesh.vertices.end(), Vec3{1, 1, 1}) -
                                               mesh.vertices.begin());
  mesh.vertices[centre] = {1.2F, 0.9F, 1.1F};
  const TetMesh smooth = smooth_tets(mesh).mesh;
  Vec3d sum;
  std::vector<char> is_neighbour(mesh.vertices.size(), 0);
  for (const Tet& tet : mesh.tets) {
    if (std::find(tet.begin(), tet.end(), centre) == tet.end()) continue;
    for (const std::uint32_t v : tet) is_neighbour[v] = v != centre;
  }
  double count = 0;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    if (is_neighbour[v]) sum += to_double(smooth.vertices[v]), ++count;
  }
  EXPECT_LT(length(to_double(smooth.vertices[centre]) - sum * (1 / count)), 0.01);
}

TEST(Smooth, the_floor_is_the_one_asked_for) {
  const TetMesh mesh = torus(0.25);
  for (const double degrees : {0.0, 5.0, 30.0, 50.0, 59.0}) {
    const double floor = degrees * kDegree;
    expect_kept(mesh, smooth_tets(mesh, {.passes = 8, .strength = 3, .min_dihedral = floor}), floor);
  }
}

TEST(Smooth, shortened_moves_are_counted) {
  const TetMesh mesh = torus(0.25);
  EXPECT_EQ(smooth_tets(mesh, {.passes = 1, .strength = 0.01}).report.shortened_moves, 0U);
  EXPECT_GT(smooth_tets(mesh, {.passes = 5, .min_dihedral = 50 * kDegree}).report.shortened_moves, 0U);
}

TEST(Smooth, boundary_volume_ratios_are_those_of_the_tets_around) {
  const TetMesh mesh = block_mesh({1, 1, 1});
  const SmoothResult result = smooth_tets(mesh);
  ASSERT_EQ(result.report.boundary_volume_ratio.size(), 8U);
  for (std::uint32_t v = 0; v < 8; ++v) {
    double before = 0, after = 0;
    for (const Tet& tet : mesh.tets) {
      if (std::find(tet.begin(), tet.end(), v) == tet.end()) continue;
      const auto volume = [&](const TetMesh& m) {
        return signed_volume(to_double(m.vertices[tet[0]]), to_double(m.vertices[tet[1]]),
                             to_double(m.vertices[tet[2]]), to_double(m.vertices[tet[3]]));
      };
      before += volume(mesh);
      after += volume(result.mesh);
    }
    EXPECT_NEAR(result.report.boundary_volume_ratio[v], after / before, 1e-6);
  }
}

TEST(Smooth, one_tet_two_tets_and_a_sheet_keep_their_volume) {
  const TetMesh one{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2, 3}}};
  TetMesh face = one, edge = one, vertex = one;
  face.vertices.push_back({1, 1, 1});
  face.tets.push_back({1, 2, 3, 4});
  edge.vertices.insert(edge.vertices.end(), {{1, -1, 0}, {0, -1, -1}});
  edge.tets.push_back({0, 4, 1, 5});
  vertex.vertices.insert(vertex.vertices.end(), {{-1, 0, 0}, {0, 0, -1}, {0, -1, 0}});
  vertex.tets.push_back({0, 4, 5, 6});
  for (TetMesh mesh : {one, face, edge, vertex, block_mesh({6, 6, 1}), block_mesh({9, 1, 1})}) {
    for (Tet& tet : mesh.tets) {
      const TetMesh alone{mesh.vertices, {tet}};
      if (measure_quality(alone).inverted_tets > 0) std::swap(tet[2], tet[3]);
    }
    expect_kept(mesh, smooth_tets(mesh));
    expect_kept(mesh, smooth_tets(mesh, {.passes = 60, .strength = 10}));
  }
}

TEST(Smooth, parts_keep_their_own_volume) {
  const TetMesh mesh = lattice_mesh({0, 0, 0}, {12, 4, 4}, 1, [](const TetCorners& p) {
    const Vec3d c = (p[0] + p[1] + p[2] + p[3]) * 0.25;
    return c.x < 4 || (c.x > 10 && c.y < 2 && c.z < 2);
  });
  const SmoothResult result = smooth_tets(mesh);
  TetMesh small{result.mesh.vertices, {}};
  for (const Tet& tet : mesh.tets) {
    if (mesh.vertices[tet[0]].x > 9) small.tets.push_back(tet);
  }
  EXPECT_NEAR(measure_quality(small).volume, 8, 1e-3);
}

TEST(Smooth, random_pieces_of_a_lattice_are_never_harmed) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    const TetMesh mesh = random_lattice(seed, {4, 3, 3}, 0.05 + 0.9 * (seed % 20) / 20.0);
    if (mesh.tets.empty()) continue;
    SCOPED_TRACE(seed);
    expect_kept(mesh, smooth_tets(mesh, {.passes = static_cast<int>(seed % 9), .strength = 0.1 * (1 + seed % 50)}));
  }
}

TEST(Smooth, random_pieces_really_move) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const TetMesh mesh = random_lattice(seed, {5, 5, 5}, 0.3 + 0.03 * seed);
    const TetMesh smooth = smooth_tets(mesh).mesh;
    double way = 0;
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
      way += length(to_double(smooth.vertices[v]) - to_double(mesh.vertices[v]));
    }
    EXPECT_GT(way / static_cast<double>(mesh.vertices.size()), 0.1 * 0.3) << "of a cell of 0.3, seed " << seed;
  }
}

}  // namespace tetsoup
