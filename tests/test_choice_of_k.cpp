// A slice of the battery that the choice of k is measured with; scripts/choice_of_k runs all of it.
#include <gtest/gtest.h>

#include <array>

#include "choice_of_k.h"

namespace tetsoup::test {
namespace {

constexpr int kVoxels = 96;
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr std::array kSamples{"torus"};  // instrumented code is an order of magnitude slower
#else
constexpr std::array kSamples{"torus", "heart"};
#endif

TEST(ChoiceOfK, loses_next_to_nothing_against_the_best_fixed_band) {
  constexpr double kMostLoss = 0.01;
  for (const char* name : kSamples) {
    TrueSolid truth(make_sample(name));
    for (const Damage& damage : make_damages(truth.intact(), 1)) {
      SCOPED_TRACE(std::string(name) + ", " + damage.name);
      const BandTrial trial = try_bands(damage.soup, truth, kVoxels);
      EXPECT_LE(trial.loss(), kMostLoss) << "chose " << trial.automatic_band << ", best " << trial.best_band();
      if (damage.name == "intact") {
        EXPECT_GE(trial.automatic, 0.98);
      }
    }
  }
}

TEST(ChoiceOfK, the_winding_number_knows_a_union_from_a_hole) {
  const TriangleSoup parts = joined(make_ball(1, {0, 0, 0}), make_ball(1, {1, 0, 0}));
  const auto in_ball = [](const Vec3d& p) { return squared_length(p) < 1; };
  DistanceOptions options;
  options.voxels = 48;
  const GridFrame frame = make_grid(clean_soup(parts), options);
  const BitGrid solid = winding_solid(parts, frame);
  EXPECT_GE(overlap(solid, [&](const Vec3d& p) { return in_ball(p) || in_ball(p - Vec3d{1, 0, 0}); }), 0.98);
}

}  // namespace
}  // namespace tetsoup::test
