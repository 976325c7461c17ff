// The inner loops, a thousand calls, on every instruction set this machine has: kernel_<what>_on_<target>.
#include <array>
#include <hwy/highway.h>
#include <random>
#include <vector>

#include "bench_rows.h"
#include "kernel/nearest_points.h"
#include "kernel/clip_rows.h"
#include "kernel/cone_reach.h"
#include "kernel/event_masks.h"
#include "kernel/relax_tets.h"

namespace tetsoup::bench {

namespace {

template <class Body>
void add_kernel_rows(const std::string& what, Body body) {
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    add_row("kernel_" + what + "_on_" + hwy::TargetName(target), [target, body](benchmark::State& state) mutable {
      hwy::SetSupportedTargetsForTest(target);
      for (auto _ : state) body();
      hwy::SetSupportedTargetsForTest(0);
    });
  }
}

std::vector<float> random_values(std::size_t count) {
  std::minstd_rand random(1);
  std::uniform_real_distribution<float> value(0, 1);
  std::vector<float> values(count);
  for (float& v : values) v = value(random);
  return values;
}

constexpr int kCalls = 1000;  // of a kernel in one iteration of a row

/// Sixteen unit tets beside each other, with corners of their own, at rest and of some stiffness.
struct UnitTets {
  std::vector<kernel::Place> places;
  std::vector<kernel::TetBatch> batches{1};
  std::vector<kernel::TetRotations> rotations{1};

  UnitTets() {
    for (std::uint32_t lane = 0; lane < kernel::kTetLanes; ++lane) {
      for (std::uint32_t c = 0; c < 4; ++c) {
        batches[0].corners[c][lane] = static_cast<std::uint32_t>(places.size());
        places.push_back({c == 1 ? 1.01F : 0, c == 2 ? 0.99F : 0, c == 3 ? 1.0F : 0, 1});
        for (std::uint32_t axis = 0; axis < 3; ++axis)
          batches[0].responses[3 * c + axis][lane] = c == 0 ? -0.1F : c == axis + 1 ? 0.1F : 0;
      }
      for (std::uint32_t axis = 0; axis < 3; ++axis) batches[0].gradients[4 * axis][lane] = 1;
      batches[0].volume_compliance[lane] = batches[0].damping[lane] = 1;
      rotations[0].q[3][lane] = 1;
    }
  }
};

}  // namespace

void add_kernel_rows() {
  add_kernel_rows("find_events", [values = random_values(9 * 64 + kCalls)] {
    for (std::size_t i = 0; i < kCalls; ++i) {
      kernel::BlockNeighbours around{};
      for (std::size_t row = 0; row < 9; ++row) around.rows[row] = values.data() + 64 * row + i;
      benchmark::DoNotOptimize(kernel::find_events(around));
    }
  });
  add_kernel_rows("clip_rows", [values = random_values(18)] {
    std::array<kernel::RowBound, 6> bounds;
    for (std::size_t i = 0; i < 6; ++i)
      bounds[i] = {i < 3 ? values[3 * i] : 8 - values[3 * i], values[3 * i + 1] - 0.5F, values[3 * i + 2] - 0.5F};
    std::array<std::int32_t, 32> begin, end;
    std::array<std::uint8_t, 4> some;
    for (int i = 0; i < kCalls; ++i) {
      kernel::clip_rows({{bounds.data(), 3}, {bounds.data() + 3, 3}, 8}, 5, 4, begin.data(), end.data(), some.data());
      benchmark::DoNotOptimize(some);
    }
  });
  add_kernel_rows("cone_reach", [] {
    const kernel::UpDown directions{{0, 0, 0, 0}, {1, -1, 0, 0}, {0, 0, 1, -1}};
    const std::array<kernel::HalfSpace, 4> half_spaces{
        {{{1, 0, 0}, 0.01F}, {{-1, 0, 0}, 0.01F}, {{0, 0.6F, 0.8F}, 0.01F}, {{0, -0.8F, 0.6F}, 0.01F}}};
    for (int i = 0; i < kCalls; ++i) benchmark::DoNotOptimize(kernel::cone_reach(directions, half_spaces, 3));
  });
  const std::vector<float> places = random_values(3 * 1000);
  kernel::PointColumns points;
  points.resize(1000);
  for (std::size_t i = 0; i < 1000; ++i) {
    points.x[i] = 20 + places[3 * i];
    points.y[i] = 64 * places[3 * i + 1];
    points.z[i] = 64 * places[3 * i + 2];
  }
  add_kernel_rows("keep_candidates", [points] {
    kernel::PointColumns kept;
    kernel::keep_candidates(points, {{3.5F, 32, 32}, {3.5F, 3.5F, 3.5F}}, kept);
    benchmark::DoNotOptimize(kept);
  });
  points.resize(8);
  add_kernel_rows("nearest_squares", [points] {
    std::array<float, kernel::kBrick * kernel::kBrick * kernel::kBrick> squares;
    for (int i = 0; i < kCalls; ++i) {
      kernel::nearest_squares(points, i % 7, 0, 0, squares);
      benchmark::DoNotOptimize(squares);
    }
  });
  add_kernel_rows("relax_tets", [tets = UnitTets()]() mutable {
    const std::vector<kernel::Offset> remainders(tets.places.size());
    std::vector<kernel::Offset> moves(tets.places.size());
    for (std::size_t v = 0; v < moves.size(); ++v) moves[v].inverse_mass = tets.places[v].inverse_mass;
    for (int i = 0; i < kCalls; ++i)
      kernel::relax_tets(tets.batches, tets.rotations, {tets.places.data(), remainders.data(), moves.data(), 0.5F});
    benchmark::DoNotOptimize(moves);
  });
}

}  // namespace tetsoup::bench
