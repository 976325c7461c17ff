#include "base/elementary.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <utility>

namespace tetsoup::elementary {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity(), kNan = std::numeric_limits<double>::quiet_NaN();

/// Constants as the double next to them and what is left.
constexpr double kHalfPi = 0x1.921fb54442d18p+0, kHalfPiRest = 0x1.1a62633145c07p-54;
constexpr double kQuarterPi = kHalfPi / 2;
constexpr double kArcOfHalf = 0x1.dac670561bb4fp-2, kArcOfHalfRest = 0x1.a2b7f222f65e2p-56;  // atan(1/2)
/// ln 2 as 32 bits, whose product with any exponent is exact, and what is left.
constexpr double kLn2 = 0x1.62e42fee00000p-1, kLn2Rest = 0x1.a39ef35793c76p-33;
/// A quarter turn in three parts of 33 bits, whose products with 20 bits are exact, and what is left.
constexpr double kQuarterTurn[] = {0x1.921fb54400000p+0, 0x1.0b4611a600000p-34, 0x1.3198a2e000000p-69};
constexpr double kQuarterTurnRest = 0x1.b839a252049c1p-104;
constexpr double kLargestAngle = 0x1p20 * kHalfPi;

template <std::size_t N>
constexpr double polynomial(const std::array<double, N>& c, double x) {
  double sum = c[N - 1];
  for (std::size_t i = N - 1; i-- > 0;) sum = c[i] + x * sum;
  return sum;
}

/// The same as two halves side by side, for what is called for every tet.
template <std::size_t N>
constexpr double polynomial_by_halves(const std::array<double, N>& c, double x) {
  static_assert(N % 2 == 0);
  const double y = x * x;
  double even = c[N - 2], odd = c[N - 1];
  for (std::size_t i = N - 2; i > 0; i -= 2) {
    even = c[i - 2] + y * even;
    odd = c[i - 1] + y * odd;
  }
  return even + x * odd;
}

/// 1 / first!, and every `step`-th after it, with alternating signs or without.
template <std::size_t N>
constexpr std::array<double, N> inverse_factorials(int first, int step, double sign) {
  std::array<double, N> c{};
  double factorial = 1, signs = 1;
  for (int i = 2; i <= first; ++i) factorial *= i;
  for (std::size_t n = 0; n < N; ++n, signs *= sign) {
    c[n] = signs / factorial;
    for (int i = 1; i <= step; ++i) factorial *= first + static_cast<int>(n) * step + i;
  }
  return c;
}

/// scale / (2 n + 1) from n = 1 on.
template <std::size_t N>
constexpr std::array<double, N> inverse_odds(double scale, double sign) {
  std::array<double, N> c{};
  double signs = scale;
  for (std::size_t n = 0; n < N; ++n, signs *= sign) c[n] = signs / static_cast<double>(2 * n + 3);
  return c;
}

/// Not std::bit_cast, which libc++ 14 has not.
std::uint64_t bits_of(double x) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &x, sizeof bits);
  return bits;
}
double with_bits(std::uint64_t bits) {
  double x = 0;
  std::memcpy(&x, &bits, sizeof x);
  return x;
}

/// `x` cut to 27 bits or fewer, whose square is exact.
double upper_half(double x) {
  return with_bits(bits_of(x) & 0xFFFFFFFFF8000000U);
}

/// a number and what its rounding left
struct Pair {
  double high = 0, low = 0;
};

/// [Knuth69, theorem B of 4.2.2]
Pair sum_of(double a, double b) {
  const double sum = a + b, part = sum - a;
  return {sum, (a - (sum - part)) + (b - part)};
}

/// x = quarters * pi / 2 + rest, with the rest within pi / 4.
std::pair<int, Pair> quarters_of(double x) {
  if (!(std::abs(x) < kLargestAngle)) x = std::fmod(x, 4 * kHalfPi);
  const double quarters = std::round(x / kHalfPi);
  const Pair a = sum_of(x - quarters * kQuarterTurn[0], -(quarters * kQuarterTurn[1]));
  const Pair b = sum_of(a.high, -(quarters * kQuarterTurn[2]));
  const double low = a.low + b.low - quarters * kQuarterTurnRest;
  const double high = b.high + low;
  return {static_cast<int>(quarters), {high, (b.high - high) + low}};
}

