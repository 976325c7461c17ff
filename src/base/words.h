// Numbers and counts as sentences for people hold them.
#pragma once

#include <cstddef>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

namespace tetsoup {

/// 1234567 -> "1,234,567"
inline std::string grouped(std::size_t count) {
  std::string digits = std::to_string(count);
  for (std::size_t i = digits.size(); i > 3;) digits.insert(i -= 3, 1, ',');
  return digits;
}

/// "1 tet", "2,013 tets", "2 vertices"
inline std::string counted(std::size_t count, std::string_view noun) {
  std::string text = grouped(count) + " " + std::string(noun);
  if (count == 1) return text;
  if (noun == "vertex") return text.replace(text.size() - 2, 2, "ices");
  return text + (text.ends_with('s') || text.ends_with("ch") ? "es" : "s");
}

/// To so many digits, as short as they allow.
inline std::string rounded(double value, int digits = 3) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return text;
}

/// "12 %", "0.4 %"
inline std::string percent(double share) {
  return (share < 0.0995 ? rounded(100 * share, 2) : std::to_string(static_cast<long>(100 * share + 0.5))) + " %";
}

/// "a", "a and b", "a, b and c"
inline std::string listed(const std::vector<std::string>& parts) {
  std::string text;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (i > 0) text += i + 1 == parts.size() ? " and " : ", ";
    text += parts[i];
  }
  return text;
}

}  // namespace tetsoup
