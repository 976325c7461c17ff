// Clean-up of the lattice: what it promises, on random kept sets and on shapes with a known answer.
#include <gtest/gtest.h>

#include "candidate_shapes.h"
#include "lattice/clean_topology.h"
#include "tetsoup/error.h"
#include "tetsoup/quality.h"

namespace tetsoup {
namespace {

using test::block_candidates;
using test::keep_at_random;
using test::keep_inside;

TopologyReport clean(Candidates& c, const TopologyOptions& options = {}) {
  const Progress nobody;
  StageWatch watch(nobody, "test");
  return clean_topology(c, options, watch);
}

/// Everything off.
TopologyOptions nothing() {
  return {Touching::Leave, 0, Bubbles::Keep, BoundaryOnly::Leave};
}
TopologyOptions mend_only() {
  TopologyOptions options = nothing();
  options.touching = Touching::Mend;
  return options;
}

std::size_t count_kept(const Candidates& c) {
  return static_cast<std::size_t>(std::count_if(c.kept.begin(), c.kept.end(), [](auto k) { return k != 0; }));
}
Quality quality_of(const Candidates& c) {
  return measure_quality(kept_mesh(c));
}
bool is_same(const Candidates& a, const Candidates& b) {
  return a.mesh.vertices == b.mesh.vertices && a.mesh.tets == b.mesh.tets && a.kept == b.kept && a.density == b.density;
}
bool did_nothing(const TopologyReport& r) {
  return r.touching_mended + r.tets_added + r.tets_dropped + r.vertices_doubled + r.parts_dropped + r.bubbles_filled +
             r.bubble_tets + r.boundary_only_tets + r.boundary_only_edges ==
         0;
}

/// Cells (x, y, z) of a block as a set: keeps their tets.
void keep_cells(Candidates& c, const std::vector<std::array<int, 3>>& cells) {
  keep_inside(c, [&](const Vec3d& p) {
    const std::array<int, 3> cell{static_cast<int>(p.x), static_cast<int>(p.y), static_cast<int>(p.z)};
    return std::find(cells.begin(), cells.end(), cell) != cells.end();
  });
}

void expect_promises(const Candidates& before, const Candidates& after, const TopologyReport& r) {
  const Quality q = quality_of(after);
  ASSERT_TRUE(q.boundary_manifold) << q.non_manifold_edges << " edges, " << q.non_manifold_vertices << " vertices";
  ASSERT_EQ(q.inverted_tets + q.invalid_tets + q.unused_vertices, 0U);
  ASSERT_EQ(after.mesh.vertices.size(), before.mesh.vertices.size() + r.vertices_doubled);
  ASSERT_EQ(after.mesh.tets.size(), before.mesh.tets.size());
  ASSERT_GT(q.tet_count, 0U);
}

void check_random_sets(const Candidates& block, std::uint64_t seeds, const TopologyOptions& options) {
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    SCOPED_TRACE(seed);
    Candidates before = block;
    keep_at_random(before, seed, 0.1 + 0.8 * static_cast<double>(seed % 17) / 16);
    Candidates after = before;
    const TopologyReport r = clean(after, options);
    ASSERT_NO_FATAL_FAILURE(expect_promises(before, after, r));
    if (options.min_part == 0) {
      ASSERT_EQ(count_kept(after) + r.tets_dropped, count_kept(before) + r.tets_added + r.bubble_tets);
    }
    Candidates again = after;
    ASSERT_TRUE(did_nothing(clean(again, options)));
    ASSERT_TRUE(is_same(again, after));
    Candidates twin = before;
    clean(twin, options);
    ASSERT_TRUE(is_same(twin, after));
  }
}

TEST(CleanTopology, makes_any_kept_set_a_manifold_and_then_changes_nothing) {
  TopologyOptions options;
  options.min_part = 0;
  check_random_sets(block_candidates({4, 4, 4}), 1000, options);
}

TEST(CleanTopology, does_so_with_parts_dropped_and_bubbles_kept) {
  TopologyOptions options;
  options.min_part = 0.03;
  check_random_sets(block_candidates({5, 4, 3}), 400, options);
  options.bubbles = Bubbles::Keep;
  check_random_sets(block_candidates({5, 4, 3}), 400, options);
}

TEST(CleanTopology, does_so_where_twenty_four_tets_meet) {
  TopologyOptions options;
  options.min_part = 0;
  check_random_sets(test::six_tet_candidates(4), 500, options);
}

TEST(CleanTopology, with_everything_off_leaves_all_as_it_is) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Candidates before = block_candidates({4, 4, 4});
    keep_at_random(before, seed, 0.4);
    Candidates after = before;
    EXPECT_TRUE(did_nothing(clean(after, nothing())));
    EXPECT_TRUE(is_same(before, after));
  }
}

