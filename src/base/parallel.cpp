#include "base/parallel.h"

#include <memory>
#include <mutex>

#include "base/require.h"

#ifdef TETSOUP_WITH_TBB
#include <tbb/global_control.h>
#endif

namespace tetsoup {

#ifdef TETSOUP_WITH_TBB

namespace {
std::mutex g_limit_mutex;
std::unique_ptr<tbb::global_control> g_limit;
}  // namespace

void set_thread_count(int threads) {
  require(threads >= 0, "threads", threads, "0 (all cores) or more");
  const std::lock_guard lock(g_limit_mutex);
  g_limit.reset();
  if (threads > 0) {
    g_limit = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                    static_cast<std::size_t>(threads));
  }
}

int thread_count() {
  return static_cast<int>(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
}

#elif !defined(TETSOUP_WITH_POOL)

void set_thread_count(int threads) {
  require(threads >= 0, "threads", threads, "0 (all cores) or more");
}

int thread_count() {
  return 1;
}

#endif

}  // namespace tetsoup
