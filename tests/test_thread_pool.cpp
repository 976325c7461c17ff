// The threads that stand in for oneTBB in browsers, built into this test alone.
#include <gtest/gtest.h>

#include <atomic>
#include <numeric>
#include <stdexcept>
#include <thread>
#include <vector>

#include "base/parallel.h"

namespace tetsoup {
namespace {

const Progress kNobody;

std::vector<int> marks_of(std::int64_t count, std::int64_t grain) {
  std::vector<int> marks(static_cast<std::size_t>(count), 0);
  StageWatch watch(kNobody, "test");
  parallel_for(count, grain, watch, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i) ++marks[static_cast<std::size_t>(i)];
  });
  return marks;
}

TEST(ThreadPool, every_index_is_visited_once_whatever_the_grain) {
  for (const std::int64_t grain : {1, 3, 64, 1000})
    for (const std::int64_t count : {0, 1, 2, 999, 1000, 1001})
      EXPECT_EQ(marks_of(count, grain), std::vector<int>(static_cast<std::size_t>(count), 1)) << count << " " << grain;
}

TEST(ThreadPool, many_short_loops_one_after_the_other_lose_nothing) {
  for (int loop = 0; loop < 20000; ++loop) ASSERT_EQ(marks_of(4, 1), (std::vector<int>{1, 1, 1, 1}));
}

TEST(ThreadPool, threads_that_sleep_wake_again) {
  for (int loop = 0; loop < 20; ++loop) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    EXPECT_EQ(marks_of(100, 1), std::vector<int>(100, 1));
  }
}

TEST(ThreadPool, a_loop_within_a_loop_and_a_second_caller_do_their_own_work) {
  std::vector<std::vector<int>> inner(8);
  std::vector<int> other;
  std::thread second([&] {
    for (int loop = 0; loop < 200; ++loop) other = marks_of(50, 1);
  });
  StageWatch watch(kNobody, "test");
  parallel_for(8, 1, watch,
               [&](std::int64_t begin, std::int64_t) { inner[static_cast<std::size_t>(begin)] = marks_of(50, 1); });
  second.join();
  for (const std::vector<int>& marks : inner) EXPECT_EQ(marks, std::vector<int>(50, 1));
  EXPECT_EQ(other, std::vector<int>(50, 1));
}

TEST(ThreadPool, what_a_chunk_throws_comes_out_and_the_next_loop_works) {
  StageWatch watch(kNobody, "test");
  EXPECT_THROW(parallel_for(100, 1, watch,
                            [](std::int64_t begin, std::int64_t) {
                              if (begin == 57) throw std::runtime_error("57");
                            }),
               std::runtime_error);
  EXPECT_EQ(marks_of(100, 1), std::vector<int>(100, 1));
}

TEST(ThreadPool, the_limit_holds) {
  set_thread_count(1);
  EXPECT_EQ(thread_count(), 1);
  const std::thread::id self = std::this_thread::get_id();
  std::atomic<int> strangers{0};
  StageWatch watch(kNobody, "test");
  parallel_for(1000, 1, watch, [&](std::int64_t, std::int64_t) {
    if (std::this_thread::get_id() != self) ++strangers;
  });
  EXPECT_EQ(strangers, 0);
  set_thread_count(0);
  EXPECT_GE(thread_count(), 1);
  EXPECT_THROW(set_thread_count(-1), InvalidInput);
}

}  // namespace
}  // namespace tetsoup
