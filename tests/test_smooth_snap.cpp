// Smoothing that draws the boundary to the voxels' surface: limits, fit, volume, and points that must stay inside.
#include <gtest/gtest.h>

#include <cmath>

#include "smooth_shapes.h"

namespace tetsoup {

namespace {

/// Voxels of edge 0.04 over [-1.5, 1.5]^3.
BitGrid voxels_of(const std::function<bool(const Vec3d&)>& inside) {
  BitGrid grid;
  grid.frame = {{75, 75, 75}, 0, {-1.48, -1.48, -1.48}, 0.04};
  grid.words_per_row = 2;
  grid.words.assign(2 * 75 * 75, 0);
  for (int z = 0; z < 75; ++z) {
    for (int y = 0; y < 75; ++y) {
      for (int x = 0; x < 75; ++x) {
        const Vec3d p = grid.frame.origin + Vec3d{0.04 * x, 0.04 * y, 0.04 * z};
        if (inside(p)) grid.words[grid.row(y, z) + static_cast<std::size_t>(x) / 64] |= std::uint64_t{1} << (x % 64);
      }
    }
  }
  return grid;
}

bool in_ball(const Vec3d& p) {
  return length(p) < 1;
}
bool in_torus(const Vec3d& p) {
  const double ring = std::hypot(p.x, p.y) - 1;
  return ring * ring + p.z * p.z < 0.16;
}

void expect_limits(const TetMesh& before, const TetMesh& after, const SmoothOptions& options = {}) {
  const Quality start = measure_quality(before), end = measure_quality(after);
  EXPECT_EQ(end.inverted_tets, 0U);
  EXPECT_GE(end.min_dihedral, std::min(options.min_dihedral, start.min_dihedral) - 1e-9);
  EXPECT_LE(end.max_dihedral, std::max(options.max_dihedral, start.max_dihedral) + 1e-9);
  EXPECT_LE(end.max_edge_ratio, std::max(options.max_edge_ratio, start.max_edge_ratio) * (1 + 1e-9));
  EXPECT_EQ(after.tets, before.tets);
}

bool holds(const TetMesh& mesh, const Vec3d& p) {
  for (const Tet& tet : mesh.tets) {
    bool inside = true;
    for (std::size_t i = 0; i < 4 && inside; ++i) {
      TetCorners c;
      for (std::size_t k = 0; k < 4; ++k) c[k] = to_double(mesh.vertices[tet[k]]);
      c[i] = p;
      inside = signed_volume(c) >= 0;
    }
    if (inside) return true;
  }
  return false;
}

}  // namespace

TEST(Snap, ball_and_torus_are_met_closer_than_by_fairing) {
  const std::pair<TetMesh, BitGrid> shapes[] = {{ball(0.25), voxels_of(in_ball)}, {torus(0.2), voxels_of(in_torus)}};
  for (const auto& [mesh, inside] : shapes) {
    const SmoothResult snapped = smooth_tets(mesh, SmoothTarget{.inside = &inside});
    expect_limits(mesh, snapped.mesh);
    EXPECT_TRUE(snapped.report.snapped);
    const double raw = intersection_over_union(mesh, inside),
                 faired = intersection_over_union(smooth_tets(mesh).mesh, inside),
                 fitted = intersection_over_union(snapped.mesh, inside);
    EXPECT_LT(1 - fitted, 0.9 * (1 - faired));
    EXPECT_LT(1 - fitted, 0.5 * (1 - raw));
    const Quality before = measure_quality(mesh), after = measure_quality(snapped.mesh);
    EXPECT_LT(after.boundary_curvature, 0.6 * before.boundary_curvature);
    EXPECT_LT(after.roughness, 0.75 * before.roughness);
  }
}

TEST(Snap, volume_becomes_that_of_the_voxels) {
  const BitGrid inside = voxels_of(in_ball);
  std::size_t count = 0;
  for (int z = 0; z < 75; ++z)
    for (int y = 0; y < 75; ++y)
      for (int x = 0; x < 75; ++x) count += inside.test(x, y, z);
  const double volume = static_cast<double>(count) * 0.04 * 0.04 * 0.04;
  const SmoothResult result = smooth_tets(ball(0.25), SmoothTarget{.inside = &inside});
  EXPECT_NEAR(result.report.volume_wanted, volume, 1e-9 * volume);
  EXPECT_NEAR(measure_quality(result.mesh).volume, volume, 1e-4 * volume);
}

TEST(Snap, volume_that_began_far_from_the_voxels_is_left_to_the_fit) {
  const BitGrid sheet = voxels_of([](const Vec3d& p) { return std::abs(p.z) < 0.03 && std::hypot(p.x, p.y) < 1; });
  const TetMesh plate = turned_box({0.15, 1, 1}, 0.17);
  const SmoothResult result = smooth_tets(plate, SmoothTarget{.inside = &sheet});
  expect_limits(plate, result.mesh);
  EXPECT_EQ(result.report.volume_wanted, 0);
}

TEST(Snap, a_volume_that_is_known_goes_before_that_of_the_voxels) {
  const BitGrid inside = voxels_of(in_ball);
  const double volume = 1.04 * 4 / 3 * std::numbers::pi;
  const SmoothResult result = smooth_tets(ball(0.25), SmoothTarget{.inside = &inside, .volume = volume});
  EXPECT_EQ(result.report.volume_wanted, volume);
  EXPECT_NEAR(measure_quality(result.mesh).volume, volume, 1e-4 * volume);
}

TEST(Snap, volume_that_the_fit_takes_too_much_of_comes_back) {
  const BitGrid rod = voxels_of([](const Vec3d& p) { return std::hypot(p.x, p.y) < 0.17 && std::abs(p.z) < 1.1; });
  const TetMesh mesh = lattice_of({-0.25, -0.25, -1.25}, {0.25, 0.25, 1.25}, 0.25,
                                  [](const Vec3d& p) { return std::hypot(p.x, p.y) < 0.24 && std::abs(p.z) < 1.1; });
  const SmoothReport left = smooth_tets(mesh, SmoothTarget{.inside = &rod}).report;
  EXPECT_EQ(left.volume_wanted, 0) << "it begins twice as large: the fit decides";
  const double volume = 1.1 * left.volume_after;
  const SmoothResult result = smooth_tets(mesh, SmoothTarget{.inside = &rod, .volume = volume});
  expect_limits(mesh, result.mesh);
  EXPECT_NEAR(result.report.volume_after, volume, 1e-3 * volume);
}

TEST(Snap, both_faces_of_a_layer_are_drawn_to_the_wall_in_it) {
  // A wall a seventh of an edge thick, right below the layer's upper face.
  const double edge = 0.4 * (1 + std::sqrt(2.0)) / 2;
  const BitGrid wall = voxels_of([](const Vec3d& p) { return p.z > 0.11 && p.z < 0.19; });
  const TetMesh layer = lattice_of({-1.2, -1.2, -0.2}, {1.2, 1.2, 0.2}, 0.4, [](const Vec3d&) { return true; });
  const SmoothResult result = smooth_tets(layer, SmoothTarget{.inside = &wall});
  expect_limits(layer, result.mesh);
  double lower = 0, upper = 0, count = 0;
  for (std::size_t v = 0; v < layer.vertices.size(); ++v) {
    (layer.vertices[v].z < 0 ? lower : upper) += static_cast<double>(result.mesh.vertices[v].z);
    count += layer.vertices[v].z < 0;
  }
  EXPECT_NEAR((lower + upper) / (2 * count), 0.15, 0.05 * edge) << "in the middle of the wall";
  EXPECT_LT((upper - lower) / count, 0.4 * edge) << "as flat as the angles allow";
}

TEST(Snap, the_rim_of_a_sheet_stays_where_the_soup_has_it) {
  const BitGrid sheet = voxels_of([](const Vec3d&) { return false; });  // it passes between the voxels' centres
  const TriangleSoup soup{{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
  const TetMesh plate = lattice_of({-1, -1, -0.2}, {1, 1, 0.2}, 0.2, [](const Vec3d& p) {
    return std::abs(p.x) < 0.9 && std::abs(p.y) < 0.9 && std::abs(p.z) < 0.2;
  });
  const auto way_of_corners = [&](const TetMesh& mesh) {
    double farthest = 0;
    for (const Vec3& corner : soup.vertices) {
      double nearest = 9;
      for (const Vec3& v : mesh.vertices) nearest = std::min(nearest, length(to_double(v) - to_double(corner)));
      farthest = std::max(farthest, nearest);
    }
    return farthest;
  };
  const SmoothResult held = smooth_tets(plate, SmoothTarget{.inside = &sheet, .soup = &soup});
  expect_limits(plate, held.mesh);
  EXPECT_LT(way_of_corners(held.mesh), 0.7 * way_of_corners(smooth_tets(plate, SmoothTarget{.inside = &sheet}).mesh));
}

TEST(Snap, a_soup_far_larger_than_the_mesh_costs_no_more) {
  const BitGrid inside = voxels_of(in_ball);
  const TetMesh mesh = ball(0.3);
  const float far = 1e9F;  // with all its points, 10^19 of them, this would not end
  const TriangleSoup floor{{{-far, -far, 0}, {far, -far, 0}, {0, far, 0}}, {{0, 1, 2}}};
  expect_limits(mesh, smooth_tets(mesh, SmoothTarget{.inside = &inside, .soup = &floor}).mesh);
}

TEST(Snap, limits_hold_whatever_is_asked_and_whatever_the_voxels_show) {
  const BitGrid ball_voxels = voxels_of(in_ball), nothing = voxels_of([](const Vec3d&) { return false; }),
                all = voxels_of([](const Vec3d&) { return true; });
  for (unsigned seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    const TetMesh mesh = random_lattice(seed, {5, 4, 4}, 0.1 + 0.85 * (seed % 10) / 10.0);
    if (mesh.tets.empty()) continue;
    SmoothOptions options{.passes = static_cast<int>(1 + seed % 8)};
    options.min_dihedral = (seed * 7 % 50) * kDegree;
    options.max_dihedral = (112 + seed * 11 % 60) * kDegree;
    options.max_edge_ratio = 1.8 + 0.1 * (seed % 30);
    const BitGrid& inside = seed % 3 == 0 ? ball_voxels : seed % 3 == 1 ? nothing : all;
    expect_limits(mesh, smooth_tets(mesh, SmoothTarget{.inside = &inside}, options).mesh, options);
  }
}

TEST(Snap, off_is_fairing) {
  const BitGrid inside = voxels_of(in_ball);
  const TetMesh mesh = ball(0.3);
  const SmoothResult off = smooth_tets(mesh, SmoothTarget{.inside = &inside}, {.snap = Snap::Off});
  EXPECT_TRUE(same_bits(off.mesh, smooth_tets(mesh).mesh));
  EXPECT_FALSE(off.report.snapped);
  EXPECT_TRUE(same_bits(smooth_tets(mesh, SmoothTarget{.inside = &inside}, {.passes = 0}).mesh, mesh));
}

TEST(Snap, is_the_same_at_any_thread_count) {
  const BitGrid inside = voxels_of(in_torus);
  const TetMesh mesh = torus(0.15);
  set_thread_count(1);
  const TetMesh one = smooth_tets(mesh, SmoothTarget{.inside = &inside}).mesh;
  set_thread_count(0);
  EXPECT_TRUE(same_bits(one, smooth_tets(mesh, SmoothTarget{.inside = &inside}).mesh));
}

TEST(Snap, points_that_lie_in_the_mesh_stay_in_it) {
  const BitGrid inside = voxels_of([](const Vec3d& p) { return length(p) < 0.95; });
  const TetMesh mesh = ball(0.25);
  std::vector<Vec3> points;
  for (int i = 0; i < 2000; ++i) {
    const double z = 1 - (2 * i + 1) / 2000.0, turn = 2.399963 * i, r = std::sqrt(1 - z * z), size = 0.9 + 0.00007 * i;
    points.push_back(to_float(Vec3d{r * std::cos(turn), r * std::sin(turn), z} * size));
  }
  std::erase_if(points, [&](const Vec3& p) { return !holds(mesh, to_double(p)); });
  ASSERT_GT(points.size(), 1000U);
  const auto lost = [&](const TetMesh& m) {
    return std::count_if(points.begin(), points.end(), [&](const Vec3& p) { return !holds(m, to_double(p)); });
  };
  EXPECT_GT(lost(smooth_tets(mesh, SmoothTarget{.inside = &inside}).mesh), 0) << "or the test shows nothing";
  const SmoothResult kept = smooth_tets(mesh, SmoothTarget{.inside = &inside, .enclosed = points});
  EXPECT_EQ(lost(kept.mesh), 0);
  expect_limits(mesh, kept.mesh);
  EXPECT_EQ(lost(smooth_tets(mesh, SmoothTarget{.enclosed = points}).mesh), 0);
}

}  // namespace tetsoup
