// Tets, faces and edges that have only boundary vertices: removed from thick parts, or split.
#include <gtest/gtest.h>

#include <set>

#include "candidate_shapes.h"
#include "lattice/clean_topology.h"
#include "tetsoup/quality.h"

namespace tetsoup {
namespace {

using test::block_candidates;
using test::keep_at_random;
using test::keep_inside;

TopologyReport clean(Candidates& c, BoundaryOnly boundary_only) {
  const Progress nobody;
  StageWatch watch(nobody, "test");
  TopologyOptions options;
  options.boundary_only = boundary_only;
  return clean_topology(c, options, watch);
}
Quality quality_of(const Candidates& c) {
  return measure_quality(kept_mesh(c));
}

/// Interior edges and faces with only boundary vertices, looked for one by one.
std::size_t count_inner_boundary_only(const TetMesh& mesh) {
  std::set<std::vector<std::uint32_t>> boundary, inner;  // vertices, edges and faces by their sorted corners
  const auto add_all = [](std::vector<std::uint32_t> corners, std::set<std::vector<std::uint32_t>>& to) {
    std::sort(corners.begin(), corners.end());
    for (unsigned bits = 1; bits < 1U << corners.size(); ++bits) {
      std::vector<std::uint32_t> some;
      for (std::size_t i = 0; i < corners.size(); ++i)
        if (bits >> i & 1U) some.push_back(corners[i]);
      to.insert(some);
    }
  };
  for (const Triangle& t : boundary_triangles(mesh)) add_all({t.begin(), t.end()}, boundary);
  for (const Tet& t : mesh.tets) add_all({t.begin(), t.end()}, inner);
  return static_cast<std::size_t>(std::count_if(inner.begin(), inner.end(), [&](const auto& simplex) {
    const auto on_boundary = [&](std::uint32_t v) { return boundary.count({v}) != 0; };
    return boundary.count(simplex) == 0 && std::all_of(simplex.begin(), simplex.end(), on_boundary);
  }));
}

TEST(BoundaryOnly, splitting_leaves_no_interior_edge_face_or_tet_with_boundary_vertices_only) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    Candidates left = block_candidates({3, 3, 3});
    keep_at_random(left, seed, 0.1 + 0.9 * static_cast<double>(seed % 11) / 10);
    Candidates split = left;
    clean(left, BoundaryOnly::Leave);
    const TopologyReport r = clean(split, BoundaryOnly::Split);
    const Quality before = quality_of(left), after = quality_of(split);
    ASSERT_EQ(count_inner_boundary_only(kept_mesh(split)), 0U);
    ASSERT_EQ(after.boundary_only_tets, 0U);
    ASSERT_EQ(r.boundary_only_tets, before.boundary_only_tets);
    ASSERT_TRUE(after.boundary_manifold);
    ASSERT_EQ(after.components, before.components);
    ASSERT_EQ(after.boundary_triangles, before.boundary_triangles);
    ASSERT_EQ(after.inverted_tets + after.invalid_tets + after.unused_vertices, 0U);
    ASSERT_NEAR(after.volume, before.volume, 1e-6 * before.volume);
    ASSERT_EQ(split.density.size(), split.mesh.tets.size());
    ASSERT_EQ(split.kept.size(), split.mesh.tets.size());
    Candidates again = split;
    ASSERT_EQ(clean(again, BoundaryOnly::Split).boundary_only_tets, 0U);
    ASSERT_EQ(again.mesh.tets, split.mesh.tets);
  }
}

TEST(BoundaryOnly, a_tet_alone_is_split_in_four) {
  Candidates c = block_candidates({1, 1, 1});
  c.kept[0] = 1;
  c.density[0] = 1;
  const TopologyReport r = clean(c, BoundaryOnly::Split);
  EXPECT_EQ(r.boundary_only_tets, 1U);
  EXPECT_EQ(r.boundary_only_edges, 0U);
  EXPECT_EQ(quality_of(c).tet_count, 4U);
  EXPECT_EQ(quality_of(c).boundary_only_tets, 0U);
}

TEST(BoundaryOnly, removal_keeps_the_manifold_and_the_number_of_components) {
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    SCOPED_TRACE(seed);
    Candidates left = block_candidates({4, 4, 4});
    keep_at_random(left, seed, 0.3 + 0.7 * static_cast<double>(seed % 11) / 10);
    Candidates removed = left;
    clean(left, BoundaryOnly::Leave);
    const TopologyReport r = clean(removed, BoundaryOnly::Remove);
    const Quality before = quality_of(left), after = quality_of(removed);
    ASSERT_TRUE(after.boundary_manifold);
    ASSERT_EQ(after.components, before.components);
    ASSERT_EQ(after.tet_count + r.boundary_only_tets, before.tet_count);
    ASSERT_EQ(after.boundary_only_tets + r.boundary_only_tets, before.boundary_only_tets);
    Candidates again = removed;
    ASSERT_EQ(clean(again, BoundaryOnly::Remove).boundary_only_tets, 0U);
    ASSERT_EQ(again.kept, removed.kept);
  }
}

TEST(BoundaryOnly, removal_takes_the_corners_of_a_block_and_nothing_of_a_plate) {
  Candidates block = block_candidates({3, 3, 3}), plate = block_candidates({6, 6, 1});
  const auto everything = [](const Vec3d&) { return true; };
  keep_inside(block, everything);
  keep_inside(plate, everything);
  EXPECT_GT(clean(block, BoundaryOnly::Remove).boundary_only_tets, 0U);
  EXPECT_EQ(clean(plate, BoundaryOnly::Remove).boundary_only_tets, 0U);
  EXPECT_EQ(quality_of(plate).tet_count, 180U);
}

}  // namespace
}  // namespace tetsoup
