// The plain structs and the formulas about one tet.
#include <gtest/gtest.h>

#include "base/tet_geometry.h"

namespace tetsoup {

TEST(TetGeometry, a_corner_tet_has_a_sixth_of_the_cubes_volume) {
  EXPECT_DOUBLE_EQ(signed_volume({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}), 1.0 / 6);
}

TEST(TetGeometry, a_regular_tet_has_all_dihedral_angles_alike) {
  const TetCorners p{{{0, 0, 0}, {1, 1, 0}, {1, 0, 1}, {0, 1, 1}}};
  for (const double c : dihedral_cosines(p)) EXPECT_NEAR(c, 1.0 / 3, 1e-12);
}

TEST(TetGeometry, faces_of_a_positive_tet_look_outwards) {
  const TetCorners p{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  for (std::size_t i = 0; i < 4; ++i) {
    const auto at = [&](std::size_t corner) { return p[static_cast<std::size_t>(kTetFaces[i][corner])]; };
    EXPECT_LT(dot(cross(at(1) - at(0), at(2) - at(0)), p[i] - at(0)), 0);
  }
}

}  // namespace tetsoup
