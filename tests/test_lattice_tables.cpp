// Stage 4: each lattice is one table; it must fill space with positive tets whose faces match, and every voxel belongs
// to exactly one of them.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "base/bits.h"
#include "base/tet_geometry.h"
#include "lattice/lattice_table.h"
#include "lattice/tet_rows.h"
#include "shapes.h"

namespace tetsoup {
namespace {

constexpr std::array kKinds{LatticeKind::Five, LatticeKind::Bcc};

/// visit(cell, tet, corners in steps) for the tets of size^3 cells.
template <class Visit>
void for_each_tet(const LatticeTable& table, int size, const Visit& visit) {
  for (int z = 0; z < size; ++z) {
    for (int y = 0; y < size; ++y) {
      for (int x = 0; x < size; ++x) {
        const Cell cell{x, y, z};
        for (std::size_t t = 0; t < table.tet_count; ++t) {
          std::array<Steps, 4> corners{};
          for (std::size_t i = 0; i < 4; ++i) {
            corners[i] = table.steps(table.tet(t, is_odd(cell))[i]);
            for (std::size_t a = 0; a < 3; ++a) corners[i][a] += kStepsPerCell * cell[a];
          }
          visit(cell, t, corners);
        }
      }
    }
  }
}

TetCorners in_cells(const std::array<Steps, 4>& steps) {
  TetCorners p;
  for (std::size_t i = 0; i < 4; ++i) p[i] = Vec3d{steps[i][0] * 0.5, steps[i][1] * 0.5, steps[i][2] * 0.5};
  return p;
}

TEST(LatticeTables, tets_are_positive_and_fill_their_cells) {
  for (const LatticeKind kind : kKinds) {
    const LatticeTable& table = lattice_table(kind);
    for (const bool odd : {false, true}) {
      double sum = 0;
      for (std::size_t t = 0; t < table.tet_count; ++t) {
        EXPECT_GT(signed_volume(table.corners(t, odd)), 0);
        EXPECT_NEAR(signed_volume(table.corners(t, odd)), table.volume[t], 1e-15);
        sum += table.volume[t];
      }
      EXPECT_NEAR(sum, 1, 1e-14);
    }
  }
}

TEST(LatticeTables, every_face_belongs_to_two_tets_on_either_side_of_it) {
  constexpr int kSize = 4;  // cells; the lattice goes on at the other end
  for (const LatticeKind kind : kKinds) {
    const LatticeTable& table = lattice_table(kind);
    std::map<std::array<Steps, 3>, std::array<int, 2>> faces;  // how often, turned one way and the other
    for_each_tet(table, kSize, [&](const Cell&, std::size_t, std::array<Steps, 4> corners) {
      for (Steps& s : corners)
        for (int& c : s) c %= kSize * kStepsPerCell;
      for (const auto& f : kTetFaces) {
        std::array<Steps, 3> face{};
        for (std::size_t i = 0; i < 3; ++i) face[i] = corners[static_cast<std::size_t>(f[i])];
        std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
        const bool turned = face[2] < face[1];
        if (turned) std::swap(face[1], face[2]);
        ++faces[face][turned];
      }
    });
    for (const auto& [face, count] : faces) ASSERT_EQ(count, (std::array<int, 2>{1, 1}));
    EXPECT_EQ(faces.size(), kSize * kSize * kSize * table.tet_count * 2);
  }
}

TEST(LatticeTables, mean_edge_and_reach_are_those_of_the_tets) {
  for (const LatticeKind kind : kKinds) {
    const LatticeTable& table = lattice_table(kind);
    constexpr int kSize = 4;
    std::set<std::array<Steps, 2>> edges;
    double sum = 0;
    int reach = 0;
    for_each_tet(table, kSize, [&](const Cell& cell, std::size_t, const std::array<Steps, 4>& corners) {
      for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t a = 0; a < 3; ++a) reach = std::max(reach, corners[i][a] - kStepsPerCell * cell[a]);
      const TetCorners p = in_cells(corners);
      for (const auto& e : kTetEdges) {
        const auto from = static_cast<std::size_t>(e[0]), to = static_cast<std::size_t>(e[1]);
        std::array<Steps, 2> edge{corners[from], corners[to]};
        for (Steps& s : edge)
          for (int& c : s) c %= kSize * kStepsPerCell;
        std::sort(edge.begin(), edge.end());
        if (edges.insert(edge).second) sum += length(p[to] - p[from]);
      }
    });
    EXPECT_NEAR(sum / static_cast<double>(edges.size()), table.mean_edge, 1e-12);
    EXPECT_EQ(reach, table.reach);
  }
}

TEST(LatticeTables, the_tets_of_bcc_are_all_alike_and_those_of_five_are_of_two_kinds) {
  const auto shapes = [](LatticeKind kind) {
    std::set<std::vector<int>> found;  // squared lengths of the edges, in steps
    for_each_tet(lattice_table(kind), 2, [&](const Cell&, std::size_t, const std::array<Steps, 4>& c) {
      std::vector<int> lengths;
      for (const auto& e : kTetEdges) {
        int sum = 0;
        for (std::size_t a = 0; a < 3; ++a) {
          const int d = c[static_cast<std::size_t>(e[1])][a] - c[static_cast<std::size_t>(e[0])][a];
          sum += d * d;
        }
        lengths.push_back(sum);
      }
      std::sort(lengths.begin(), lengths.end());
      found.insert(lengths);
    });
    return found;
  };
  EXPECT_EQ(shapes(LatticeKind::Bcc), (std::set<std::vector<int>>{{3, 3, 3, 3, 4, 4}}));
  EXPECT_EQ(shapes(LatticeKind::Five), (std::set<std::vector<int>>{{8, 8, 8, 8, 8, 8}, {4, 4, 4, 8, 8, 8}}));
}

TEST(LatticeTables, tets_beside_each_other_in_a_cell_share_a_face) {
  EXPECT_EQ(lattice_table(LatticeKind::Five).beside[0], 0b11110);
  for (std::size_t t = 1; t < 5; ++t) EXPECT_EQ(lattice_table(LatticeKind::Five).beside[t], 1);
  // In bcc its two neighbours about the same face, and one about another where the edge is of both upper faces.
  EXPECT_EQ(lattice_table(LatticeKind::Bcc).beside[0], 0b1010);
  EXPECT_EQ(lattice_table(LatticeKind::Bcc).beside[5], 0b10001010000);
}

/// Lattices that lie on the voxels exactly, nearly and not at all.
const std::array<LatticePose, 6> kPoses{{{0.5, {0, 0, 0}, {0, 0, 0}},
                                         {0.5, {0.25, 0.0625, 0.5}, {0, 0, 0}},
                                         {0.7771, {0.31, 0.12, 0.77}, {0.3, -0.2, 0.5}},
                                         {1, {0, 0, 0}, {0, 0, std::numbers::pi / 4}},
                                         {0.25, {1e-9, 0, 1000.5}, {1e-9, 1e-7, 0}},
                                         {0.09, {0.1, 0.2, 0.3}, {1, 2, 3}}}};

TEST(TetRows, every_voxel_belongs_to_exactly_one_tet_and_that_holds_it) {
  BitGrid grid = make_bit_grid({{9, 8, 7}, 2, {-0.3, 0.2, 0.1}, 0.125});
  const Progress nobody;
  StageWatch watch(nobody, "test");
  for (const LatticeKind kind : kKinds) {
    const LatticeTable& table = lattice_table(kind);
    for (const LatticePose& pose : kPoses) {
      const LatticeFrame frame = make_lattice_frame(grid.frame, pose, 0.5);
      const InsideBlocks blocks(grid, watch);
      const TetRows rows(blocks, frame, table);
      std::map<std::array<int, 3>, int> owners;
      for (int z = frame.begin[2] - 1; z <= frame.end[2]; ++z) {
        for (int y = frame.begin[1] - 1; y <= frame.end[1]; ++y) {
          for (int x = frame.begin[0] - 1; x <= frame.end[0]; ++x) {
            for (std::size_t t = 0; t < table.tet_count; ++t) {
              if (rows.count({x, y, z}, t, {{0, 0, 0}, {9, 8, 7}}).total == 0) continue;
              TetCorners corners = table.corners(t, is_odd({x, y, z}));
              for (Vec3d& p : corners) p = frame.to_point(p + Vec3d{1.0 * x, 1.0 * y, 1.0 * z});
              for (int i = 0; i < 9 * 8 * 7; ++i) {
                const std::array<int, 3> v{i % 9, i / 9 % 8, i / 72};
                if (rows.count({x, y, z}, t, {v, {v[0] + 1, v[1] + 1, v[2] + 1}}).total == 0) continue;
                ++owners[v];
                for (std::size_t k = 0; k < 4; ++k) {
                  TetCorners moved = corners;
                  moved[k] = test::voxel_centre(grid.frame, v[0], v[1], v[2]);
                  ASSERT_GE(signed_volume(moved), -1e-9);
                }
              }
            }
          }
        }
      }
      EXPECT_EQ(owners.size(), 9U * 8 * 7);
      for (const auto& [voxel, count] : owners) ASSERT_EQ(count, 1);
    }
  }
}

TEST(TetRows, count_of_a_box_is_the_sum_of_its_rows_voxel_by_voxel) {
  test::Random random(7);
  BitGrid grid = make_bit_grid({{150, 11, 12}, 2, {0, 0, 0}, 0.01});
  for (int z = 0; z < 12; ++z)
    for (int y = 0; y < 11; ++y)
      for (int x = 0; x < 150; ++x)
        if (random.uniform() < 0.5)
          grid.words[grid.row(y, z) + static_cast<std::size_t>(x / 64)] |= std::uint64_t{1} << (x % 64);
  const Progress nobody;
  StageWatch watch(nobody, "test");
  const InsideBlocks blocks(grid, watch);
  const LatticeTable& table = lattice_table(LatticeKind::Bcc);
  for (const double size : {0.05, 0.11, 1.7}) {
    const LatticeFrame frame = make_lattice_frame(grid.frame, {size, {0.3, 0.2, 0.1}, {0.1, 0.2, 0.3}}, 0.5);
    const TetRows rows(blocks, frame, table);
    for (int i = 0; i < 20; ++i) {
      Cell cell;
      for (std::size_t a = 0; a < 3; ++a)
        cell[a] = frame.begin[a] + static_cast<int>(random.uniform() * (frame.end[a] - frame.begin[a]));
      const std::size_t t = random.below(table.tet_count);
      VoxelCount sum;
      for (int z = 0; z < 12; ++z)
        for (int y = 0; y < 11; ++y)
          for (int x = 0; x < 150; ++x) {
            const VoxelCount one = rows.count(cell, t, {{x, y, z}, {x + 1, y + 1, z + 1}});
            ASSERT_EQ(one.inside, grid.test(x, y, z) ? one.total : 0);
            sum.total += one.total;
            sum.inside += one.inside;
          }
      const VoxelCount all = rows.count(cell, t, {{0, 0, 0}, {150, 11, 12}});
      ASSERT_EQ(all.total, sum.total);
      ASSERT_EQ(all.inside, sum.inside);
    }
  }
}

}  // namespace
}  // namespace tetsoup
