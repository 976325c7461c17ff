// The few functions of the C library on which results depend, with the same bits on every machine.
//
// sin, cos, exp, log, cbrt and acos differ from one C library to the next, in the last bit and in many inputs. These
// are made of +, -, *, / and sqrt, which IEEE 754 rounds in one way, and of bits. A test holds them to the C library's
// within an ulp; a test of the house sees to it that src/ calls no others, save where pictures are drawn.
//
// Not here because they are exact everywhere: abs, floor, ceil, round, lround, trunc, min, max, sqrt, fmod, frexp,
// ldexp.
#pragma once

namespace tetsoup::elementary {

/// Of angles in radians, to an ulp up to a quarter of a million turns. Larger ones are first reduced by the double next
/// to a turn: the result is a sine all the same, of an angle that the caller cannot have meant to the last digit.
double sin(double x);
double cos(double x);
double asin(double x);  ///< NaN outside [-1, 1].
double acos(double x);  ///< NaN outside [-1, 1].
double atan2(double y, double x);
double exp(double x);
double log(double x);
double cbrt(double x);

constexpr double square(double x) {
  return x * x;
}
constexpr double cube(double x) {
  return x * x * x;
}

/// The power of two next to a positive number, by ratio: within [sqrt(1/2), sqrt(2)] of it.
double nearest_power_of_two(double x);

}  // namespace tetsoup::elementary