/// Taylor's series within pi / 4, to first order in x.low.
double sine_of(const Pair& x) {
  static constexpr auto kTerms = inverse_factorials<8>(3, 2, -1);
  const double z = x.high * x.high, cubed = z * x.high;
  return x.high - (cubed * polynomial(kTerms, z) + (z * (x.low / 2) - x.low));
}
double cosine_of(const Pair& x) {
  static constexpr auto kTerms = inverse_factorials<7>(4, 2, -1);
  const double z = x.high * x.high, half = z / 2, w = 1 - half;
  return w + (((1 - w) - half) + (z * z * polynomial(kTerms, z) - x.high * x.low));
}

/// (asin(x) / x - 1) for x^2 = z <= 1/4: the polynomial next to it at Chebyshev's points, within 2^-61.
double arcsine_excess(double z) {
  static constexpr std::array kTerms{
      0x1.5555555555555p-3, 0x1.3333333333388p-4, 0x1.6db6db6dac1dfp-5,  0x1.f1c71c7a52bd1p-6, 0x1.6e8ba123e4071p-6,
      0x1.1c4efce24020ep-6, 0x1.c990ad3b3e6c3p-7, 0x1.7b027efe85410p-7,  0x1.3b49dd7f75ff5p-7, 0x1.316229dcdaf14p-7,
      0x1.8f18e28b47458p-9, 0x1.4061ad4dc10ffp-6, -0x1.3b4192369e517p-6, 0x1.e529dfb07a481p-6};
  return z * polynomial_by_halves(kTerms, z);
}

/// The root of z, cut so that its square is exact, and what is left.
Pair root_of(double z) {
  const double root = std::sqrt(z), high = upper_half(root);
  return {high, root > 0 ? (z - high * high) / (root + high) : 0};
}

/// Of a / b, 0 <= a <= b, b normal and finite: by the angle 0, atan(1/2) or pi / 4 near it. The last two are taken
/// where what is left is a small part of the whole, and with it the error of its division.
Pair arc_of_ratio(double a, double b) {
  static constexpr auto kTerms = inverse_odds<22>(1, -1);
  Pair base;
  double t = a / b;
  if (t > 0.75) {
    base = {kQuarterPi, kHalfPiRest / 2};
    t = (a - b) / (a + b);
  } else if (t > 0.4375) {
    base = {kArcOfHalf, kArcOfHalfRest};
    t = (a - b / 2) / (b + a / 2);
  }
  const double z = t * t;
  return {base.high, t - (t * z * polynomial(kTerms, z) - base.low)};
}

double power_of_two(int exponent) {
  return with_bits(static_cast<std::uint64_t>(exponent + 1023) << 52);
}

}  // namespace

double sin(double x) {
  if (!std::isfinite(x)) return kNan;
  if (std::abs(x) < 0x1p-27) return x;
  const auto [quarters, rest] = quarters_of(x);
  const double value = quarters % 2 != 0 ? cosine_of(rest) : sine_of(rest);
  return (quarters & 2) != 0 ? -value : value;
}

double cos(double x) {
  if (!std::isfinite(x)) return kNan;
  const auto [quarters, rest] = quarters_of(x);
  const double value = quarters % 2 != 0 ? sine_of(rest) : cosine_of(rest);
  return ((quarters + 1) & 2) != 0 ? -value : value;
}

double acos(double x) {
  if (!(std::abs(x) <= 1)) return kNan;
  if (std::abs(x) <= 0.5) return kHalfPi - (x - (kHalfPiRest - x * arcsine_excess(x * x)));
  const double z = (1 - std::abs(x)) / 2;  // sin^2 of half the angle to the nearer end
  const Pair root = root_of(z);
  const double rest = (root.high + root.low) * arcsine_excess(z) + root.low;
  if (x > 0) return 2 * (root.high + rest);
  return 2 * (kHalfPi - (root.high + (rest - kHalfPiRest)));
}

