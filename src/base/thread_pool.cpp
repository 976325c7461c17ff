// Threads of our own, for where oneTBB is not: the browser. They take chunks of one loop at a time.
#ifdef TETSOUP_WITH_POOL

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "base/parallel.h"
#include "base/require.h"

namespace tetsoup {

namespace {

/// Turns of looking for work before a thread sleeps, some tens of microseconds: the loops of a simulation follow each
/// other faster than a thread wakes.
constexpr int kTurns = 20000;

thread_local bool t_in_loop = false;

int core_count() {
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

class Pool {
 public:
  static Pool& instance() {
    static Pool pool;
    return pool;
  }

  ~Pool() {
    {
      const std::lock_guard lock(mutex_);
      ends_ = true;
      ++loops_;
    }
    begun_.notify_all();
    for (std::thread& thread : threads_) thread.join();
  }

  void limit(int threads) { limit_ = threads; }
  int size() const { return limit_ > 0 ? std::min(limit_.load(), core_count()) : core_count(); }

  void run(std::int64_t chunks, void (*run)(const void*, std::int64_t), const void* context) {
    std::unique_lock mine(callers_, std::defer_lock);
    if (chunks < 2 || size() < 2 || t_in_loop || !mine.try_lock()) {
      for (std::int64_t chunk = 0; chunk < chunks; ++chunk) run(context, chunk);
      return;
    }
    open(chunks, run, context);
    take_chunks();
    close();
    if (thrown_) std::rethrow_exception(std::exchange(thrown_, nullptr));
  }

 private:
  void open(std::int64_t chunks, void (*run)(const void*, std::int64_t), const void* context) {
    {
      const std::lock_guard lock(mutex_);
      while (static_cast<int>(threads_.size()) < size() - 1)
        threads_.emplace_back([this, number = static_cast<int>(threads_.size())] { work(number); });
      run_ = run;
      context_ = context;
      chunks_ = chunks;
      next_ = 0;
      is_open_ = true;
      ++loops_;
    }
    begun_.notify_all();
  }

  /// Nobody comes in any more, and those who are in leave.
  void close() {
    std::unique_lock lock(mutex_);
    is_open_ = false;
    lock.unlock();
    for (int turn = 0; turn < kTurns && inside_ > 0; ++turn) {
    }
    lock.lock();
    left_.wait(lock, [this] { return inside_ == 0; });
  }

  void take_chunks() {
    t_in_loop = true;
    try {
      for (std::int64_t chunk = next_++; chunk < chunks_; chunk = next_++) run_(context_, chunk);
    } catch (...) {
      next_ = chunks_;
      const std::lock_guard lock(mutex_);
      if (!thrown_) thrown_ = std::current_exception();
    }
    t_in_loop = false;
  }

  void work(int number) {
    std::uint64_t seen = 0;
    while (true) {
      for (int turn = 0; turn < kTurns && loops_ == seen; ++turn) {
      }
      std::unique_lock lock(mutex_);
      begun_.wait(lock, [&] { return loops_ != seen; });
      seen = loops_;
      if (ends_) return;
      if (!is_open_ || number >= size() - 1) continue;
      ++inside_;
      lock.unlock();
      take_chunks();
      lock.lock();
      if (--inside_ == 0) left_.notify_one();
    }
  }

  std::mutex callers_;  ///< Held by the one whose loop it is.
  std::mutex mutex_;    ///< Of all below but what is atomic.
  std::condition_variable begun_, left_;
  std::vector<std::thread> threads_;
  std::atomic<std::uint64_t> loops_{0};
  std::atomic<int> inside_{0}, limit_{0};
  std::atomic<std::int64_t> next_{0};
  bool is_open_ = false, ends_ = false;
  std::int64_t chunks_ = 0;
  void (*run_)(const void*, std::int64_t) = nullptr;
  const void* context_ = nullptr;
  std::exception_ptr thrown_;
};

}  // namespace

void run_chunks_in_pool(std::int64_t chunks, void (*run)(const void* context, std::int64_t chunk),
                        const void* context) {
  Pool::instance().run(chunks, run, context);
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
