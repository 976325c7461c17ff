// Our own sin, cos, exp, ... against the C library's: the same to about an ulp, and the same bits everywhere.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>

#include "base/elementary.h"
#include "samples/formula.h"

namespace tetsoup {
namespace {

using LongDouble = long double;
constexpr double kInf = std::numeric_limits<double>::infinity();

/// Distance from the true value, in units of its last place.
double ulps_off(double value, LongDouble truth) {
  const double next = static_cast<double>(truth);
  if (value == next) return 0;
  const double ulp = std::max(std::abs(std::nextafter(next, kInf) - next), std::numeric_limits<double>::denorm_min());
  return static_cast<double>(std::abs(static_cast<LongDouble>(value) - truth)) / ulp;
}

struct Function {
  const char* name;
  double (*ours)(double);
  std::function<LongDouble(LongDouble)> theirs;
  double low, high;
  enum class Spread { Even, ByExponent } spread;
  double most_ulps;
};

double input_of(const Function& f, samples::Random& random) {
  if (f.spread == Function::Spread::Even) return f.low + (f.high - f.low) * random.uniform();
  const double size = std::exp2(std::log2(f.low) + (std::log2(f.high) - std::log2(f.low)) * random.uniform());
  return random.next() % 2 == 0 ? size : -size;
}

const Function kFunctions[] = {
    {"sin", elementary::sin, [](LongDouble x) { return std::sin(x); }, -7, 7, Function::Spread::Even, 0.85},
    {"sin", elementary::sin, [](LongDouble x) { return std::sin(x); }, 1e-300, 1.6e6, Function::Spread::ByExponent,
     0.85},
    {"cos", elementary::cos, [](LongDouble x) { return std::cos(x); }, -7, 7, Function::Spread::Even, 0.85},
    {"cos", elementary::cos, [](LongDouble x) { return std::cos(x); }, 1e-9, 1.6e6, Function::Spread::ByExponent, 0.85},
    {"asin", elementary::asin, [](LongDouble x) { return std::asin(x); }, -1, 1, Function::Spread::Even, 0.85},
    {"asin", elementary::asin, [](LongDouble x) { return std::asin(x); }, 1e-300, 1, Function::Spread::ByExponent,
     0.85},
    {"acos", elementary::acos, [](LongDouble x) { return std::acos(x); }, -1, 1, Function::Spread::Even, 1},
    {"acos", elementary::acos, [](LongDouble x) { return std::acos(x); }, 1e-300, 1, Function::Spread::ByExponent, 1},
    {"exp", elementary::exp, [](LongDouble x) { return std::exp(x); }, -745, 709.7, Function::Spread::Even, 1},
    {"exp", elementary::exp, [](LongDouble x) { return std::exp(x); }, 1e-20, 700, Function::Spread::ByExponent, 1},
    {"log", elementary::log, [](LongDouble x) { return std::log(x); }, 0.3, 3, Function::Spread::Even, 1},
    {"log", [](double x) { return elementary::log(std::abs(x)); }, [](LongDouble x) { return std::log(std::abs(x)); },
     5e-324, 1.7e308, Function::Spread::ByExponent, 1},
    {"cbrt", elementary::cbrt, [](LongDouble x) { return std::cbrt(x); }, -30, 30, Function::Spread::Even, 0.7},
    {"cbrt", elementary::cbrt, [](LongDouble x) { return std::cbrt(x); }, 5e-324, 1.7e308, Function::Spread::ByExponent,
     0.7},
};

TEST(Elementary, each_function_is_the_c_librarys_within_an_ulp) {
  for (const Function& f : kFunctions) {
    samples::Random random(7);
    double worst = 0, at = 0;
    for (int i = 0; i < 200'000; ++i) {
      const double x = input_of(f, random), off = ulps_off(f.ours(x), f.theirs(x));
      if (!(off <= worst)) worst = off, at = x;
    }
    EXPECT_LE(worst, f.most_ulps) << f.name << " of " << at << " in " << f.low << ".." << f.high;
    RecordProperty(f.name, std::to_string(worst));
  }
}

TEST(Elementary, angles_next_to_whole_quarters_keep_their_digits) {
  for (int quarter = -2000; quarter <= 2000; ++quarter) {
    const double x = quarter * (std::numbers::pi / 2);
    EXPECT_LE(ulps_off(elementary::sin(x), std::sin(static_cast<LongDouble>(x))), 1) << quarter;
    EXPECT_LE(ulps_off(elementary::cos(x), std::cos(static_cast<LongDouble>(x))), 1) << quarter;
  }
}

TEST(Elementary, the_angle_of_any_two_numbers_is_the_c_librarys_within_an_ulp_and_a_half) {
  samples::Random random(3);
  double worst = 0;
  for (int i = 0; i < 200'000; ++i) {
    const bool wide = i % 2 == 0;
    const auto number = [&] {
      const double size = wide ? std::exp2(2096 * random.uniform() - 1073) : random.uniform();
      return random.next() % 2 == 0 ? size : -size;
    };
    const double y = number(), x = number();
    worst = std::max(worst, ulps_off(elementary::atan2(y, x), std::atan2(LongDouble{y}, LongDouble{x})));
  }
  EXPECT_LE(worst, 1.5);  // The rounding of y / x comes first.
  for (const double y : {0.0, -0.0, 1.0, -1.0, kInf, -kInf, 1.7e308, 5e-324})
    for (const double x : {0.0, -0.0, 1.0, -1.0, kInf, -kInf, 1.7e308, 5e-324})
      EXPECT_EQ(elementary::atan2(y, x), std::atan2(y, x)) << y << " " << x;
}

TEST(Elementary, what_is_not_a_finite_number_is_answered_as_the_c_library_does) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const auto f : {elementary::sin, elementary::cos, elementary::asin, elementary::acos, elementary::exp,
                       elementary::log, elementary::cbrt})
    EXPECT_TRUE(std::isnan(f(nan)));
  EXPECT_TRUE(std::isnan(elementary::atan2(nan, 1)) && std::isnan(elementary::atan2(1, nan)));
  EXPECT_TRUE(std::isnan(elementary::sin(kInf)) && std::isnan(elementary::cos(-kInf)));
  EXPECT_TRUE(std::isnan(elementary::acos(1.0000001)) && std::isnan(elementary::asin(-1.0000001)));
  EXPECT_EQ(elementary::exp(kInf), kInf);
  EXPECT_EQ(elementary::exp(-kInf), 0);
  EXPECT_EQ(elementary::exp(1e300), kInf);
  EXPECT_EQ(elementary::log(0), -kInf);
  EXPECT_EQ(elementary::log(kInf), kInf);
  EXPECT_TRUE(std::isnan(elementary::log(-1)));
  EXPECT_EQ(elementary::cbrt(-kInf), -kInf);
  EXPECT_TRUE(std::signbit(elementary::cbrt(-0.0)) && std::signbit(elementary::sin(-0.0)));
}

