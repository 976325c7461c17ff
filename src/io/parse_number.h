// Numbers from text that need not end in a zero byte, whatever the locale.
#pragma once

#include <cstdint>

namespace tetsoup::readers {

/// Reads a decimal number at `at` and moves it behind; false and unmoved if there is none before `end`.
///
/// Also takes nan, inf, infinity and the Microsoft runtime's 1.#IND and 1.#INF. Rounded to float the value equals the
/// correctly rounded double rounded to float; whole numbers up to 2^53 are exact.
bool parse_number(const char*& at, const char* end, double& value);

/// Reads a whole number; what 64 bits cannot hold becomes the nearest value they can.
bool parse_integer(const char*& at, const char* end, std::int64_t& value);

}  // namespace tetsoup::readers
