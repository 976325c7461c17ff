// Numbers to text and back: shortest form that reads back to the same bits, whatever the locale.
#pragma once

#include <charconv>
#include <concepts>
#include <cstddef>
#include <string>
#include <string_view>

namespace tetsoup {

/// The shortest decimals that read back as this number in double precision. Floats are written as doubles too: most
/// programs read doubles, and the float's own shortest decimals would give them a vertex half a float step away, enough
/// to break an angle at its floor.
void append_number(std::string& text, double value);
inline void append_number(std::string& text, float value) {
  append_number(text, static_cast<double>(value));
}

/// The same in at most `most` characters, 12 or more, for readers of fixed columns: with fewer digits where it must be.
void append_number_within(std::string& text, double value, std::size_t most);

/// The float's own shortest decimals, for files whose readers read floats.
void append_float(std::string& text, float value);

/// Rounded to so many digits, as printf's %g writes it.
void append_digits(std::string& text, double value, int count);

/// append_number() and append_float() where the standard library cannot do it, to the same characters: the C library,
/// which the locale may confuse, is asked for more and more digits.
void append_number_slowly(std::string& text, double value);
void append_float_slowly(std::string& text, float value);

template <std::integral Integer>
void append_number(std::string& text, Integer value) {
  char digits[24];
  text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

/// Numbers with a blank between them, then a newline.
template <class First, class... Rest>
void append_line(std::string& text, First first, Rest... rest) {
  append_number(text, first);
  ((text += ' ', append_number(text, rest)), ...);
  text += '\n';
}

/// Without the + that may stand before a number; before another sign it stays, and makes it none.
inline std::string_view without_plus(std::string_view word) {
  if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
  return word;
}

/// Nearest double to the number that is the whole of `word`; beyond its range that is infinity or zero. False if it is
/// no number.
bool parse_real(std::string_view word, double& value);

}  // namespace tetsoup
