// The sample shapes: what their summaries promise, and the same bits every time.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <set>
#include <tuple>

#include "base/tet_geometry.h"
#include "tetsoup/error.h"
#include "tetsoup/samples.h"

namespace tetsoup {
namespace {

constexpr double kPi = 3.14159265358979323846;

/// FNV-1a over the bytes of vertices and triangles.
std::uint64_t hash_of(const TriangleSoup& soup) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  const auto add = [&](std::uint32_t word) {
    for (int shift = 0; shift < 32; shift += 8) hash = (hash ^ ((word >> shift) & 255U)) * 0x100000001b3U;
  };
  for (const Vec3& v : soup.vertices) {
    for (const float f : {v.x, v.y, v.z}) {
      std::uint32_t word = 0;
      std::memcpy(&word, &f, sizeof word);
      add(word);
    }
  }
  for (const Triangle& t : soup.triangles)
    for (const std::uint32_t i : t) add(i);
  return hash;
}

/// Every edge runs once each way: closed, manifold and consistently oriented.
bool is_closed(const TriangleSoup& soup) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const Triangle& t : soup.triangles)
    for (std::size_t i = 0; i < 3; ++i) ++edges[{t[i], t[(i + 1) % 3]}];
  return std::all_of(edges.begin(), edges.end(), [&](const auto& edge) {
    const auto back = edges.find({edge.first.second, edge.first.first});
    return edge.second == 1 && back != edges.end();
  });
}

std::size_t distinct_positions(const TriangleSoup& soup) {
  std::set<std::tuple<float, float, float>> positions;
  for (const Triangle& t : soup.triangles)
    for (const std::uint32_t i : t) positions.insert({soup.vertices[i].x, soup.vertices[i].y, soup.vertices[i].z});
  return positions.size();
}

double enclosed_volume(const TriangleSoup& soup) {
  double sum = 0;
  for (const Triangle& t : soup.triangles)
    sum += signed_volume({}, to_double(soup.vertices[t[0]]), to_double(soup.vertices[t[1]]),
                         to_double(soup.vertices[t[2]]));
  return sum;
}

std::array<double, 3> extents(const TriangleSoup& soup) {
  Vec3d lo = to_double(soup.vertices.at(0)), hi = lo;
  for (const Vec3& v : soup.vertices) lo = min(lo, to_double(v)), hi = max(hi, to_double(v));
  return {hi.x - lo.x, hi.y - lo.y, hi.z - lo.z};
}

double smallest_area(const TriangleSoup& soup) {
  double smallest = 1e30;
  for (const Triangle& t : soup.triangles) {
    const Vec3d a = to_double(soup.vertices[t[0]]);
    smallest =
        std::min(smallest, length(cross(to_double(soup.vertices[t[1]]) - a, to_double(soup.vertices[t[2]]) - a)) / 2);
  }
  return smallest;
}

TEST(Samples, are_listed_in_a_fixed_order_each_with_a_summary) {
  EXPECT_EQ(sample_names(), (std::vector<std::string>{"torus", "heart", "sphere", "robot", "tree", "palm", "cup",
                                                      "pipe", "tray", "comb", "chain"}));
  for (const std::string& name : sample_names()) EXPECT_FALSE(sample_summary(name).empty());
}

TEST(Samples, the_torus_has_640_triangles_and_the_exact_volume_and_extents) {
  const TriangleSoup torus = make_sample("torus");
  EXPECT_EQ(torus.triangles.size(), 640U);
  EXPECT_TRUE(is_closed(torus));
  const double exact = 2 * kPi * kPi * kTorusMajorRadius * kTorusMinorRadius * kTorusMinorRadius;
  EXPECT_NEAR(enclosed_volume(torus) / exact, 1, 1e-3);
  // 150 voxels along the longest axis make 150 x 150 x 37 or 38.
  const auto size = extents(torus);
  const double voxel = std::max(size[0], size[1]) / 150;
  EXPECT_GT(std::min(size[0], size[1]) / voxel, 149);
  EXPECT_GT(size[2] / voxel, 36);
  EXPECT_LE(size[2] / voxel, 38);
}

