// tetsoup: how a caller watches long work, stops it, and says how many threads may do it.
#pragma once

#include <functional>
#include <string_view>

namespace tetsoup {

/// Called from the thread that called the stage, every few milliseconds of work, with the stage's name and the done
/// fraction in [0, 1]. Return false to stop: the stage then throws Cancelled and leaves nothing behind.
using Progress = std::function<bool(std::string_view stage, double fraction)>;

/// Upper bound on the threads that all stages use from now on (process-wide); 0 takes all cores. Results never depend
/// on it.
/// @throws InvalidInput  if negative.
void set_thread_count(int threads);

/// Threads that the stages may use now; 1 in a build without TBB.
int thread_count();

}  // namespace tetsoup
