// The kernel that finds where volume events lie: every instruction set against the obvious loops.
#include "kernel/event_masks.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <vector>

#include "kernel/reference.h"
#include "kernel/targets.h"

namespace tetsoup {

namespace {

/// Nine rows of values, few of them different, so that many are equal and some infinite.
class RandomNeighbours {
 public:
  explicit RandomNeighbours(unsigned seed) : random_(seed) {
    for (std::size_t r = 0; r < 9; ++r) {
      for (int x = 0; x < 64; ++x) values_[r].push_back(any_value());
      around_.rows[r] = values_[r].data();
      around_.before[r] = any_value();
      around_.after[r] = any_value();
    }
  }
  RandomNeighbours(const RandomNeighbours&) = delete;
  const kernel::BlockNeighbours& around() const { return around_; }

 private:
  float any_value() {
    const auto n = static_cast<unsigned>(random_() % 6);
    return n == 5 ? std::numeric_limits<float>::infinity() : static_cast<float>(n) * 0.37F;
  }

  std::mt19937 random_;
  std::array<std::vector<float>, 9> values_;
  kernel::BlockNeighbours around_{};
};

TEST(EventMasks, every_instruction_set_finds_the_events_of_the_obvious_loops) {
  int targets = 0;
  for_each_simd_target([&](const std::string& target) {
    ++targets;
    for (unsigned seed = 0; seed < 50; ++seed) {
      const RandomNeighbours random(seed);
      const kernel::WordEvents found = kernel::find_events(random.around()),
                               expected = reference::find_events(random.around());
      ASSERT_EQ(found.sheets, expected.sheets) << target << ", seed " << seed;
      ASSERT_EQ(found.along_x, expected.along_x) << target << ", seed " << seed;
    }
  });
  EXPECT_GE(targets, 2) << "only one instruction set is built: nothing was compared";
}

TEST(EventMasks, every_instruction_set_finds_what_lies_below_a_limit) {
  for_each_simd_target([&](const std::string& target) {
    for (unsigned seed = 0; seed < 20; ++seed) {
      const RandomNeighbours random(seed);
      const float* block = random.around().rows[0];
      const std::array<float, 3> limits{0, 0.37F, std::numeric_limits<float>::infinity()};
      std::array<std::uint64_t, 3> below{}, expected{};
      kernel::find_below(block, limits.data(), limits.size(), below.data());
      for (std::size_t i = 0; i < limits.size(); ++i)
        for (int x = 0; x < 64; ++x) expected[i] |= static_cast<std::uint64_t>(block[x] < limits[i]) << x;
      ASSERT_EQ(below, expected) << target << ", seed " << seed;
    }
  });
}

}  // namespace
}  // namespace tetsoup