TEST(Samples, the_torus_agrees_with_the_exact_one_where_voxels_can_tell) {
  const TriangleSoup torus = make_sample("torus");
  constexpr double kGap = 0.012;  // Of the volume; a grid of 32 x 10 quads misses by 0.06.
  // The volume between the two surfaces, from the distance at many points of each triangle.
  constexpr int kSteps = 12;
  double between = 0;
  for (const Triangle& t : torus.triangles) {
    const Vec3d a = to_double(torus.vertices[t[0]]), u = to_double(torus.vertices[t[1]]) - a,
                v = to_double(torus.vertices[t[2]]) - a;
    for (int i = 0; i < kSteps; ++i) {
      for (int j = 0; i + j < kSteps; ++j) {
        const Vec3d p = a + u * ((i + 1.0 / 3) / kSteps) + v * ((j + 1.0 / 3) / kSteps);
        const double off = std::hypot(std::hypot(p.x, p.y) - kTorusMajorRadius, p.z) - kTorusMinorRadius;
        between += std::abs(off) * length(cross(u, v)) / (kSteps * (kSteps + 1));
      }
    }
  }
  const double exact = 2 * kPi * kPi * kTorusMajorRadius * kTorusMinorRadius * kTorusMinorRadius;
  EXPECT_LT(between / exact, kGap);
}

TEST(Samples, heart_sphere_and_robot_are_closed) {
  for (const char* name : {"heart", "sphere", "robot"}) {
    const TriangleSoup soup = make_sample(name);
    EXPECT_TRUE(is_closed(soup)) << name;
    EXPECT_GT(enclosed_volume(soup), 0) << name;
    EXPECT_GT(smallest_area(soup), 0) << name;
  }
}

TEST(Samples, the_heart_has_a_notch) {
  // On the middle plane the surface lies lower than beside it.
  float middle = 0, highest = 0;
  for (const Vec3& v : make_sample("heart").vertices) {
    if (std::abs(v.x) < 1e-6F && std::abs(v.y) < 1e-6F) middle = std::max(middle, v.z);
    highest = std::max(highest, v.z);
  }
  EXPECT_GT(middle, 0.9F);
  EXPECT_GT(highest, middle + 0.15F);
}

TEST(Samples, the_sphere_is_one) {
  const TriangleSoup sphere = make_sample("sphere");
  for (const Vec3& v : sphere.vertices) EXPECT_NEAR(length(to_double(v)), 1, 1e-6);
  EXPECT_NEAR(enclosed_volume(sphere), 4 * kPi / 3, 0.02);
}

TEST(Samples, the_robot_has_about_16_thousand_triangles_in_many_closed_parts) {
  const TriangleSoup robot = make_sample("robot");
  EXPECT_NEAR(static_cast<double>(robot.triangles.size()), 16000, 800);
}

/// Area of a regular polygon of 48 sides in the circle of radius 1.
const double kPolygon = 24 * std::sin(kPi / 24);

TEST(Samples, thin_shapes_are_closed_and_their_volume_is_that_of_their_walls) {
  const auto square = [](double x) { return x * x; };
  for (const double w : {0.0025, 0.01, 0.05, 0.1}) {
    const struct {
      const char* name;
      double volume;
    } shapes[]{{"cup", kPolygon * (0.25 - square(0.5 - w) * (1 - w))},
               {"pipe", kPolygon * (square(0.25) - square(0.25 - w))},
               {"tray", 0.7 * 0.25 - (1 - 2 * w) * (0.7 - 2 * w) * (0.25 - w)},
               {"comb", 0.25 * (0.2 + 8 * w * 0.4)}};
    for (const auto& shape : shapes) {
      const TriangleSoup soup = make_sample(shape.name, {.wall = w});
      EXPECT_TRUE(is_closed(soup)) << shape.name;
      EXPECT_NEAR(enclosed_volume(soup) / shape.volume, 1, 1e-4) << shape.name << " " << w;
      const auto size = extents(soup);
      EXPECT_NEAR(*std::max_element(size.begin(), size.end()), 1, 1e-6) << shape.name;
    }
  }
}

