// Parts that share a cell but do not touch get copies of their own; what hangs together stays as it is.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "solid_candidates.h"
#include "base/tet_faces.h"
#include "base/unions.h"
#include "lattice/separate.h"
#include "shapes.h"
#include "tetsoup/quality.h"

namespace tetsoup {
namespace {

using test::euler_characteristic;
using test::make_candidates;
using test::make_solid;

Separated separate(Candidates& candidates, const BitGrid& inside, double rho_min = 0.5) {
  const Progress nobody;
  StageWatch watch(nobody, "lattice");
  return tetsoup::separate(candidates, inside, VoxelParts(inside, watch), rho_min, watch);
}

/// Distance to a circle of radius `major` around z, less `minor`.
double torus(const Vec3d& p, double major, double minor) {
  return std::hypot(std::hypot(p.x, p.y) - major, p.z) - minor;
}

double capsule(const Vec3d& p, const Vec3d& a, const Vec3d& b, double radius) {
  const double t = std::clamp(dot(p - a, b - a) / dot(b - a, b - a), 0.0, 1.0);
  return length(p - a - (b - a) * t) - radius;
}

void expect_sound(const Candidates& candidates) {
  ASSERT_EQ(candidates.density.size(), candidates.mesh.tets.size());
  ASSERT_EQ(candidates.kept.size(), candidates.mesh.tets.size());
  const Quality all = measure_quality(candidates.mesh);
  EXPECT_EQ(all.inverted_tets + all.invalid_tets, 0U);
  // No face has three tets, and no two tets lie folded on each other.
  std::map<std::array<std::uint32_t, 3>, std::array<int, 2>> sides;
  for (const Tet& tet : kept_mesh(candidates).tets) {
    for (const auto& f : kTetFaces) {
      std::array<std::uint32_t, 3> face{};
      for (std::size_t i = 0; i < 3; ++i) face[i] = tet[static_cast<std::size_t>(f[i])];
      const auto least = std::min_element(face.begin(), face.end());
      std::rotate(face.begin(), least, face.end());
      const bool turned = face[1] > face[2];
      if (turned) std::swap(face[1], face[2]);
      EXPECT_EQ(++sides[face][turned], 1);
    }
  }
}

/// Components of more than three tets: where a finger ends a tet may hang by an edge, as it does on one finger alone.
std::size_t count_parts(const TetMesh& mesh) {
  Unions tets(mesh.tets.size());
  const std::vector<TetFace> faces = sorted_faces(mesh);
  for (std::size_t i = 1; i < faces.size(); ++i)
    if (faces[i].corners == faces[i - 1].corners) tets.join(faces[i].slot / 4, faces[i - 1].slot / 4);
  std::map<std::size_t, std::size_t> sizes;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) ++sizes[tets.find(t)];
  return static_cast<std::size_t>(
      std::count_if(sizes.begin(), sizes.end(), [](const auto& size) { return size.second > 3; }));
}

class Shifts : public testing::TestWithParam<Vec3d> {};
INSTANTIATE_TEST_SUITE_P(Lattice, Shifts,
                         testing::Values(Vec3d{0, 0, 0}, Vec3d{0.5, 0, 0}, Vec3d{0.3, 0.7, 0.1}, Vec3d{0.9, 0.4, 0.6}));

TEST_P(Shifts, a_ball_and_a_block_stay_as_they_are) {
  const auto ball = [](Vec3d p) { return length(p) < 1; };
  const auto block = [](Vec3d p) { return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) < 0.9; };
  for (const std::function<bool(Vec3d)>& solid :
       {std::function<bool(Vec3d)>(ball), std::function<bool(Vec3d)>(block)}) {
    const BitGrid inside = make_solid({{-1, -1, -1}, {1, 1, 1}}, 60, solid);
    Candidates candidates = make_candidates(inside, 0.25, 0.5, GetParam());
    const Candidates before = candidates;
    const Separated done = separate(candidates, inside);
    EXPECT_EQ(done.tets + done.vertices, 0U);
    EXPECT_EQ(candidates.mesh.tets, before.mesh.tets);
    EXPECT_EQ(candidates.mesh.vertices, before.mesh.vertices);
    EXPECT_EQ(candidates.kept, before.kept);
  }
}

TEST_P(Shifts, two_tori_in_each_other_with_a_gap_of_a_third_of_a_cell_are_two) {
  const double major = 1, minor = 0.45, gap = major - 2 * minor, cell = gap / 0.3;
  const auto solid = [&](Vec3d p) {
    return torus(p, major, minor) < 0 || torus({p.x - major, p.z, p.y}, major, minor) < 0;
  };
  const BitGrid inside = make_solid({{-1.5, -1.5, -1.5}, {2.5, 1.5, 1.5}}, 128, solid);
  Candidates candidates = make_candidates(inside, cell, 0.5, GetParam());
  EXPECT_EQ(measure_quality(kept_mesh(candidates)).components, 1U);
  separate(candidates, inside);
  expect_sound(candidates);
  const TetMesh mesh = kept_mesh(candidates);
  EXPECT_EQ(measure_quality(mesh).components, 2U);
  EXPECT_EQ(euler_characteristic(mesh), 0);
}