TEST(CleanTopology, cubes_that_touch_at_an_edge_across_a_clear_gap_get_vertices_of_their_own) {
  Candidates c = block_candidates({4, 4, 3});
  keep_cells(c, {{1, 1, 1}, {2, 2, 1}});
  EXPECT_EQ(quality_of(c).non_manifold_edges, 1U);
  const TopologyReport r = clean(c, mend_only());
  const Quality q = quality_of(c);
  EXPECT_TRUE(q.boundary_manifold);
  EXPECT_EQ(q.components, 2U);
  EXPECT_EQ(q.tet_count, 10U);
  EXPECT_EQ(r.touching_mended, 1U);
  EXPECT_EQ(r.vertices_doubled, 2U);
  EXPECT_EQ(r.tets_added + r.tets_dropped, 0U);
}

TEST(CleanTopology, cubes_that_touch_at_an_edge_are_joined_where_the_gap_is_nearly_full) {
  Candidates c = block_candidates({4, 4, 3});
  keep_cells(c, {{1, 1, 1}, {2, 2, 1}});
  for (std::size_t t = 0; t < c.kept.size(); ++t) c.density[t] = c.kept[t] ? 1.0F : 0.45F;
  const TopologyReport r = clean(c, mend_only());
  const Quality q = quality_of(c);
  EXPECT_TRUE(q.boundary_manifold);
  EXPECT_EQ(q.components, 1U);
  EXPECT_EQ(q.tet_count, 10 + r.tets_added);
  EXPECT_GT(r.tets_added, 0U);
  EXPECT_EQ(r.vertices_doubled + r.tets_dropped, 0U);
}

TEST(CleanTopology, cubes_that_touch_at_a_vertex_get_one_of_their_own) {
  Candidates c = block_candidates({4, 4, 4});
  keep_cells(c, {{1, 1, 1}, {2, 2, 2}});
  EXPECT_EQ(quality_of(c).non_manifold_vertices, 1U);
  const TopologyReport r = clean(c, mend_only());
  const Quality q = quality_of(c);
  EXPECT_TRUE(q.boundary_manifold);
  EXPECT_EQ(q.components, 2U);
  EXPECT_EQ(q.tet_count, 10U);
  EXPECT_EQ(r.touching_mended, 1U);
  EXPECT_EQ(r.vertices_doubled, 1U);
}

/// A ring of seven cells around a hole, whose ends touch at an edge.
Candidates pinched_ring(float density_of_gap) {
  Candidates c = block_candidates({5, 5, 3});
  keep_cells(c, {{1, 1, 1}, {2, 1, 1}, {3, 1, 1}, {3, 2, 1}, {1, 2, 1}, {1, 3, 1}, {2, 3, 1}});
  Candidates gap = block_candidates({5, 5, 3});
  keep_cells(gap, {{3, 3, 1}});
  for (std::size_t t = 0; t < c.kept.size(); ++t)
    if (gap.kept[t]) c.density[t] = density_of_gap;
  return c;
}
/// V - E + F of a closed surface: 2 for a ball's, 0 for a ring's.
int euler(const Quality& q) {
  return static_cast<int>(q.boundary_vertices) - static_cast<int>(q.boundary_triangles) / 2;
}

