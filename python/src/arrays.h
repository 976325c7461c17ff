// Vectors of the library as NumPy arrays, and the other way round. Memory moves into the array; nothing is copied but
// what comes in.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "tetsoup/types.h"

namespace tetsoup::python {

namespace nb = nanobind;

// What comes in is checked and converted before, in Python: contiguous, of this type and shape.
using PointsIn = nb::ndarray<const float, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;
using FacesIn = nb::ndarray<const std::uint32_t, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;
using TetsIn = nb::ndarray<const std::uint32_t, nb::shape<-1, 4>, nb::c_contig, nb::device::cpu>;
using TexcoordsIn = nb::ndarray<const float, nb::shape<-1, 2>, nb::c_contig, nb::device::cpu>;
using WeightsIn = nb::ndarray<const float, nb::shape<-1, 4>, nb::c_contig, nb::device::cpu>;
using IndicesIn = nb::ndarray<const std::uint32_t, nb::shape<-1>, nb::c_contig, nb::device::cpu>;
using RealsIn = nb::ndarray<const float, nb::shape<-1>, nb::c_contig, nb::device::cpu>;

// What goes out; a const element makes the array read-only.
template <class T, int Columns>
using Rows = nb::ndarray<nb::numpy, const T, nb::shape<-1, Columns>, nb::c_contig>;
template <class T>
using Volume = nb::ndarray<nb::numpy, T, nb::shape<-1, -1, -1>, nb::c_contig>;
template <class T>
using List = nb::ndarray<nb::numpy, T, nb::shape<-1>, nb::c_contig>;

/// A vector's own memory as rows of an array; `owner` lives as long as the array does. Indices below 2^31 have the same
/// bits signed and unsigned, and NumPy's users expect them signed.
template <class T, int Columns, class Row>
Rows<T, Columns> rows_of(const std::vector<Row>& rows, nb::handle owner) {
  static_assert(sizeof(Row) == Columns * sizeof(T));
  return Rows<T, Columns>(reinterpret_cast<const T*>(rows.data()), {rows.size(), static_cast<std::size_t>(Columns)},
                          owner);
}

/// Keeps a vector alive for the arrays that show it.
template <class T>
nb::capsule owner_of(std::unique_ptr<std::vector<T>> values) {
  return nb::capsule(values.release(), [](void* p) noexcept { delete static_cast<std::vector<T>*>(p); });
}

/// Rows that the array owns.
template <class T, int Columns, class Row>
Rows<T, Columns> owned_rows(std::vector<Row> rows) {
  auto kept = std::make_unique<std::vector<Row>>(std::move(rows));
  const std::vector<Row>& shown = *kept;
  return rows_of<T, Columns>(shown, owner_of(std::move(kept)));
}

/// The same for vectors of numbers.
template <class T, class Stored>
List<const T> list_of(const std::vector<Stored>& values, nb::handle owner) {
  static_assert(sizeof(T) == sizeof(Stored));
  return List<const T>(reinterpret_cast<const T*>(values.data()), {values.size()}, owner);
}
template <class T, class Stored>
List<const T> owned_list(std::vector<Stored> values) {
  auto kept = std::make_unique<std::vector<Stored>>(std::move(values));
  const std::vector<Stored>& shown = *kept;
  return list_of<T>(shown, owner_of(std::move(kept)));
}

/// Values of a grid, x fastest, as an array (z, y, x) of T, which may be a type of the same size.
template <class T, class Stored>
Volume<T> owned_volume(std::vector<Stored> values, const GridFrame& frame) {
  static_assert(sizeof(T) == sizeof(Stored));
  auto kept = std::make_unique<std::vector<Stored>>(std::move(values));
  auto* const data = reinterpret_cast<T*>(kept->data());
  const auto extent = [&](std::size_t axis) { return static_cast<std::size_t>(frame.size[axis]); };
  return Volume<T>(data, {extent(2), extent(1), extent(0)}, owner_of(std::move(kept)));
}

/// A copy of rows from Python.
template <class Row, class Array>
std::vector<Row> copy_rows(const Array& array) {
  static_assert(sizeof(Row) % sizeof(*array.data()) == 0);
  const Row* const rows = reinterpret_cast<const Row*>(array.data());
  return array.shape(0) == 0 ? std::vector<Row>() : std::vector<Row>(rows, rows + array.shape(0));
}

/// Rows from Python where they lie, for as long as the array is held.
template <class Row, class Array>
std::span<const Row> span_of(const Array& array) {
  static_assert(sizeof(Row) % sizeof(*array.data()) == 0);
  return {reinterpret_cast<const Row*>(array.data()), array.shape(0)};
}

inline TriangleSoup copy_soup(const PointsIn& vertices, const FacesIn& faces) {
  return {copy_rows<Vec3>(vertices), copy_rows<Triangle>(faces)};
}

}  // namespace tetsoup::python