TEST(Elementary, round_numbers_have_round_answers) {
  for (int i = -100; i <= 100; ++i) EXPECT_EQ(elementary::cbrt(static_cast<double>(i) * i * i), i);
  EXPECT_EQ(elementary::exp(0), 1);
  EXPECT_EQ(elementary::log(1), 0);
  EXPECT_EQ(elementary::cos(0), 1);
  EXPECT_EQ(elementary::acos(1), 0);
  EXPECT_EQ(elementary::acos(-1), std::numbers::pi);
  EXPECT_EQ(elementary::sin(std::numbers::pi / 2), 1);
}

TEST(Elementary, an_angle_beyond_all_turns_is_still_an_angle) {
  for (const double x : {1e7, -1e10, 1e22, 1e100, 1.7e308}) {
    const double s = elementary::sin(x), c = elementary::cos(x);
    EXPECT_NEAR(s * s + c * c, 1, 1e-15) << x;
  }
}

TEST(Elementary, the_next_power_of_two_is_next_by_ratio) {
  for (int exponent = -300; exponent <= 300; ++exponent) {
    const double power = std::ldexp(1.0, exponent);
    for (const double factor : {0.7072, 0.9, 1.0, 1.2, 1.414})
      EXPECT_EQ(elementary::nearest_power_of_two(power * factor), power) << exponent << " " << factor;
  }
}

/// Golden: what any compiler, any C library and any processor has to give.
TEST(Elementary, the_bits_are_the_same_on_every_machine) {
  std::uint64_t hash = 0;
  for (const Function& f : kFunctions) {
    samples::Random random(11);
    for (int i = 0; i < 20'000; ++i) {
      // Not input_of(), which asks the C library.
      const std::uint64_t word = random.next();
      const double wide = std::ldexp(random.uniform() - 0.5, static_cast<int>(word % 64) - 40);
      const double x = std::abs(f.high) <= 1 ? 2 * random.uniform() - 1 : wide;
      const double value = f.ours(x);
      if (!std::isnan(value)) hash = hash * 0x9E3779B97F4A7C15U + std::bit_cast<std::uint64_t>(value);
    }
  }
  EXPECT_EQ(hash, 338981820905432428U);
}

}  // namespace
}  // namespace tetsoup
