// Ctrl-C: the first one asks the running stage to stop, the second one ends the process at once.
#pragma once

namespace tetsoup::cli {

inline constexpr int kExitCancelled = 130;  // 128 + SIGINT, as shells report it

/// From now on SIGINT and SIGTERM are noted instead of ending the process.
void catch_interrupts();

bool interrupted();

/// @throws Cancelled  if an interrupt came.
void throw_if_interrupted();

}  // namespace tetsoup::cli
