// A child process whose calls of the system are counted, and of which one can fail or be its last.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#if defined(__linux__) && defined(__x86_64__)
#include <sys/ptrace.h>
#include <sys/syscall.h>
#include <sys/user.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdint>

namespace tetsoup {

/// Of those calls that change files.
enum class FileCall { Open, Write, Sync, Close, Rename, Link, Remove };

struct Trace {
  std::vector<FileCall> calls;
  int exit_code = -1;  ///< -1: killed.
};

namespace traced {

inline std::optional<FileCall> file_call(std::uint64_t number) {
  switch (number) {
    case SYS_open:
    case SYS_openat:
      return FileCall::Open;
    case SYS_write:
    case SYS_writev:
    case SYS_pwrite64:
      return FileCall::Write;
    case SYS_fsync:
    case SYS_fdatasync:
      return FileCall::Sync;
    case SYS_close:
      return FileCall::Close;
    case SYS_rename:
    case SYS_renameat:
    case SYS_renameat2:
      return FileCall::Rename;
    case SYS_link:
    case SYS_linkat:
      return FileCall::Link;
    case SYS_unlink:
    case SYS_unlinkat:
    case SYS_rmdir:
      return FileCall::Remove;
    default:
      return {};
  }
}

template <class... Arguments>
long ask(int request, Arguments... arguments) {
  return ::ptrace(static_cast<__ptrace_request>(request), arguments...);
}

/// Lets the child go on to its next call; false if it has ended, whose status is then in the trace.
inline bool go_on(pid_t child, Trace& trace) {
  int status = 0;
  ask(PTRACE_SYSCALL, child, nullptr, nullptr);
  if (::waitpid(child, &status, 0) < 0) return false;
  if (WIFEXITED(status)) trace.exit_code = WEXITSTATUS(status);
  return WIFSTOPPED(status);
}

/// The call that the child is about to make fails, as on a full disk.
inline void refuse(pid_t child, Trace& trace, int reason) {
  user_regs_struct registers{};
  ask(PTRACE_GETREGS, child, nullptr, &registers);
  registers.orig_rax = static_cast<unsigned long long>(-1);
  ask(PTRACE_SETREGS, child, nullptr, &registers);
  go_on(child, trace);
  ask(PTRACE_GETREGS, child, nullptr, &registers);
  registers.rax = static_cast<unsigned long long>(-reason);
  ask(PTRACE_SETREGS, child, nullptr, &registers);
}

}  // namespace traced

enum class Fate { Refused, Killed };
struct Fault {
  std::size_t call = 0;  ///< Which of the calls that change files; it is not carried out.
  Fate fate = Fate::Refused;
};

/// Runs `act` in a child whose exit code it returns. `look` is asked before every call that changes files.
inline Trace run_traced(
    const std::function<int()>& act, std::optional<Fault> fault,
    const std::function<void(FileCall)>& look = [](FileCall) {}) {
  Trace trace;
  const pid_t child = ::fork();
  if (child == 0) {
    traced::ask(PTRACE_TRACEME, 0, nullptr, nullptr);
    ::raise(SIGSTOP);
    ::_exit(act());
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  traced::ask(PTRACE_SETOPTIONS, child, nullptr, PTRACE_O_TRACESYSGOOD | PTRACE_O_EXITKILL);
  while (traced::go_on(child, trace)) {
    __ptrace_syscall_info info{};
    traced::ask(PTRACE_GET_SYSCALL_INFO, child, sizeof info, &info);
    if (info.op != PTRACE_SYSCALL_INFO_ENTRY) continue;
    const std::optional<FileCall> call = traced::file_call(info.entry.nr);
    if (!call) continue;
    look(*call);
    trace.calls.push_back(*call);
    if (!fault || trace.calls.size() != fault->call + 1) continue;
    if (fault->fate == Fate::Refused) {
      traced::refuse(child, trace, ENOSPC);
    } else {
      ::kill(child, SIGKILL);
    }
  }
  return trace;
}

}  // namespace tetsoup
#endif
