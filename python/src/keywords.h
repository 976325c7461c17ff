// Keywords of Python's functions and the members of the library's structs that they set: values both ways, and what to
// say where one does not fit.
#pragma once

#include <nanobind/nanobind.h>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "tetsoup/error.h"
#include "words.h"

namespace tetsoup::python {

namespace nb = nanobind;

// --- Values from Python: false where one does not fit
// -----------------------------------------------------------------

template <class T>
requires std::is_arithmetic_v<T>
bool read(nb::handle value, T& number) {
  return !PyBool_Check(value.ptr()) && nb::try_cast(value, number);
}

template <class E>
requires std::is_enum_v<E>
bool read(nb::handle value, E& choice) {
  if (!PyUnicode_Check(value.ptr())) return false;
  const std::string_view given = nb::cast<nb::str>(value).c_str();
  for (const auto& [word, named] : kWords<E>) {
    if (given != word) continue;
    choice = named;
    return true;
  }
  return false;
}

inline bool read(nb::handle value, Vec3d& v);  // an item of the next, and made of items

template <std::size_t N, class T>
bool read_items(nb::handle value, std::array<T*, N> items) {
  // Anything that iterates, but text: lists, tuples, arrays.
  if (PyUnicode_Check(value.ptr()) || !PySequence_Check(value.ptr())) return false;
  if (nb::len(value) != N) return false;
  for (std::size_t i = 0; i < N; ++i) {
    const nb::object item = value[i];
    if (!read(item, *items[i])) return false;
  }
  return true;
}

inline bool read(nb::handle value, Vec3d& v) {
  return read_items(value, std::array{&v.x, &v.y, &v.z});
}
inline bool read(nb::handle value, Box3& box) {
  return read_items(value, std::array{&box.lo, &box.hi});
}

template <class T>
bool read(nb::handle value, std::optional<T>& maybe) {
  maybe.reset();
  return value.is_none() || read(value, maybe.emplace());
}

// --- What would have fitted, for messages
// -----------------------------------------------------------------------------

template <class T>
struct Expected {
  static std::string text() {
    if constexpr (std::is_enum_v<T>) {
      std::string words;
      for (const auto& [word, named] : kWords<T>) words += std::string(words.empty() ? "'" : "', '") + word;
      return "one of " + words + "'";
    } else if constexpr (std::is_floating_point_v<T>) {
      return "a number";
    } else {
      return std::is_signed_v<T> ? "a whole number" : "a whole number of at least 0";
    }
  }
};
template <>
struct Expected<Vec3d> {
  static std::string text() { return "three numbers"; }
};
template <>
struct Expected<Box3> {
  static std::string text() { return "two corners of three numbers each"; }
};
template <class T>
struct Expected<std::optional<T>> {
  static std::string text() { return Expected<T>::text() + ", or None"; }
};

// --- Values to Python
// -------------------------------------------------------------------------------------------------

template <class T>
nb::object show(const T& value) {
  if constexpr (std::is_enum_v<T>)
    return nb::str(word_of(value));
  else
    return nb::cast(value);
}
inline nb::object show(const Vec3d& v) {
  return nb::make_tuple(v.x, v.y, v.z);
}
inline nb::object show(const Box3& box) {
  return nb::make_tuple(show(box.lo), show(box.hi));
}
template <class T>
nb::object show(const std::optional<T>& maybe) {
  return maybe ? show(*maybe) : nb::none();
}

// --- Keywords
// -----------------------------------------------------------------------------------------------------------

/// A keyword of Python and the member of a struct that it sets.
template <class Whole>
struct Keyword {
  const char* name;
  void (*set)(Whole& whole, const char* name, nb::handle value);
  nb::object (*get)(const Whole& whole);
};

/// A member that lies where the pointers to members lead.
template <class Whole, auto... Path>
constexpr Keyword<Whole> keyword(const char* name) {
  return {name,
          [](Whole& whole, const char* called, nb::handle value) {
            auto& member = (whole.*....*Path);
            if (!read(value, member))
              throw InvalidInput(std::string(called) + " = " + nb::repr(value).c_str() + ", must be " +
                                 Expected<std::remove_reference_t<decltype(member)>>::text());
          },
          [](const Whole& whole) { return show((whole.*....*Path)); }};
}

/// A struct from keywords.
/// @throws InvalidInput  for a value of the wrong type or an unknown word; nb::type_error for an unknown keyword.
template <class Whole>
Whole from_keywords(const std::vector<Keyword<Whole>>& known, nb::dict given) {
  Whole whole{};
  for (const auto& [key, value] : given) {
    const std::string name = nb::cast<nb::str>(key).c_str();
    const Keyword<Whole>* found = nullptr;
    for (const Keyword<Whole>& keyword : known)
      if (name == keyword.name) found = &keyword;
    if (found == nullptr) throw nb::type_error(("there is no option '" + name + "' here").c_str());
    found->set(whole, found->name, value);
  }
  return whole;
}

/// The value of every keyword.
template <class Whole>
nb::typed<nb::dict, nb::str, nb::any> to_keywords(const std::vector<Keyword<Whole>>& known, const Whole& whole) {
  nb::typed<nb::dict, nb::str, nb::any> values;
  for (const Keyword<Whole>& keyword : known) values[keyword.name] = keyword.get(whole);
  return values;
}

}  // namespace tetsoup::python
