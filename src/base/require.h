// Checks of what the caller asked for (kind 1 in docs/ARCHITECTURE.md) and of our own invariants (kind 3).
#pragma once

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <string>
#include <string_view>

#include "tetsoup/error.h"

namespace tetsoup {

/// Throws InvalidInput "option = value, must be range" unless `ok`.
template <class T>
void require(bool ok, std::string_view option, const T& value, std::string_view range) {
  if (ok) return;
  std::ostringstream text;
  text << option << " = " << value << ", must be " << range;
  throw InvalidInput(text.str());
}

}  // namespace tetsoup

#ifdef TETSOUP_CHECKED
#define TETSOUP_ASSERT(condition)                                                            \
  do {                                                                                       \
    if (!(condition)) {                                                                      \
      std::fprintf(stderr, "%s:%d: assertion failed: %s\n", __FILE__, __LINE__, #condition); \
      std::abort();                                                                          \
    }                                                                                        \
  } while (false)
#else
#define TETSOUP_ASSERT(condition) ((void)0)
#endif
