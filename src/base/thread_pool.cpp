// Threads of our own, for where oneTBB is not: the browser. They take chunks of one loop at a time.
#ifdef TETSOUP_WITH_POOL

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "base/require.h"

namespace tetsoup {

namespace {

/// Turns of looking for work before a thread sleeps, some tens of microseconds: the loops of a simulation follow each
/// other faster than a thread wakes.
constexpr int kTurns = 20000;

/// Loops of fewer chunks are over before a thread that sleeps has woken.
constexpr std::int64_t kFewChunks = 4;

thread_local bool t_in_loop = false;

int core_count() {
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

struct Loop {
  std::int64_t chunks = 0;
  void (*run)(const void*, std::int64_t) = nullptr;
  const void* context = nullptr;
};

/// A loop is open from the moment its chunks may be taken until its caller has found none left. Who helps counts
/// itself in before it looks whether the loop is open, and the caller closes it before it looks who is in: so nobody
/// works on a loop that is over. All atomics are sequentially consistent for that.
class Pool {
 public:
  static Pool& instance() {
    static Pool pool;
    return pool;
  }

  ~Pool() {
    ends_ = true;
    wake();
    for (std::thread& thread : threads_) thread.join();
  }

  void limit(int threads) { limit_ = threads; }
  int size() const { return limit_ > 0 ? std::min(limit_.load(), core_count()) : core_count(); }

  void run(const Loop& loop) {
    std::unique_lock mine(callers_, std::defer_lock);
    if (loop.chunks < kFewChunks || size() < 2 || t_in_loop || !mine.try_lock()) {
      for (std::int64_t chunk = 0; chunk < loop.chunks; ++chunk) loop.run(loop.context, chunk);
      return;
    }
    while (static_cast<int>(threads_.size()) < size() - 1)
      threads_.emplace_back([this, number = static_cast<int>(threads_.size())] { work(number); });
    loop_ = loop;
    next_ = 0;
    open_ = ++loops_;
    if (sleepers_ > 0) wake();
    take_chunks();
    open_ = 0;
    for (int turn = 0; inside_ > 0; ++turn)
      if (turn > kTurns) std::this_thread::yield();
    if (thrown_) std::rethrow_exception(std::exchange(thrown_, nullptr));
  }

 private:
  void wake() {
    { const std::lock_guard lock(mutex_); }  // who is about to sleep sleeps, or has seen the change
    begun_.notify_all();
  }

  void take_chunks() {
    t_in_loop = true;
    try {
      for (std::int64_t chunk = next_++; chunk < loop_.chunks; chunk = next_++) loop_.run(loop_.context, chunk);
    } catch (...) {
      next_ = loop_.chunks;
      const std::lock_guard lock(mutex_);
      if (!thrown_) thrown_ = std::current_exception();
    }
    t_in_loop = false;
  }

  void work(int number) {
    std::uint64_t seen = 0;
    const auto is_news = [&] {
      const std::uint64_t open = open_;
      return ends_ || (open != 0 && open != seen);
    };
    while (!ends_) {
      for (int turn = 0; turn < kTurns && !is_news(); ++turn) {
      }
      if (!is_news()) {
        std::unique_lock lock(mutex_);
        ++sleepers_;
        begun_.wait(lock, is_news);
        --sleepers_;
      }
      ++inside_;
      const std::uint64_t open = open_;
      if (open != 0 && open != seen && number < size() - 1) take_chunks();
      if (open != 0) seen = open;
      --inside_;
    }
  }

  std::mutex callers_;  ///< Held by the one whose loop it is.
  Loop loop_;           ///< Changes only while it is closed and nobody is in.
  std::atomic<std::uint64_t> loops_{0}, open_{0};
  std::atomic<std::int64_t> next_{0};
  std::atomic<int> inside_{0}, sleepers_{0}, limit_{0};
  std::atomic<bool> ends_{false};
  std::mutex mutex_;  ///< Of sleeping, and of what was thrown.
  std::condition_variable begun_;
  std::vector<std::thread> threads_;
  std::exception_ptr thrown_;
};

}  // namespace

void run_chunks_in_pool(std::int64_t chunks, void (*run)(const void* context, std::int64_t chunk),
                        const void* context) {
  Pool::instance().run({chunks, run, context});
}

void set_thread_count(int threads) {
  require(threads >= 0, "threads", threads, "0 (all cores) or more");
  Pool::instance().limit(threads);
}

int thread_count() {
  return Pool::instance().size();
}

}  // namespace tetsoup

#endif
