// Rounding to whole numbers without a call: the standard's functions are calls on processors of the first 64-bit
// generation, and that is what portable builds are made for.
#pragma once

namespace tetsoup {

/// Largest whole number not above `v`, which must fit an int.
inline int floor_to_int(double v) {
  const int towards_zero = static_cast<int>(v);
  return towards_zero - static_cast<int>(v < towards_zero);
}
/// Smallest whole number not below `v`, which must fit an int.
inline int ceil_to_int(double v) {
  const int towards_zero = static_cast<int>(v);
  return towards_zero + static_cast<int>(v > towards_zero);
}

}  // namespace tetsoup
