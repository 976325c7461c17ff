// A surface hangs on the tets and moves with them.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

#include "base/tet_geometry.h"
#include "shapes.h"
#include "tetsoup/samples.h"
#include "tetsoup/tetsoup.h"

namespace tetsoup {
namespace {

const TetMesh kCorner{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2, 3}}};

TriangleSoup points(std::vector<Vec3> vertices) {
  return {std::move(vertices), {}};
}

std::vector<Vec3> moved(const std::vector<Vec3>& vertices, const std::function<Vec3d(Vec3d)>& map) {
  std::vector<Vec3> result;
  for (const Vec3& v : vertices) result.push_back(to_float(map(to_double(v))));
  return result;
}

double largest_distance(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, length(to_double(a[i]) - to_double(b[i])));
  return largest;
}

Vec3d sheared(const Vec3d& p) {
  return {1.1 * p.x + 0.3 * p.y - 0.2 * p.z + 2, 0.9 * p.y + 0.4 * p.z - 1, -0.5 * p.x + 1.2 * p.z + 0.5};
}

/// Bends x along a circle of this radius in the xz plane.
Vec3d bent(const Vec3d& p, double radius) {
  const double angle = p.x / radius;
  return {(radius + p.z) * std::sin(angle), p.y, (radius + p.z) * std::cos(angle) - radius};
}

TEST(Embed, a_point_in_a_tet_has_its_barycentric_weights) {
  const Embedding e = embed_points(kCorner, points({{0.1F, 0.2F, 0.3F}, {0, 0, 0}, {0.5F, 0.5F, 0}}));
  ASSERT_EQ(e.tets, std::vector<std::uint32_t>({0, 0, 0}));
  EXPECT_NEAR(e.weights[0][0], 0.4, 1e-7);
  EXPECT_NEAR(e.weights[0][1], 0.1, 1e-7);
  EXPECT_NEAR(e.weights[0][2], 0.2, 1e-7);
  EXPECT_NEAR(e.weights[0][3], 0.3, 1e-7);
  EXPECT_EQ(e.weights[1], (std::array<float, 4>{1, 0, 0, 0}));
  EXPECT_EQ(e.weights[2], (std::array<float, 4>{0, 0.5F, 0.5F, 0}));
  EXPECT_EQ(e.report.inside, 3U);
  EXPECT_EQ(e.report.max_distance, 0);
}

TEST(Embed, a_point_outside_is_extrapolated_and_its_distance_reported) {
  const Embedding e = embed_points(kCorner, points({{0.2F, 0.2F, -0.5F}}));
  EXPECT_NEAR(e.weights[0][3], -0.5, 1e-7);
  EXPECT_NEAR(e.distances[0], 0.5, 1e-7);
  EXPECT_EQ(e.report.outside, 1U);
  EXPECT_EQ(e.report.drawn_closer, 0U);
  EXPECT_NEAR(largest_distance(deform_points(e, kCorner.tets, kCorner.vertices), {{0.2F, 0.2F, -0.5F}}), 0, 1e-7);
}

TEST(Embed, a_point_far_outside_is_drawn_towards_the_mesh) {
  const Embedding e = embed_points(kCorner, points({{0.2F, 0.2F, -50}}), {.max_extrapolation = 2});
  EXPECT_NEAR(e.weights[0][3], -2, 1e-6);
  EXPECT_EQ(e.report.drawn_closer, 1U);
  EXPECT_NEAR(e.report.max_distance, 50, 1e-5);
  const Vec3 at = deform_points(e, kCorner.tets, kCorner.vertices)[0];
  EXPECT_NEAR(largest_distance({at}, {{0.2F, 0.2F, -2}}), 0, 1e-6);
}