TEST(CleanTopology, a_pinched_ring_opens_at_a_gap_and_closes_where_there_is_none) {
  Candidates open = pinched_ring(0), closed = pinched_ring(0.45F);
  EXPECT_FALSE(quality_of(open).boundary_manifold);
  clean(open, mend_only());
  EXPECT_TRUE(quality_of(open).boundary_manifold);
  EXPECT_EQ(quality_of(open).components, 1U);
  EXPECT_EQ(quality_of(open).tet_count, 35U);
  EXPECT_EQ(euler(quality_of(open)), 2);

  TopologyOptions options = mend_only();
  clean(closed, options);
  EXPECT_TRUE(quality_of(closed).boundary_manifold);
  EXPECT_EQ(quality_of(closed).components, 1U);
  EXPECT_EQ(euler(quality_of(closed)), 0) << "a bridge costs less than the pinch's own tets, and more than doubling";
}

TEST(CleanTopology, a_third_tet_at_a_face_goes) {
  Candidates c = block_candidates({1, 1, 1});
  std::fill(c.kept.begin(), c.kept.end(), std::uint8_t{1});
  std::fill(c.density.begin(), c.density.end(), 1.0F);
  const Tet middle = c.mesh.tets[0];
  c.mesh.vertices.push_back({-1, 1.5F, 0.5F});
  c.mesh.tets.push_back({middle[0], middle[2], middle[1], 8});
  c.mesh.tets.back()[3] = static_cast<std::uint32_t>(c.mesh.vertices.size() - 1);
  c.density.push_back(1);
  c.kept.push_back(1);
  EXPECT_FALSE(quality_of(c).boundary_manifold);
  const TopologyReport r = clean(c, mend_only());
  EXPECT_TRUE(quality_of(c).boundary_manifold);
  EXPECT_EQ(r.tets_dropped, 1U);
  EXPECT_EQ(count_kept(c), 5U);
}

/// No corner on the skin of a block of so many cells.
bool is_amid(const TetMesh& mesh, const Tet& tet, float cells) {
  return std::all_of(tet.begin(), tet.end(), [&](std::uint32_t v) {
    const Vec3& p = mesh.vertices[v];
    return std::min({p.x, p.y, p.z}) > 0 && std::max({p.x, p.y, p.z}) < cells;
  });
}

TEST(CleanTopology, held_tets_are_dropped_only_where_nothing_else_helps) {
  std::size_t dropped = 0, dropped_held = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Candidates c = block_candidates({6, 6, 6});
    keep_at_random(c, seed, 0.9);
    for (std::size_t t = 0; t < c.kept.size(); ++t)  // as lattices have it, there are candidates on all sides
      if (!is_amid(c.mesh, c.mesh.tets[t], 6)) c.kept[t] = 0;
    Candidates held = c;
    for (std::uint8_t& k : held.kept) k = k != 0 ? kHeld : 0;
    dropped += clean(c, mend_only()).tets_dropped;
    dropped_held += clean(held, mend_only()).tets_dropped;
    EXPECT_TRUE(quality_of(held).boundary_manifold);
  }
  EXPECT_GT(dropped, 100U);
  EXPECT_LT(20 * dropped_held, dropped);
}

TEST(CleanTopology, a_hollow_ball_is_filled_and_counted) {
  Candidates c = block_candidates({10, 10, 10});
  const Vec3d centre{5, 5, 5};
  keep_inside(c, [&](const Vec3d& p) { return length(p - centre) < 4.5 && length(p - centre) > 1.5; });
  const std::size_t before = count_kept(c);
  Candidates kept = c;
  TopologyOptions options;
  options.bubbles = Bubbles::Keep;
  clean(kept, options);
  EXPECT_EQ(count_kept(kept), before);
  EXPECT_EQ(euler(quality_of(kept)), 4) << "two spheres";
  const TopologyReport r = clean(c);
  EXPECT_EQ(r.bubbles_filled, 1U);
  EXPECT_EQ(count_kept(c), before + r.bubble_tets);
  EXPECT_EQ(euler(quality_of(c)), 2);
}