TEST_P(Shifts, a_ring_with_a_slit_of_a_third_of_a_cell_stays_open) {
  const double cell = 0.3, slit = 0.3 * cell;
  const auto solid = [&](Vec3d p) { return torus(p, 1, 0.4) < 0 && !(p.x > 0 && std::abs(p.y) < slit / 2); };
  const BitGrid inside = make_solid({{-1.4, -1.4, -0.4}, {1.4, 1.4, 0.4}}, 128, solid);
  Candidates candidates = make_candidates(inside, cell, 0.5, GetParam());
  separate(candidates, inside);
  expect_sound(candidates);
  const TetMesh mesh = kept_mesh(candidates);
  EXPECT_EQ(measure_quality(mesh).components, 1U);
  EXPECT_EQ(euler_characteristic(mesh), 1);
}

TEST_P(Shifts, a_closed_ring_stays_one_ring) {
  for (const double minor : {0.2, 0.4, 0.7}) {
    const BitGrid inside =
        make_solid({{-1.7, -1.7, -0.7}, {1.7, 1.7, 0.7}}, 128, [&](Vec3d p) { return torus(p, 1, minor) < 0; });
    Candidates candidates = make_candidates(inside, 0.25, 0.5, GetParam());
    separate(candidates, inside);
    expect_sound(candidates);
    EXPECT_EQ(measure_quality(kept_mesh(candidates)).components, 1U);
    EXPECT_EQ(euler_characteristic(kept_mesh(candidates)), 0) << minor;
  }
}

TEST_P(Shifts, a_hand_keeps_its_five_fingers) {
  const double radius = 0.2, gap = 0.08, cell = gap / 0.3, pitch = 2 * radius + gap;
  const auto solid = [&](Vec3d p) {
    double d = std::max({std::abs(p.x) - 2.5 * pitch, std::abs(p.y + 0.5) - 0.5, std::abs(p.z) - radius});
    for (int i = -2; i <= 2; ++i)
      d = std::min(d, capsule(p, {i * pitch, -0.3, 0}, {i * pitch, 1.2 - 0.1 * i * i, 0}, radius));
    return d < 0;
  };
  const BitGrid inside = make_solid({{-1.2, -1, -0.2}, {1.2, 1.4, 0.2}}, 128, solid);
  Candidates candidates = make_candidates(inside, cell, 0.5, GetParam());
  separate(candidates, inside);
  expect_sound(candidates);
  EXPECT_EQ(count_parts(kept_mesh(candidates)), 1U);
  // Above the roots, where the slits may begin a cell later, there are five.
  for (std::size_t t = 0; t < candidates.kept.size(); ++t) {
    Vec3d centre;
    for (const std::uint32_t v : candidates.mesh.tets[t]) centre += to_double(candidates.mesh.vertices[v]) * 0.25;
    if (centre.y < 1.5 * cell) candidates.kept[t] = 0;
  }
  EXPECT_EQ(count_parts(kept_mesh(candidates)), 5U);
}

TEST(Separate, two_balls_that_touch_are_left_together) {
  const auto solid = [](Vec3d p) { return length(p) < 0.5 || length(p - Vec3d{0.95, 0, 0}) < 0.5; };
  const BitGrid inside = make_solid({{-0.5, -0.5, -0.5}, {1.45, 0.5, 0.5}}, 100, solid);
  Candidates candidates = make_candidates(inside, 0.3);
  const std::size_t components = measure_quality(kept_mesh(candidates)).components;
  separate(candidates, inside);
  EXPECT_EQ(measure_quality(kept_mesh(candidates)).components, components);
}

TEST(Separate, two_thin_plates_in_one_layer_of_cells_each_keep_it) {
  // Each fills a third of the cells, together two thirds: alone neither would be dense anywhere.
  const double cell = 0.25;
  const Vec3d lo{-1, -1, -0.15};
  const BitGrid inside = make_solid({lo, {1, 1, 0.15}}, 192, [&](Vec3d p) {
    const double height = (p.z - lo.z) / cell;
    return std::abs(p.x) < 1 && std::abs(p.y) < 1 && (std::abs(height - 0.3) < 0.16 || std::abs(height - 0.7) < 0.16);
  });
  // A layer of cells begins at lo.z.
  const double shift = (1.5 * inside.frame.voxel_size + 1.5 * cell) / cell;
  Candidates candidates = make_candidates(inside, cell, 0.4, {0, 0, shift - std::floor(shift)});
  EXPECT_EQ(measure_quality(kept_mesh(candidates)).components, 1U);
  EXPECT_GT(separate(candidates, inside, 0.4).tets, 100U);
  expect_sound(candidates);
  EXPECT_EQ(measure_quality(kept_mesh(candidates)).components, 2U);
}

}  // namespace
}  // namespace tetsoup
