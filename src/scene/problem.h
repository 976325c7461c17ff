// What is wrong in a scene, and where: by the path of the key, as in bodies[2].material.poisson.
#pragma once

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>

#include "scene/fields.h"

namespace tetsoup::scene {

/// Never leaves this folder: whoever reads a file makes an IoError of it, whoever is handed a Scene an InvalidInput.
struct Problem : std::runtime_error {
  Problem(const std::string& path, const std::string& text) : std::runtime_error(path + ": " + text) {}
};

inline std::string member_path(const std::string& path, std::string_view key) {
  return path.empty() ? std::string(key) : path + "." + std::string(key);
}
inline std::string item_path(const std::string& path, std::size_t i) {
  return path + "[" + std::to_string(i) + "]";
}

/// Structs that visit_fields() knows.
template <class T>
concept HasFields = std::is_class_v<T> && !requires(T t) {
  t.has_value();
};

/// As short as it can be told from all other numbers.
std::string number_words(double value);

/// @throws Problem  unless the range holds the number.
void check_number(const std::string& path, double value, const Range& range);

/// @throws Problem  unless the value has a name.
template <class Value, std::size_t size>
void check_word(const std::string& path, const Value& value, const Words<Value, size>& words) {
  for (const Word<Value>& word : words.all)
    if (word.value == value) return;
  throw Problem(path, "this is none of the values it may have");
}

inline constexpr double kDegree = std::numbers::pi / 180;  // radians

/// Degrees that are these radians to the bit, round ones where there are.
inline double degrees_of(double radians) {
  constexpr double kRound = 1e6;
  const double degrees = radians / kDegree, round = std::round(degrees * kRound) / kRound;
  return round * kDegree == radians ? round : degrees;
}

}  // namespace tetsoup::scene