TEST(Embed, outside_points_hang_on_the_nearest_tet) {
  const TriangleSoup soup = make_sample("robot");
  Pipeline pipeline(soup);
  MeshOptions options;
  options.distance.voxels = 48;
  options.lattice.tets = 600;
  const TetMesh& mesh = pipeline.run(options).mesh;
  const Embedding e = embed_points(mesh, soup);
  EXPECT_GT(e.report.inside, soup.vertices.size() / 10);
  EXPECT_GT(e.report.outside, soup.vertices.size() / 10);
  test::Random random(1);
  const std::vector<Triangle> boundary = boundary_triangles(mesh);
  for (int trial = 0; trial < 200; ++trial) {
    const std::size_t i = random.below(soup.vertices.size());
    if (!(e.distances[i] > 0)) continue;
    const Vec3d p = to_double(soup.vertices[i]);
    double least = std::numeric_limits<double>::infinity();  // to the boundary's triangles, by many points of each
    for (const Triangle& t : boundary) {
      const Vec3d a = to_double(mesh.vertices[t[0]]), b = to_double(mesh.vertices[t[1]]),
                  c = to_double(mesh.vertices[t[2]]);
      constexpr int kSteps = 12;
      for (int u = 0; u <= kSteps; ++u)
        for (int v = 0; u + v <= kSteps; ++v)
          least = std::min(least, length(a + (b - a) * (u / double{kSteps}) + (c - a) * (v / double{kSteps}) - p));
    }
    EXPECT_LE(e.distances[i], least * (1 + 1e-5));
    EXPECT_GE(e.distances[i], least - 0.1 * pipeline.lattice().report.mean_edge);
  }
}

TEST(Embed, enclosed_soups_have_no_vertex_outside) {
  for (const char* name : {"torus", "heart", "robot"}) {
    const TriangleSoup soup = make_sample(name);
    MeshOptions options;
    options.distance.voxels = 48;
    options.lattice.tets = 800;
    options.lattice.cover = Cover::Enclose;
    const Embedding e = embed_points(mesh_soup(soup, options), soup);
    EXPECT_EQ(e.report.outside, 0U) << name;
    EXPECT_EQ(e.report.inside, soup.vertices.size());
  }
}

TEST(Embed, an_affine_map_carries_the_surface_exactly) {
  for (const char* name : {"torus", "robot", "tree"}) {
    const TriangleSoup soup = make_sample(name);
    MeshOptions options;
    options.distance.voxels = 48;
    options.lattice.tets = 500;
    const TetMesh mesh = mesh_soup(soup, options);
    const Embedding e = embed_points(mesh, soup, {.max_extrapolation = 1000});
    ASSERT_EQ(e.report.drawn_closer, 0U) << name;
    const std::vector<Vec3> expected = moved(soup.vertices, sheared);
    EXPECT_LT(largest_distance(deform_points(e, mesh.tets, moved(mesh.vertices, sheared)), expected), 2e-5) << name;
    EXPECT_LT(largest_distance(deform_points(e, mesh.tets, mesh.vertices), soup.vertices), 1e-5) << name;
  }
}

TEST(Embed, finer_meshes_carry_a_bend_better) {
  const TriangleSoup soup = test::make_ball();
  const auto bend = [](const Vec3d& p) { return bent(p, 3); };
  std::vector<double> errors;
  for (const std::size_t tets : {500U, 4000U, 32000U}) {
    MeshOptions options;
    options.distance.voxels = 64;
    options.lattice.tets = tets;
    options.lattice.cover = Cover::Enclose;
    const TetMesh mesh = mesh_soup(soup, options);
    const Embedding e = embed_points(mesh, soup);
    errors.push_back(
        largest_distance(deform_points(e, mesh.tets, moved(mesh.vertices, bend)), moved(soup.vertices, bend)));
  }
  // Linear in each tet: the error falls with the square of the edge, four times for eight times the tets.
  EXPECT_LT(errors[1], errors[0] / 2.5);
  EXPECT_LT(errors[2], errors[1] / 2.5);
}

TEST(Embed, normals_stay_upright_on_planes_that_are_sheared) {
  const Embedding e = embed_points(kCorner, points({{0.2F, 0.2F, 0.2F}}));
  const Vec3d u{1, 2, -1}, v{0.5, -1, 2};  // In a plane; its normal:
  const Vec3d n = cross(u, v) * (1 / length(cross(u, v)));
  const std::vector<Vec3> positions = moved(kCorner.vertices, sheared);
  const Vec3 normal = deform_normals(e, kCorner, positions, std::vector<Vec3>{to_float(n)})[0];
  const Vec3d origin = sheared({0, 0, 0});
  const Vec3d expected = cross(sheared(u) - origin, sheared(v) - origin);
  EXPECT_NEAR(length(to_double(normal) - expected * (1 / length(expected))), 0, 1e-6);
}

TEST(Embed, a_flat_tet_leaves_the_normal_and_holds_points_at_its_corners) {
  const TetMesh flat{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2, 3}}};
  const Embedding e = embed_points(flat, points({{0.9F, 0.95F, 2}}));
  EXPECT_EQ(e.weights[0], (std::array<float, 4>{0, 0, 0, 1}));
  EXPECT_EQ(e.report.drawn_closer, 1U);
  EXPECT_EQ(deform_normals(e, flat, flat.vertices, std::vector<Vec3>{{0, 1, 0}})[0], (Vec3{0, 1, 0}));
}

