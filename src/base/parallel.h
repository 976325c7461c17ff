// The one place where threads are made, and where long loops report progress and notice cancellation.
//
// A loop is cut into chunks of a fixed grain, so what a chunk computes does not depend on the thread count. Bodies
// write only what their own indices own (gather, never scatter).
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <string_view>
#include <thread>
#include <vector>

#include "tetsoup/error.h"
#include "tetsoup/progress.h"

#ifdef TETSOUP_WITH_TBB
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>
#include <tbb/partitioner.h>
#endif

namespace tetsoup {

/// Calls run(context, chunk) for every chunk, on the threads of base/thread_pool.cpp and on this one; on this one alone
/// where the chunks are those of a loop within a loop, or of a second caller. What is thrown first is thrown here.
void run_chunks_in_pool(std::int64_t chunks, void (*run)(const void* context, std::int64_t chunk), const void* context);

/// Progress of one stage. Made on the thread that called the stage; only that thread calls back.
class StageWatch {
 public:
  StageWatch(const Progress& progress, std::string_view stage)
      : progress_(progress), stage_(stage), owner_(std::this_thread::get_id()) {
    report(0);
  }

  /// The loops that follow cover this part of the stage, as fractions of it.
  void enter_part(double begin, double end) {
    begin_ = begin;
    end_ = end;
    report(begin);
  }

  /// For serial loops: done fraction of the current part. Throws Cancelled.
  void step(double done) { report(begin_ + (end_ - begin_) * done); }

  bool stopped() const { return stopped_.load(std::memory_order_relaxed); }

  /// From any thread inside a parallel loop: notes the answer of the callback instead of throwing.
  void tick(double done) {
    if (progress_ && std::this_thread::get_id() == owner_ && !stopped()) tell(begin_ + (end_ - begin_) * done);
  }
  /// The same without news, for long bodies.
  void poll() {
    if (progress_ && std::this_thread::get_id() == owner_ && !stopped()) tell(told_);
  }
  void throw_if_stopped() const {
    if (stopped()) throw Cancelled();
  }

 private:
  void report(double fraction) {
    if (progress_) tell(fraction);
    throw_if_stopped();
  }
  /// Chunks end in any order and parts restart, but what the caller sees never goes back.
  void tell(double fraction) {
    told_ = std::clamp(fraction, told_, 1.0);
    if (!progress_(stage_, told_)) stopped_.store(true, std::memory_order_relaxed);
  }

  const Progress& progress_;
  std::string_view stage_;
  std::thread::id owner_;
  double begin_ = 0, end_ = 1, told_ = 0;
  std::atomic<bool> stopped_{false};
};

inline std::int64_t chunk_count(std::int64_t count, std::int64_t grain) {
  return (count + grain - 1) / grain;
}

/// Calls body(begin, end) for the chunks of [0, count), in any order and on any thread. A chunk should take well under
/// 20 ms, since cancellation is noticed between chunks. Throws Cancelled if the watch was told to stop.
template <class Body>
void parallel_for(std::int64_t count, std::int64_t grain, StageWatch& watch, const Body& body) {
  const std::int64_t chunks = chunk_count(count, grain);
  std::atomic<std::int64_t> done{0};
  const auto run_chunk = [&](std::int64_t chunk) {
    if (watch.stopped()) return;
    body(chunk * grain, std::min(count, (chunk + 1) * grain));
    watch.tick(static_cast<double>(done.fetch_add(1, std::memory_order_relaxed) + 1) / static_cast<double>(chunks));
  };
#ifdef TETSOUP_WITH_TBB
  tbb::parallel_for(
      tbb::blocked_range<std::int64_t>(0, chunks, 1),
      [&](const tbb::blocked_range<std::int64_t>& range) {
        for (std::int64_t chunk = range.begin(); chunk != range.end(); ++chunk) run_chunk(chunk);
      },
      tbb::simple_partitioner());
#elif defined(TETSOUP_WITH_POOL)
  run_chunks_in_pool(
      chunks, [](const void* run, std::int64_t chunk) { (*static_cast<const decltype(run_chunk)*>(run))(chunk); },
      &run_chunk);
#else
  for (std::int64_t chunk = 0; chunk < chunks; ++chunk) run_chunk(chunk);
#endif
  watch.throw_if_stopped();
}

/// Sum of body(begin, end) over the chunks, added in their order. As parallel_for() otherwise.
template <class Sum, class Body>
Sum parallel_sum(std::int64_t count, std::int64_t grain, StageWatch& watch, const Body& body) {
  std::vector<Sum> parts(static_cast<std::size_t>(chunk_count(count, grain)));
  parallel_for(count, grain, watch, [&](std::int64_t begin, std::int64_t end) {
    parts[static_cast<std::size_t>(begin / grain)] = body(begin, end);
  });
  Sum sum{};
  for (const Sum& part : parts) sum += part;
  return sum;
}

/// Sorts by a strict total order (no two elements equal, or equal ones indistinguishable), so any algorithm gives the
/// same.
template <class Iterator, class Less>
void parallel_sort(Iterator begin, Iterator end, const Less& less) {
#ifdef TETSOUP_WITH_TBB
  tbb::parallel_sort(begin, end, less);
#else
  std::sort(begin, end, less);
#endif
}

}  // namespace tetsoup
