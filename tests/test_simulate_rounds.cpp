#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

#include "lattice_shapes.h"
#include "simulate/rounds.h"

namespace tetsoup::simulate {
namespace {

Piece piece_of(const std::array<int, 3>& cells) {
  return split_pieces(block_mesh(cells, 0.1), 1)[0];
}

TEST(SimulateRounds, RunsOfARoundShareNoVertexAndHoldEveryTetOnce) {
  // A cube, a beam, a plate: 21,760, 10,000 and 20,000 tets.
  for (const std::array<int, 3>& cells : {std::array{17, 16, 16}, std::array{500, 2, 2}, std::array{64, 63, 1}}) {
    const Piece piece = piece_of(cells);
    std::vector<int> solved(piece.tets.size(), 0);
    for (const std::vector<TetRun>& round : split_rounds(piece)) {
      std::vector<int> run_of(piece.places.size(), -1);
      for (std::size_t r = 0; r < round.size(); ++r) {
        EXPECT_FALSE(round[r].empty());
        for (const std::uint32_t t : round[r]) {
          ++solved[t];
          for (const std::uint32_t v : piece.tets[t]) {
            EXPECT_TRUE(run_of[v] == -1 || run_of[v] == static_cast<int>(r));
            run_of[v] = static_cast<int>(r);
          }
        }
      }
    }
    EXPECT_EQ(std::set(solved.begin(), solved.end()), std::set{1});
  }
}

TEST(SimulateRounds, MostOfALargePieceIsInItsFirstRound) {
  const Piece piece = piece_of({17, 16, 16});
  const auto rounds = split_rounds(piece);
  std::size_t first = 0;
  for (const TetRun& run : rounds[0]) first += run.size();
  EXPECT_GE(rounds[0].size(), 4U);
  EXPECT_GT(first, piece.tets.size() * 6 / 10);
  EXPECT_LE(rounds.size(), 8U);
}

TEST(SimulateRounds, ASmallPieceIsOneRun) {
  const auto rounds = split_rounds(piece_of({9, 8, 8}));  // 2,880 tets
  ASSERT_EQ(rounds.size(), 1U);
  EXPECT_EQ(rounds[0].size(), 1U);
}

}  // namespace
}  // namespace tetsoup::simulate
