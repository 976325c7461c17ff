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
  check_random_sets(block_candidates({4, 4, 4}), 1500, options);
}

TEST(CleanTopology, does_so_with_parts_dropped_and_bubbles_kept) {
  TopologyOptions options;
  options.min_part = 0.03;
  check_random_sets(block_candidates({5, 4, 3}), 600, options);
  options.bubbles = Bubbles::Keep;
  check_random_sets(block_candidates({5, 4, 3}), 600, options);
}

TEST(CleanTopology, does_so_where_twenty_four_tets_meet) {
  TopologyOptions options;
  options.min_part = 0;
  check_random_sets(test::six_tet_candidates(4), 800, options);
}

}  // namespace
}  // namespace tetsoup