TEST(Embed, points_that_are_none_are_counted) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  const Embedding e = embed_points(kCorner, points({{nan, 0, 0}, {0, inf, 0}, {0.1F, 0.1F, 0.1F}}));
  EXPECT_EQ(e.report.non_finite, 2U);
  EXPECT_EQ(e.report.inside, 1U);
  EXPECT_EQ(e.weights[0], (std::array<float, 4>{1, 0, 0, 0}));
  EXPECT_TRUE(std::isinf(e.distances[1]));
}

TEST(Embed, meshes_that_cannot_hold_points_are_refused) {
  EXPECT_THROW(embed_points({}, points({{0, 0, 0}})), InvalidInput);
  EXPECT_THROW(embed_points({{{0, 0, 0}}, {{0, 0, 0, 0}}}, points({{0, 0, 0}})), InvalidInput);
  EXPECT_THROW(embed_points({kCorner.vertices, {{0, 1, 2, 4}}}, {}), InvalidInput);
  TetMesh broken = kCorner;
  broken.vertices[2].y = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(embed_points(broken, {}), InvalidInput);
  EXPECT_THROW(embed_points(kCorner, {}, {.max_extrapolation = -1}), InvalidInput);
  Embedding e = embed_points(kCorner, points({{0, 0, 0}}));
  e.tets[0] = 1;
  EXPECT_THROW(deform_points(e, kCorner.tets, kCorner.vertices), InvalidInput);
  EXPECT_THROW(deform_normals(e, kCorner, {}, {}), InvalidInput);
}

TEST(Embed, random_meshes_and_points_give_finite_weights_with_sum_one) {
  test::Random random(7);
  for (int trial = 0; trial < 300; ++trial) {
    const double scale = std::pow(10.0, random.uniform(-6, 6)), flat = trial % 3 == 0 ? 0 : 1;
    const auto point = [&] {
      return to_float(
          {random.uniform(-1, 1) * scale, random.uniform(-1, 1) * scale, random.uniform(-1, 1) * scale * flat});
    };
    TetMesh mesh;
    for (int i = 0; i < 12; ++i) mesh.vertices.push_back(point());
    mesh.tets.push_back({0, 1, 2, 3});
    for (int i = 0; i < 20; ++i) {
      Tet t;
      for (std::uint32_t& v : t) v = static_cast<std::uint32_t>(random.below(12));
      mesh.tets.push_back(t);
    }
    TriangleSoup soup;
    for (int i = 0; i < 30; ++i) soup.vertices.push_back(point());
    for (int i = 0; i < 20; ++i)
      soup.triangles.push_back({static_cast<std::uint32_t>(random.below(31)),
                                static_cast<std::uint32_t>(random.below(30)),
                                static_cast<std::uint32_t>(random.below(30))});
    const Embedding e = embed_points(mesh, soup);
    for (std::size_t i = 0; i < soup.vertices.size(); ++i) {
      ASSERT_LT(e.tets[i], mesh.tets.size());
      const auto& w = e.weights[i];
      ASSERT_NEAR(double{w[0]} + w[1] + w[2] + w[3], 1, 1e-5);
      for (const float x : w) ASSERT_GE(x, -4.001F);
    }
  }
}

TEST(Embed, the_number_of_threads_leaves_no_trace) {
  const TriangleSoup soup = make_sample("tree");
  MeshOptions options;
  options.distance.voxels = 48;
  const TetMesh mesh = mesh_soup(soup, options);
  set_thread_count(1);
  const Embedding one = embed_points(mesh, soup);
  set_thread_count(0);
  const Embedding all = embed_points(mesh, soup);
  EXPECT_EQ(one.tets, all.tets);
  EXPECT_EQ(one.weights, all.weights);
  EXPECT_EQ(one.distances, all.distances);
}

TEST(Embed, cancelling_stops_it) {
  const TriangleSoup soup = make_sample("torus");
  MeshOptions options;
  options.distance.voxels = 32;
  const TetMesh mesh = mesh_soup(soup, options);
  EXPECT_THROW(embed_points(mesh, soup, {}, [](std::string_view stage, double) { return stage != "embed"; }),
               Cancelled);
}

}  // namespace
}  // namespace tetsoup