TEST(CleanTopology, a_cavity_of_which_not_all_is_listed_stays) {
  Candidates all = block_candidates({12, 12, 12}), c;
  const Vec3d centre{6, 6, 6};
  keep_inside(all, [&](const Vec3d& p) { return length(p - centre) < 5.5 && length(p - centre) > 3.5; });
  c.mesh.vertices = all.mesh.vertices;
  for (std::size_t t = 0; t < all.mesh.tets.size(); ++t) {  // a ring around the shell, as lattices list it
    const Vec3d p = to_double(all.mesh.vertices[all.mesh.tets[t][0]]);
    if (length(p - centre) < 1.8) continue;
    c.mesh.tets.push_back(all.mesh.tets[t]);
    c.density.push_back(all.density[t]);
    c.kept.push_back(all.kept[t]);
  }
  const std::size_t before = count_kept(c);
  const TopologyReport r = clean(c);
  EXPECT_EQ(r.bubbles_filled, 0U);
  EXPECT_EQ(count_kept(c), before);
}

TEST(CleanTopology, crumbs_go_and_what_is_large_enough_stays) {
  Candidates c = block_candidates({9, 4, 3}), bar = c;
  keep_inside(c, [](const Vec3d& p) { return p.x < 3 || (p.x > 5 && p.x < 6 && p.y < 1 && p.z < 1); });
  keep_inside(bar, [](const Vec3d& p) { return p.x < 3 || (p.x > 5 && p.x < 8 && p.y < 1 && p.z < 1); });
  const double whole = quality_of(c).volume;  // 36 cells and one
  Candidates kept = c, held = c;
  TopologyOptions options = nothing();
  options.min_part = 0.9 / 37;
  EXPECT_TRUE(did_nothing(clean(kept, options)));
  options.min_part = 1.1 / 37;
  for (std::uint8_t& k : held.kept) k = k != 0 ? kHeld : 0;
  EXPECT_EQ(clean(held, options).parts_dropped, 1U) << "a speck goes even where it is held";
  for (std::uint8_t& k : bar.kept) k = k != 0 ? kHeld : 0;
  options.min_part = 0.5;
  EXPECT_TRUE(did_nothing(clean(bar, options))) << "what is held and has some length stays";
  options.min_part = 1.1 / 37;
  const TopologyReport r = clean(c, options);
  EXPECT_EQ(r.parts_dropped, 1U);
  EXPECT_NEAR(r.dropped_volume, 1, 1e-6);
  EXPECT_NEAR(quality_of(c).volume, whole - 1, 1e-6);
  options.min_part = 0.999;
  EXPECT_TRUE(did_nothing(clean(c, options))) << "the largest stays";
}

TEST(CleanTopology, refuses_a_share_of_one_and_can_be_cancelled) {
  Candidates c = block_candidates({2, 2, 2});
  keep_at_random(c, 1, 0.5);
  TopologyOptions options;
  options.min_part = 1;
  EXPECT_THROW(clean(c, options), InvalidInput);
  const Progress stop = [calls = 0](std::string_view, double) mutable { return ++calls < 2; };
  StageWatch watch(stop, "test");
  EXPECT_THROW(clean_topology(c, {}, watch), Cancelled);
}

TEST(CleanTopology, nothing_kept_is_nothing_to_clean) {
  Candidates none, absent = block_candidates({2, 2, 2});
  EXPECT_TRUE(did_nothing(clean(none)));
  EXPECT_TRUE(did_nothing(clean(absent)));
}

}  // namespace
}  // namespace tetsoup
