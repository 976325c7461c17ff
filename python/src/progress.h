// How the library's work is run from Python: without the interpreter's lock, watched, and stopped by Ctrl-C.
#pragma once

#include <nanobind/nanobind.h>

#include <chrono>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "tetsoup/error.h"
#include "tetsoup/progress.h"

namespace tetsoup::python {

namespace nb = nanobind;

/// What the library calls back while it works: the caller's `progress(stage, fraction)`, and Python's signal handlers,
/// so that Ctrl-C is noticed. An exception that either raises is kept, since the library knows only "stop".
class Watch {
 public:
  explicit Watch(nb::handle callback);

  /// Empty where there is nothing to call: no callback, and no signal ever reaches this thread.
  Progress progress();

  /// Raises what the callback or a signal handler raised.
  void raise_pending() const {
    if (raised_) throw nb::python_error(*raised_);
  }

 private:
  using Clock = std::chrono::steady_clock;
  bool call(std::string_view stage, double fraction);
  bool is_due(std::string_view stage, double fraction);

  nb::object callback_;
  bool on_main_thread_ = false;
  std::string stage_;  ///< Told last,
  double fraction_ = 0;
  Clock::time_point last_call_ = Clock::now();
  std::optional<nb::python_error> raised_;
};

/// body(progress) without the interpreter's lock; its result. `callback` is Python's None or a callable.
template <class Body>
auto call_library(nb::handle callback, const Body& body) {
  Watch watch(callback);
  try {
    const nb::gil_scoped_release unlocked;
    return body(watch.progress());
  } catch (const Cancelled&) {
    watch.raise_pending();
    throw;
  }
}

/// The same for what reports no progress.
template <class Body>
auto call_unlocked(const Body& body) {
  const nb::gil_scoped_release unlocked;
  return body();
}

}  // namespace tetsoup::python
