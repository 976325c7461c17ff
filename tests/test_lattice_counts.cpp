// Stage 4, what its speed rests on: counting by blocks and by runs is counting voxel by voxel.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/bits.h"
#include "lattice/cell_rows.h"
#include "shapes.h"

namespace tetsoup {
namespace {

/// A grid of which a ball is inside, with a rim of loose voxels.
BitGrid ragged_ball(std::array<int, 3> size, std::uint64_t seed) {
  test::Random random(seed);
  BitGrid grid = make_bit_grid({size, 2, {-0.3, 0.2, 0.1}, 0.125});
  for (int z = 0; z < size[2]; ++z) {
    for (int y = 0; y < size[1]; ++y) {
      for (int x = 0; x < size[0]; ++x) {
        const double r = std::hypot(x - 0.5 * size[0], y - 0.5 * size[1], z - 0.5 * size[2]) / size[2];
        if (r < 0.3 || (r < 0.4 && random.uniform() < 0.5))
          grid.words[grid.row(y, z) + static_cast<std::size_t>(x / 64)] |= std::uint64_t{1} << (x % 64);
      }
    }
  }
  return grid;
}

TEST(InsideBlocks, say_of_any_box_what_its_voxels_say) {
  const BitGrid grid = ragged_ball({90, 37, 41}, 1);
  const Progress nobody;
  StageWatch watch(nobody, "test");
  const InsideBlocks blocks(grid, watch);
  test::Random random(2);
  std::array<int, 3> seen{};
  for (int i = 0; i < 3000; ++i) {
    VoxelRange box;
    for (std::size_t a = 0; a < 3; ++a) {
      box.begin[a] = static_cast<int>(random.uniform() * (grid.frame.size[a] + 8)) - 4;
      box.end[a] = box.begin[a] + 1 + static_cast<int>(random.uniform() * random.uniform() * 30);
    }
    bool inside = false, outside = false;
    for (int z = box.begin[2]; z < box.end[2]; ++z)
      for (int y = box.begin[1]; y < box.end[1]; ++y)
        for (int x = box.begin[0]; x < box.end[0]; ++x)
          (grid.frame.contains(x, y, z) && grid.test(x, y, z) ? inside : outside) = true;
    const Content expected = inside && outside ? Content::Mixed : inside ? Content::Inside : Content::Outside;
    ASSERT_EQ(blocks.content(box), expected);
    ++seen[static_cast<std::size_t>(expected)];
  }
  for (const int count : seen) EXPECT_GT(count, 15);
}

/// Lattices that lie on the voxels exactly, nearly and not at all.
std::vector<LatticePose> poses_to_count() {
  constexpr double kEighth = std::numbers::pi / 4;
  const std::array<Vec3d, 7> turns{{{0, 0, 0},
                                    {0.3, -0.2, 0.5},
                                    {kEighth, 0, 0},
                                    {0, kEighth, 0},
                                    {0, 0, kEighth},
                                    {1e-9, 1e-7, 0},
                                    {2 * kEighth, 0, 4 * kEighth}}};
  const std::array<Vec3d, 4> shifts{{{0, 0, 0}, {0.25, 0.0625, 0.5}, {0.31, 0.12, 0.77}, {0.25 + 1e-9, 0.125, 1000.5}}};
  std::vector<LatticePose> all;
  for (const Vec3d& turn : turns)
    for (const Vec3d& shift : shifts)
      for (const double size : {0.05, 0.5, 1.0, 0.7771, 9.0}) all.push_back({size, shift, turn});
  return all;
}

TEST(CellRows, count_by_runs_what_voxels_asked_one_by_one_say) {
  const BitGrid grid = ragged_ball({70, 21, 24}, 3);
  const Progress nobody;
  StageWatch watch(nobody, "test");
  const InsideBlocks blocks(grid, watch);
  test::Random random(4);
  for (const LatticePose& pose : poses_to_count()) {
    const LatticeFrame frame = make_lattice_frame(grid.frame, pose);
    const CellRows rows(blocks, frame);
    const Vec3d first = frame.to_cell(grid.frame.origin);
    const auto step = [&](Vec3d along) { return frame.to_cell(grid.frame.origin + along * 0.125) - first; };
    const Vec3d sx = step({1, 0, 0}), sy = step({0, 1, 0}), sz = step({0, 0, 1});
    for (int i = 0; i < 3; ++i) {
      Cell cell;
      for (std::size_t a = 0; a < 3; ++a)
        cell[a] = frame.begin[a] + static_cast<int>(random.uniform() * (frame.end[a] - frame.begin[a]));
      const VoxelRange range{{-3, -3, -3}, {74, 25, 28}};
      TetCounts expected;
      for (int z = range.begin[2]; z < range.end[2]; ++z) {
        for (int y = range.begin[1]; y < range.end[1]; ++y) {
          const Vec3d row = first + sy * y + sz * z;
          for (int x = range.begin[0]; x < range.end[0]; ++x) {
            const Vec3d p = row + sx * x;
            if (std::floor(p.x) != cell[0] || std::floor(p.y) != cell[1] || std::floor(p.z) != cell[2]) continue;
            const std::size_t tet = owner_tet({p.x - cell[0], p.y - cell[1], p.z - cell[2]}, is_odd(cell));
            ++expected.total[tet];
            expected.inside[tet] += grid.frame.contains(x, y, z) && grid.test(x, y, z);
          }
        }
      }
      const TetCounts counts = rows.count(cell, range);
      ASSERT_EQ(counts.total, expected.total) << "edge " << pose.cell_size;
      ASSERT_EQ(counts.inside, expected.inside) << "edge " << pose.cell_size;
    }
  }
}

}  // namespace
}  // namespace tetsoup
