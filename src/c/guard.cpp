#include "c/guard.h"

#include <cstdio>

namespace tetsoup::c {

namespace {

/// Of a fixed size: it must do without memory where there is none.
thread_local char t_error[2048] = "";
thread_local std::string t_text;

}  // namespace

void set_error(const char* text) noexcept {
  std::snprintf(t_error, sizeof t_error, "%s", text);
}

const char* keep_text(std::string text) {
  t_text = std::move(text);
  return t_text.c_str();
}

Progress progress_of(tetsoup_progress progress, void* context) {
  if (progress == nullptr) return {};
  return [progress, context](std::string_view stage, double fraction) {
    return progress(std::string(stage).c_str(), fraction, context) != 0;
  };
}

}  // namespace tetsoup::c

const char* tetsoup_last_error(void) {
  return tetsoup::c::t_error;
}