double asin(double x) {
  if (!(std::abs(x) <= 1)) return kNan;
  if (std::abs(x) <= 0.5) return x + x * arcsine_excess(x * x);
  const double z = (1 - std::abs(x)) / 2;
  const Pair root = root_of(z);
  const double rest = (root.high + root.low) * arcsine_excess(z) + root.low;
  return std::copysign(kQuarterPi - ((2 * rest - kHalfPiRest) - (kQuarterPi - 2 * root.high)), x);
}

double atan2(double y, double x) {
  if (std::isnan(x) || std::isnan(y)) return kNan;
  double a = std::abs(y), b = std::abs(x);
  if (std::isinf(a) || std::isinf(b)) {
    a = std::isinf(a) ? 1 : 0;
    b = std::isinf(b) ? 1 : 0;
  }
  const bool steep = a > b;
  if (steep) std::swap(a, b);
  // Neither sums nor halves may leave the range of doubles.
  const double scale = b > 1 ? 0x1p-2 : (b < 0x1p-900 ? 0x1p100 : 1);
  const Pair arc = b > 0 ? arc_of_ratio(a * scale, b * scale) : Pair{};
  double angle = arc.high + arc.low;
  if (steep) angle = (kHalfPi - arc.high) - (arc.low - kHalfPiRest);
  if (std::signbit(x))
    angle =
        steep ? kHalfPi + (arc.high + (arc.low + kHalfPiRest)) : (2 * kHalfPi - arc.high) - (arc.low - 2 * kHalfPiRest);
  return std::copysign(angle, y);
}

double exp(double x) {
  static constexpr auto kTerms = inverse_factorials<12>(2, 1, 1);
  constexpr double kOverflow = 709.79, kUnderflow = -745.14;
  if (std::isnan(x)) return x;
  if (x > kOverflow) return kInfinity;
  if (x < kUnderflow) return 0;
  const double doublings = std::round(x / (kLn2 + kLn2Rest));
  const double high = x - doublings * kLn2, low = doublings * kLn2Rest, r = high - low;
  const double value = 1 + (high - (low - r * r * polynomial(kTerms, r)));
  const int n = static_cast<int>(doublings), half = n / 2;
  return value * power_of_two(half) * power_of_two(n - half);
}

double log(double x) {
  static constexpr auto kTerms = inverse_odds<11>(2, 1);
  if (std::isnan(x) || x < 0) return kNan;
  if (x == 0) return -kInfinity;
  if (std::isinf(x)) return x;
  int exponent = 0;
  double m = std::frexp(x, &exponent);
  if (m < 0x1.6a09e667f3bcdp-1) m *= 2, --exponent;  // sqrt(1/2)
  // log(1 + f) = 2 atanh(s) = f - (f^2 / 2 - s (f^2 / 2 + R)), s = f / (2 + f), R = 2 atanh(s) / s - 2.
  const double f = m - 1, s = f / (2 + f), z = s * s, half = f * f / 2;
  const double rest = z * polynomial(kTerms, z);
  return exponent * kLn2 - ((half - (s * (half + rest) + exponent * kLn2Rest)) - f);
}

double cbrt(double x) {
  if (x == 0 || !std::isfinite(x)) return x;
  int exponent = 0;
  const double fraction = std::frexp(std::abs(x), &exponent);
  const int thirds = (exponent + 3000) / 3 - 1000;               // floor
  const double m = std::ldexp(fraction, exponent - 3 * thirds);  // [1/2, 4)
  // A third of the exponent and of the mantissa is right to 4 %; Halley's steps triple the digits.
  double t = with_bits(bits_of(m) / 3 + 0x2A9F76253119D328U);
  for (int step = 0; step < 2; ++step) t *= (t * t * t + 2 * m) / (2 * t * t * t + m);
  t = upper_half(t);
  const double s = m / (t * t);
  t += t * ((s - t) / (t + t + s));
  return std::copysign(std::ldexp(t, thirds), x);
}

double nearest_power_of_two(double x) {
  int exponent = 0;
  const double fraction = std::frexp(x, &exponent);
  return std::ldexp(1.0, fraction * fraction < 0.5 ? exponent - 1 : exponent);
}

}  // namespace tetsoup::elementary