TEST(Samples, the_links_of_the_chain_do_not_touch) {
  for (const double w : {0.02, 0.15, 0.2}) {
    const TriangleSoup chain = make_sample("chain", {.wall = w});
    EXPECT_TRUE(is_closed(chain));
    EXPECT_GT(enclosed_volume(chain), 0);
    // Two links in each other: no vertex of one is nearer to the other's wire than a twentieth of it.
    const std::size_t link = chain.vertices.size() / 8;
    double nearest = 1;
    for (std::size_t a = 0; a < link; ++a)
      for (std::size_t b = link; b < 2 * link; ++b)
        nearest = std::min(nearest, length(to_double(chain.vertices[a]) - to_double(chain.vertices[b])));
    EXPECT_GT(nearest, 0.05 * w);
    EXPECT_NEAR(extents(chain)[0], 1 + 7 * (1 - 2.1 * w), 1e-6);
  }
}

TEST(Samples, a_wall_is_refused_where_there_is_none_or_no_room) {
  EXPECT_THROW(make_sample("torus", {.wall = 0.1}), InvalidInput);
  for (const double wall : {0.0, -0.1, 0.5, std::nan("")})
    EXPECT_THROW(make_sample("cup", {.wall = wall}), InvalidInput);
  EXPECT_NEAR(enclosed_volume(make_sample("cup")), enclosed_volume(make_sample("cup", {.wall = 0.02})), 1e-9);
}

TEST(Samples, no_two_triangles_of_tree_and_palm_touch) {
  for (const char* name : {"tree", "palm"}) {
    const TriangleSoup soup = make_sample(name);
    EXPECT_EQ(soup.vertices.size(), 3 * soup.triangles.size()) << name;
    EXPECT_EQ(distinct_positions(soup), soup.vertices.size()) << name;
    EXPECT_GT(smallest_area(soup), 0) << name;
  }
  EXPECT_EQ(make_sample("tree").triangles.size(), 8000U);
}

TEST(Samples, the_seed_moves_the_leaves) {
  EXPECT_NE(hash_of(make_sample("tree", {0, 1})), hash_of(make_sample("tree", {0, 2})));
  EXPECT_EQ(hash_of(make_sample("tree", {0, 2})), hash_of(make_sample("tree", {0, 2})));
}

TEST(Samples, damage_removes_its_share_and_keeps_the_vertices) {
  const TriangleSoup whole = make_sample("sphere");
  const TriangleSoup half = make_sample("sphere", {0.5, 1});
  EXPECT_EQ(half.triangles.size(), whole.triangles.size() / 2);
  EXPECT_EQ(half.vertices, whole.vertices);
  EXPECT_EQ(remove_triangles(whole, 0.333, 7).triangles.size(), whole.triangles.size() - 899);
  EXPECT_EQ(remove_triangles(whole, 0, 7).triangles, whole.triangles);
  EXPECT_NE(remove_triangles(whole, 0.5, 1).triangles, remove_triangles(whole, 0.5, 2).triangles);
}

TEST(Samples, damage_takes_from_everywhere_alike) {
  const TriangleSoup whole = make_sample("sphere");
  const TriangleSoup half = remove_triangles(whole, 0.5, 3);
  double upper = 0;
  for (const Triangle& t : half.triangles) upper += whole.vertices[t[0]].z > 0 ? 1 : 0;
  EXPECT_NEAR(upper / static_cast<double>(half.triangles.size()), 0.5, 0.06);
  // What is left stays in its order.
  auto at = whole.triangles.begin();
  for (const Triangle& t : half.triangles) {
    at = std::find(at, whole.triangles.end(), t);
    ASSERT_NE(at, whole.triangles.end());
  }
}

TEST(Samples, an_unknown_name_is_answered_with_the_known_ones) {
  try {
    make_sample("teapot");
    FAIL() << "no exception";
  } catch (const InvalidInput& error) {
    EXPECT_STREQ(error.what(),
                 "sample = teapot, must be one of torus, heart, sphere, robot, tree, palm, cup, "
                 "pipe, tray, comb, chain");
  }
  EXPECT_THROW(sample_summary(""), InvalidInput);
}

TEST(Samples, a_damage_out_of_range_is_refused) {
  for (const double damage : {-0.1, 1.0, std::nan("")}) EXPECT_THROW(make_sample("sphere", {damage, 1}), InvalidInput);
  EXPECT_THROW(remove_triangles({}, 2, 1), InvalidInput);
  EXPECT_TRUE(remove_triangles({}, 0.5, 1).triangles.empty());
}

}  // namespace
}  // namespace tetsoup
