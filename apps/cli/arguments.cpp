#include "arguments.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <optional>

#include "tetsoup/error.h"

namespace tetsoup::cli {

namespace {

[[noreturn]] void refuse(std::string_view flag, std::string_view text, std::string_view expected) {
  throw InvalidInput(fmt::format("{} {}: must be {}", flag, text.empty() ? "\"\"" : text, expected));
}

/// strtod alone would also take leading blanks, hexadecimal numbers, "nan" and "infinity".
std::optional<double> plain_decimal(std::string_view text) {
  if (text.empty() || text.find_first_not_of("0123456789+-.eE") != std::string_view::npos) return {};
  const std::string terminated(text);
  char* end = nullptr;
  const double value = std::strtod(terminated.c_str(), &end);
  if (end != terminated.c_str() + terminated.size() || !std::isfinite(value)) return {};
  return value;
}

}  // namespace

double parse_number(std::string_view flag, std::string_view text, const Range& range) {
  const std::optional<double> value = plain_decimal(text);
  if (!value || !range.holds(*value)) refuse(flag, text, range.words);
  return *value;
}

int parse_whole(std::string_view flag, std::string_view text, const Range& range) {
  int value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end || !range.holds(value)) refuse(flag, text, range.words);
  return value;
}

std::uint64_t parse_seed(std::string_view flag, std::string_view text) {
  std::uint64_t value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end) refuse(flag, text, "a whole number from 0 to 2^64 - 1");
  return value;
}

Vec3d parse_triple(std::string_view flag, std::string_view text) {
  constexpr std::string_view kExpected = "three finite numbers with commas between them, as in 0.1,0,0";
  const std::size_t first = text.find(',');
  const std::size_t second = first == std::string_view::npos ? first : text.find(',', first + 1);
  if (second == std::string_view::npos) refuse(flag, text, kExpected);
  const std::optional<double> x = plain_decimal(text.substr(0, first));
  const std::optional<double> y = plain_decimal(text.substr(first + 1, second - first - 1));
  const std::optional<double> z = plain_decimal(text.substr(second + 1));
  if (!x || !y || !z) refuse(flag, text, kExpected);
  return {*x, *y, *z};
}

}  // namespace tetsoup::cli
