#include "progress.h"

namespace tetsoup::python {

namespace {

// Taking the lock may have to wait for another thread of Python, 5 ms by default. This seldom it costs little, and
// Ctrl-C is still noticed well within 100 ms.
constexpr std::chrono::milliseconds kBetweenCalls{10};

bool is_main_thread() {
  const nb::module_ threading = nb::module_::import_("threading");
  return threading.attr("current_thread")().is(threading.attr("main_thread")());
}

}  // namespace

Watch::Watch(nb::handle callback) : callback_(nb::borrow(callback)), on_main_thread_(is_main_thread()) {
  if (!callback_.is_none() && PyCallable_Check(callback_.ptr()) == 0)
    throw nb::type_error("progress must be a callable that takes a stage's name and a fraction, or None");
}

Progress Watch::progress() {
  if (callback_.is_none() && !on_main_thread_) return {};
  return [this](std::string_view stage, double fraction) { return call(stage, fraction); };
}

/// Every stage's begin and end, and in between now and then. A stage may run again: its fraction then starts anew. With
/// nobody to tell it is Ctrl-C alone that matters, and short work never takes the lock.
bool Watch::is_due(std::string_view stage, double fraction) {
  const Clock::time_point now = Clock::now();
  const bool news =
      !callback_.is_none() && (stage != stage_ || fraction < fraction_ || (fraction >= 1 && fraction_ < 1));
  if (!news && now - last_call_ < kBetweenCalls) return false;
  stage_ = stage;
  fraction_ = fraction;
  last_call_ = now;
  return true;
}

bool Watch::call(std::string_view stage, double fraction) {
  if (raised_) return false;
  if (!is_due(stage, fraction)) return true;
  const nb::gil_scoped_acquire locked;
  try {
    if (PyErr_CheckSignals() != 0) nb::raise_python_error();
    if (callback_.is_none()) return true;
    const nb::object answer = callback_(nb::str(stage.data(), stage.size()), fraction);
    if (answer.is_none()) return true;
    const int truth = PyObject_IsTrue(answer.ptr());  // Not __bool__(), which strings and lists have not.
    if (truth < 0) nb::raise_python_error();
    return truth != 0;
  } catch (nb::python_error& error) {
    raised_.emplace(error);
    return false;
  }
}

}  // namespace tetsoup::python
