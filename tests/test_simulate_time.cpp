// Substeps belong to time: bodies move alike however often step() is called.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "lattice_shapes.h"
#include "tetsoup/simulate.h"

namespace tetsoup {
namespace {

constexpr std::array kRates{24, 30, 60, 120, 240, 1000};  ///< Steps a second.

/// Mean height of a body's vertices, m: at every half second, and of all steps of the last second.
struct Heights {
  std::vector<double> at;
  double mean = 0;
};

/// Calls step() so often for some seconds.
Heights heights(Simulation& simulation, std::size_t body, int steps_a_second, int seconds) {
  Heights heights;
  for (int i = 1; i <= seconds * steps_a_second; ++i) {
    simulation.step(1.0 / steps_a_second);
    double sum = 0;
    for (const Vec3& p : simulation.positions(body)) sum += static_cast<double>(p.z);
    sum /= static_cast<double>(simulation.positions(body).size());
    if (2 * i % steps_a_second == 0) heights.at.push_back(sum);
    if (i > (seconds - 1) * steps_a_second) heights.mean += sum / steps_a_second;
  }
  EXPECT_NEAR(simulation.time(), seconds, 1e-9);
  return heights;
}

Heights heights_of_column(int steps_a_second, double young) {
  SimulationOptions options;
  options.contacts = Contacts::Between;
  options.gravity = {0, 0, -young / 4e3};
  Simulation simulation(options);
  simulation.add_plane({0, 0, 1}, 0);
  SimMaterial material;
  material.elastic.young = young;
  return heights(simulation, simulation.add_body(block_mesh({4, 4, 10}, 0.05), material), steps_a_second, 2);
}

TEST(SimulateTime, AColumnSagsAlikeAt24To1000StepsASecond) {
  for (const double young : {3e4, 1e6}) {
    const Heights expected = heights_of_column(60, young);
    const double sag = 0.25 - expected.mean;
    EXPECT_GT(sag, 0.01);
    for (const int rate : kRates) {
      const Heights found = heights_of_column(rate, young);
      EXPECT_NEAR(found.mean, expected.mean, (rate <= 120 ? 0.03 : 0.1) * sag) << young << " Pa, " << rate << "/s";
      // As far as substeps are equally long there.
      for (std::size_t i = 0; i < found.at.size() && rate <= 120; ++i)
        EXPECT_NEAR(found.at[i], expected.at[i], 0.03 * sag) << young << " Pa, " << rate << "/s, " << i;
    }
  }
}

TEST(SimulateTime, AStepTakesTheSubstepsOfItsTime) {
  for (const int rate : kRates) {
    SimulationOptions options;
    options.substeps = 10;
    options.max_substeps = 10;
    Simulation simulation(options);
    simulation.add_body(block_mesh({1, 1, 1}));
    simulation.step(1.0 / rate);
    EXPECT_EQ(simulation.report().substeps, static_cast<int>(std::ceil(600.0 / rate - 1e-9))) << rate;
  }
}

TEST(SimulateTime, AFallIsTheSameAt24To1000StepsASecond) {
  Heights expected;
  for (const int rate : kRates) {
    Simulation simulation;
    const std::size_t body = simulation.add_body(block_mesh({2, 2, 2}, 0.1), {}, {.spin = {1, 2, 0}});
    const Heights found = heights(simulation, body, rate, 1);
    if (expected.at.empty()) expected = found;
    EXPECT_NEAR(found.at.back(), expected.at.back(), 1e-4) << rate;
  }
}

}  // namespace
}  // namespace tetsoup
