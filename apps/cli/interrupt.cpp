#include "interrupt.h"

#include <signal.h>
#include <unistd.h>

#include <atomic>

#include "tetsoup/error.h"

namespace tetsoup::cli {

namespace {

std::atomic<bool> g_interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may touch it");

extern "C" void note_interrupt(int) {
  if (g_interrupted.exchange(true)) _exit(kExitCancelled);
}

}  // namespace

void catch_interrupts() {
  struct sigaction action {};
  action.sa_handler = note_interrupt;
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART;
  for (const int signal : {SIGINT, SIGTERM}) {
    struct sigaction before {};
    // A shell that starts the tool in the background has SIGINT ignored; that is to stay so.
    if (sigaction(signal, nullptr, &before) == 0 && before.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);
  }
  // A file beyond the size limit is then a failed write with its message, not the end of the process.
  struct sigaction ignore {};
  ignore.sa_handler = SIG_IGN;
  sigaction(SIGXFSZ, &ignore, nullptr);
}

bool interrupted() {
  return g_interrupted.load();
}

void throw_if_interrupted() {
  if (interrupted()) throw Cancelled();
}

}  // namespace tetsoup::cli
