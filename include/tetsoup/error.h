// tetsoup: the only three exceptions thrown on purpose. Ugly geometry is never one of them: it is counted in a report.
#pragma once

#include <stdexcept>
#include <string>

namespace tetsoup {

/// The caller asked for something out of range; the text names the option, its value and the range.
struct InvalidInput : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

/// A file cannot be read, parsed or written; the text names the file and the line, the byte offset or the system's
/// reason.
struct IoError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A progress callback asked to stop.
struct Cancelled : std::runtime_error {
  Cancelled() : std::runtime_error("cancelled") {}
};

}  // namespace tetsoup
