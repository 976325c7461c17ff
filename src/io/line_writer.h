// Lists of numbers in lines of a few.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "io/number_text.h"

namespace tetsoup {

/// Each number + `base`, `per_line` of them a line, with `between` between them and at the end of all lines but the
/// last.
template <class Number>
void append_list(std::string& text, std::span<const Number> numbers, Number base, std::size_t per_line,
                 std::string_view between) {
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    append_number(text, numbers[i] + base);
    if (i + 1 == numbers.size()) break;
    text += between;
    if ((i + 1) % per_line == 0) text += '\n';
  }
  text += '\n';
}

}  // namespace tetsoup
