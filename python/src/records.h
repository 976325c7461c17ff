// Reports as Python classes: attributes with names, types and docs, as_dict() and a readable repr().
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <array>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "arrays.h"
#include "tetsoup/types.h"
#include "words.h"

namespace tetsoup::python {

namespace nb = nanobind;

/// A member's value as Python shows it: vectors and boxes as tuples, enumerators as their words, the rest as it is.
template <class T>
auto python_value(const T& value) {
  if constexpr (std::is_enum_v<T>)
    return std::string(word_of(value));
  else
    return value;
}
inline auto python_value(const Vec3d& v) {
  return std::tuple(v.x, v.y, v.z);
}
inline auto python_value(const Box3& box) {
  return std::tuple(python_value(box.lo), python_value(box.hi));
}
inline auto python_value(std::string_view text) {
  return std::string(text);
}
inline auto python_value(const std::array<int, 3>& v) {
  return std::tuple(v[0], v[1], v[2]);
}

inline auto python_value(const std::vector<float>& values) {
  return owned_list<float>(values);
}

/// The record as a dict, records inside it likewise.
nb::typed<nb::dict, nb::str, nb::any> record_as_dict(nb::handle record);
nb::str describe_record(nb::handle record);

/// Declares a report: one field() a member.
template <class T>
class Record {
 public:
  Record(nb::module_& module, const char* name, const char* doc) : class_(module, name, doc) {
    class_.def(
        "as_dict", [](nb::handle_t<T> self) { return record_as_dict(self); },
        "The same as a dict, reports inside it likewise.");
    class_.def("__repr__", [](nb::handle_t<T> self) { return describe_record(self); });
    note_names();
  }

  template <class M>
  Record& field(const char* name, M T::*member, const char* doc) {
    class_.def_prop_ro(
        name, [member](const T& self) { return python_value(self.*member); }, nb::rv_policy::move, doc);
    names_.append(name);
    note_names();
    return *this;
  }

  /// What is computed from the members.
  template <class V>
  Record& field(const char* name, V (T::*function)() const, const char* doc) {
    class_.def_prop_ro(name, function, doc);
    names_.append(name);
    note_names();
    return *this;
  }

 private:
  void note_names() { class_.attr("__match_args__") = nb::tuple(names_); }

  nb::class_<T> class_;
  nb::list names_;
};

void bind_reports(nb::module_& module);

}  // namespace tetsoup::python
