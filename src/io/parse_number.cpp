// Decimal text to double: exact in one multiplication for what files hold, the standard library for the rest.
#include "io/parse_number.h"

#include <array>
#include <charconv>
#include <cstdlib>
#include <limits>
#include <string>
#include <string_view>

namespace tetsoup::readers {
namespace {

constexpr int kMaxDigits = 19;                              // as many as 64 bits hold
constexpr std::uint64_t kExactWhole = 1ULL << 53;           // doubles hold all whole numbers up to here
constexpr std::int64_t kExponentLimit = 1'000'000'000'000;  // beyond any double, far from overflow
constexpr std::array<double, 23> kPowersOfTen = {
    1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
    1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};  // all exact

struct Decimal {
  std::uint64_t mantissa = 0;
  std::int64_t exponent = 0;
  int digits = 0;  // significant ones in the mantissa
};

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

bool take_sign(const char*& at, const char* end) {
  if (at == end || (*at != '-' && *at != '+')) return false;
  return *at++ == '-';
}

bool take_word(const char*& at, const char* end, std::string_view lower_case) {
  if (static_cast<std::size_t>(end - at) < lower_case.size()) return false;
  for (std::size_t i = 0; i < lower_case.size(); ++i) {
    if ((at[i] | 0x20) != lower_case[i]) return false;
  }
  at += lower_case.size();
  return true;
}

bool take_special(const char*& at, const char* end, double& value) {
  if (take_word(at, end, "infinity") || take_word(at, end, "inf")) {
    value = std::numeric_limits<double>::infinity();
    return true;
  }
  if (!take_word(at, end, "nan")) return false;
  value = std::numeric_limits<double>::quiet_NaN();
  if (at != end && *at == '(') {
    while (at != end && *at != ')' && *at != '\n') ++at;
    if (at != end && *at == ')') ++at;
  }
  return true;
}

/// What the Microsoft runtime prints behind "1." for a number that is none: #INF, #IND, #QNAN, #SNAN.
void take_microsoft_special(const char*& at, const char* end, double& value) {
  ++at;
  value =
      take_word(at, end, "inf") ? std::numeric_limits<double>::infinity() : std::numeric_limits<double>::quiet_NaN();
  while (at != end && static_cast<unsigned char>(*at) > ' ') ++at;
}

bool take_digits(const char*& at, const char* end, bool behind_point, Decimal& number) {
  const char* const begin = at;
  for (; at != end && is_digit(*at); ++at) {
    if (number.digits < kMaxDigits) {
      number.mantissa = number.mantissa * 10 + static_cast<std::uint64_t>(*at - '0');
      number.digits += number.mantissa != 0;
      number.exponent -= behind_point;
    } else {
      number.exponent += !behind_point;
    }
  }
  return at != begin;
}

void take_exponent(const char*& at, const char* end, Decimal& number) {
  if (at == end || (*at | 0x20) != 'e') return;
  const char* p = at + 1;
  const bool negative = take_sign(p, end);
  if (p == end || !is_digit(*p)) return;
  std::int64_t exponent = 0;
  for (; p != end && is_digit(*p); ++p) {
    if (exponent < kExponentLimit) exponent = exponent * 10 + (*p - '0');
  }
  number.exponent += negative ? -exponent : exponent;
  at = p;
}

/// False where the product of rounded factors might fall on the wrong side of a float's rounding border.
bool scale_fast(const Decimal& number, double& value) {
  constexpr std::int64_t kLargest = kPowersOfTen.size() - 1;
  if (number.exponent < -kLargest || number.exponent > kLargest) return false;
  value = static_cast<double>(number.mantissa);
  if (number.exponent < 0) {
    value /= kPowersOfTen[static_cast<std::size_t>(-number.exponent)];
  } else {
    value *= kPowersOfTen[static_cast<std::size_t>(number.exponent)];
  }
  if (number.mantissa <= kExactWhole) return true;
  constexpr double kSlack = 4 * std::numeric_limits<double>::epsilon();  // three roundings of half of it each
  return static_cast<float>(value * (1 - kSlack)) == static_cast<float>(value * (1 + kSlack));
}

double scale_slowly(const char* begin, const char* end, const Decimal& number) {
  const std::int64_t magnitude = number.exponent + number.digits;
  const double beyond = magnitude > 0 ? std::numeric_limits<double>::infinity() : 0.0;
  if (magnitude > std::numeric_limits<double>::max_exponent10 + 1) return beyond;
  if (magnitude < std::numeric_limits<double>::min_exponent10 - 20) return beyond;
#if defined(__cpp_lib_to_chars) && __cpp_lib_to_chars >= 201611L
  double value = 0;
  return std::from_chars(begin, end, value).ec == std::errc() ? value : beyond;
#else
  return std::strtod(std::string(begin, end).c_str(), nullptr);
#endif
}

}  // namespace

bool parse_number(const char*& at, const char* end, double& value) {
  const char* p = at;
  const bool negative = take_sign(p, end);
  const char* const begin = p;
  Decimal number;
  bool any = take_digits(p, end, false, number);
  if (p != end && *p == '.') {
    ++p;
    any = take_digits(p, end, true, number) || any;
  }
  if (any) {
    take_exponent(p, end, number);
    if (number.mantissa == 0) {
      value = 0;
    } else if (!scale_fast(number, value)) {
      value = scale_slowly(begin, p, number);
    }
    if (p != end && *p == '#' && p[-1] == '.') take_microsoft_special(p, end, value);
  } else {
    p = begin;
    if (!take_special(p, end, value)) return false;
  }
  if (negative) value = -value;
  at = p;
  return true;
}

bool parse_integer(const char*& at, const char* end, std::int64_t& value) {
  const char* p = at;
  const bool negative = take_sign(p, end);
  if (p == end || !is_digit(*p)) return false;
  constexpr std::uint64_t kMax = std::numeric_limits<std::int64_t>::max();
  std::uint64_t magnitude = 0;
  for (; p != end && is_digit(*p); ++p) {
    const auto digit = static_cast<std::uint64_t>(*p - '0');
    magnitude = magnitude > (kMax - digit) / 10 ? kMax : magnitude * 10 + digit;
  }
  value = negative ? -static_cast<std::int64_t>(magnitude) : static_cast<std::int64_t>(magnitude);
  at = p;
  return true;
}

}  // namespace tetsoup::readers
