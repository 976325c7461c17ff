#include "io/number_text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <system_error>

namespace tetsoup {

namespace {

/// As printf writes it, but for commas.
std::string printed(const char* format, int precision, double value) {
  std::string text(512, '\0');  // 309 digits before the point at most
  text.resize(static_cast<std::size_t>(std::snprintf(text.data(), text.size(), format, precision, value)));
  for (char& c : text)
    if (c == ',') c = '.';
  return text;
}

/// Fixed notation unless the other is shorter, as std::to_chars() has it.
template <class Real, class Read>
void append_least(std::string& text, Real real, const Read& read) {
  const auto value = static_cast<double>(real);
  if (!std::isfinite(value) || value == 0) {
    text += printed("%.*g", 1, value);
    return;
  }
  int digits = 1;
  std::string scientific = printed("%.*e", 0, value);
  while (digits < std::numeric_limits<Real>::max_digits10 && read(scientific.c_str()) != real)
    scientific = printed("%.*e", digits++, value);
  const int exponent = std::atoi(scientific.c_str() + scientific.find('e') + 1);
  const std::string fixed = printed("%.*f", std::max(0, digits - 1 - exponent), value);
  text += fixed.size() <= scientific.size() ? fixed : scientific;
}

// libc++ before 14 has neither direction for floating point; there the C library serves, which the locale may confuse.
#ifdef __cpp_lib_to_chars

template <class Real>
void append_shortest(std::string& text, Real value) {
  char digits[48];
  text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

double out_of_range_value(std::string_view word) {
  const bool tiny = word.find("e-") != word.npos || word.find("E-") != word.npos || word.find("0.0") < 2;
  const double size = tiny ? 0.0 : std::numeric_limits<double>::infinity();
  return word.starts_with('-') ? -size : size;
}

bool parse_plain(std::string_view word, double& value) {
  const char* end = word.data() + word.size();
  const auto result = std::from_chars(word.data(), end, value);
  if (result.ec == std::errc::result_out_of_range) value = out_of_range_value(word);
  return result.ec != std::errc::invalid_argument && result.ptr == end;
}

#else

void append_shortest(std::string& text, double value) {
  append_number_slowly(text, value);
}
void append_shortest(std::string& text, float value) {
  append_float_slowly(text, value);
}

bool parse_plain(std::string_view word, double& value) {
  if (word.find_first_of("xX") != word.npos) return false;
  const std::string copy(word);
  char* end = nullptr;
  value = std::strtod(copy.c_str(), &end);
  return !copy.empty() && end == copy.c_str() + copy.size();
}

#endif

}  // namespace

void append_digits(std::string& text, double value, int count) {
#ifdef __cpp_lib_to_chars
  char digits[48];
  text.append(digits, std::to_chars(digits, digits + sizeof digits, value, std::chars_format::general, count).ptr);
#else
  text += printed("%.*g", count, value);
#endif
}

void append_number_slowly(std::string& text, double value) {
  append_least(text, value, [](const char* word) { return std::strtod(word, nullptr); });
}

void append_float_slowly(std::string& text, float value) {
  append_least(text, value, [](const char* word) { return std::strtof(word, nullptr); });
}

void append_number(std::string& text, double value) {
  append_shortest(text, value);
}

void append_number_within(std::string& text, double value, std::size_t most) {
  const std::size_t start = text.size();
  append_number(text, value);
  for (int digits = std::numeric_limits<double>::digits10; digits > 0 && text.size() - start > most; --digits) {
    text.resize(start);
    append_digits(text, value, digits);
  }
}

void append_float(std::string& text, float value) {
  append_shortest(text, value);
}

bool parse_real(std::string_view word, double& value) {
  return parse_plain(without_plus(word), value);
}

}  // namespace tetsoup
