// read(field): the time in which this machine streams a float field of 256^3 voxels once through all its cores. No
// stage that looks at every voxel of a dense field can be faster, so stages are given as multiples of it.
#include <array>
#include <atomic>
#include <barrier>
#include <thread>

#include "bench_rows.h"

namespace tetsoup::bench {

namespace {

constexpr std::size_t kFieldSize = std::size_t{256} * 256 * 256;

// Lanes that do not wait for each other, so that memory is what limits.
float sum_of(const float* values, std::size_t count) {
  constexpr std::size_t kLanes = 64;
  std::array<float, kLanes> lanes{};
  for (std::size_t i = 0; i + kLanes <= count; i += kLanes)
    for (std::size_t lane = 0; lane < kLanes; ++lane) lanes[lane] += values[i + lane];
  float sum = 0;
  for (const float lane : lanes) sum += lane;
  return sum;
}

// The threads stand ready before the clock starts and are released and awaited by a barrier.
void read_field(benchmark::State& state, int thread_count) {
  const std::vector<float> field(kFieldSize, 1.0F);
  const std::size_t share = kFieldSize / static_cast<std::size_t>(thread_count);
  std::barrier gate(thread_count);
  std::atomic<bool> done = false;
  const auto read_share = [&](int thread) {
    benchmark::DoNotOptimize(sum_of(field.data() + share * static_cast<std::size_t>(thread), share));
  };
  std::vector<std::thread> threads;
  for (int thread = 1; thread < thread_count; ++thread) {
    threads.emplace_back([&, thread] {
      for (gate.arrive_and_wait(); !done; gate.arrive_and_wait()) {
        read_share(thread);
        gate.arrive_and_wait();
      }
    });
  }
  for (auto _ : state) {
    gate.arrive_and_wait();
    read_share(0);
    gate.arrive_and_wait();
  }
  done = true;
  gate.arrive_and_wait();
  for (std::thread& thread : threads) thread.join();
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(kFieldSize * sizeof(float)));
}

}  // namespace

void add_read_field_rows() {
  add_row("read_field", [](benchmark::State& state) { read_field(state, thread_count()); });
  add_row("read_field/threads:1", [](benchmark::State& state) { read_field(state, 1); });
}

}  // namespace tetsoup::bench
