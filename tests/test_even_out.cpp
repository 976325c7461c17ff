// Evening of what density leaves.
#include <gtest/gtest.h>

#include "candidate_shapes.h"
#include "lattice/even_out.h"
#include "tetsoup/quality.h"

namespace tetsoup {

/// A half space whose face is noisy: tets it cuts have a density near a half.
Candidates noisy_block(std::uint64_t seed) {
  Candidates c = test::block_candidates({8, 8, 8});
  test::Random random(seed);
  for (std::size_t t = 0; t < c.mesh.tets.size(); ++t) {
    double z = 0;
    for (const std::uint32_t v : c.mesh.tets[t]) z += 0.25 * static_cast<double>(c.mesh.vertices[v].z);
    const bool is_cut = z > 3 && z < 5;
    c.density[t] = is_cut ? static_cast<float>(random.uniform(0.3, 0.7)) : z < 4 ? 1.0F : 0.0F;
    c.kept[t] = c.density[t] >= 0.5F;
  }
  return c;
}

TEST(EvenOut, saves_boundary_and_leaves_what_density_is_sure_of) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    const Candidates before = noisy_block(seed);
    Candidates after = before;
    const std::size_t flipped = even_out(after, 0.5);
    EXPECT_GT(flipped, 0U);
    std::size_t changed = 0;
    for (std::size_t t = 0; t < before.kept.size(); ++t) {
      changed += before.kept[t] != after.kept[t];
      if (before.density[t] == 0 || before.density[t] == 1) {
        EXPECT_EQ(before.kept[t], after.kept[t]);
      }
    }
    EXPECT_GT(changed, 0U);
    const Quality start = measure_quality(kept_mesh(before)), end = measure_quality(kept_mesh(after));
    EXPECT_LT(end.boundary_area, start.boundary_area);
    EXPECT_LT(end.boundary_curvature, start.boundary_curvature);
    EXPECT_LE(end.non_manifold_vertices, start.non_manifold_vertices);
  }
}

TEST(EvenOut, leaves_a_block_and_an_empty_list_alone) {
  Candidates block = test::block_candidates({5, 5, 5});
  test::keep_inside(block, [](const Vec3d& p) { return p.z < 3; });
  const Candidates before = block;
  EXPECT_EQ(even_out(block, 0.5), 0U);
  EXPECT_EQ(block.kept, before.kept);
  Candidates nothing;
  EXPECT_EQ(even_out(nothing, 0.5), 0U);
}

}  // namespace tetsoup
