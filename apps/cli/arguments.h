// Strict reading of what stands behind a flag: the whole text or an error that names the flag, the text and the range.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

#include "tetsoup/types.h"

namespace tetsoup::cli {

/// The values a flag takes, and how to say so.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_included = true;
  bool high_included = true;
  std::string_view words;  ///< "more than 0 and less than 60"

  bool holds(double value) const {
    return (low_included ? value >= low : value > low) && (high_included ? value <= high : value < high);
  }
};

inline constexpr Range kPositive{.low = 0, .low_included = false, .words = "a number above 0"};
inline constexpr Range kFinite{.words = "a finite number"};

/// @throws InvalidInput  unless all of `text` is a finite decimal number in the range.
double parse_number(std::string_view flag, std::string_view text, const Range& range);

/// @throws InvalidInput  unless all of `text` is a whole number in the range.
int parse_whole(std::string_view flag, std::string_view text, const Range& range);

/// @throws InvalidInput  unless all of `text` is a whole number below 2^64.
std::uint64_t parse_seed(std::string_view flag, std::string_view text);

/// Three finite numbers with commas between them: "0.1,0,0".
Vec3d parse_triple(std::string_view flag, std::string_view text);

}  // namespace tetsoup::cli
