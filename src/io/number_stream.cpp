#include "io/number_stream.h"

#include <cmath>
#include <concepts>

namespace tetsoup {

namespace {

// A double outside the wanted type's range has no defined conversion.
template <class Wanted, class Stored>
Wanted convert(Stored stored) {
  if constexpr (std::integral<Wanted> && std::floating_point<Stored>) {
    constexpr double kLimit = 9e15;  // Below 2^53: integers that doubles hold exactly.
    return std::abs(static_cast<double>(stored)) < kLimit ? static_cast<Wanted>(stored) : Wanted{-1};
  } else {
    return static_cast<Wanted>(stored);
  }
}

}  // namespace

template <class Wanted>
Wanted NumberStream::load(const char* what) {
  const std::string_view raw = source_.bytes(size_of(*type_), what);
  switch (*type_) {
    case NumberType::Int8:
      return convert<Wanted>(load_raw<std::int8_t>(raw, order_));
    case NumberType::UInt8:
      return convert<Wanted>(load_raw<std::uint8_t>(raw, order_));
    case NumberType::Int16:
      return convert<Wanted>(load_raw<std::int16_t>(raw, order_));
    case NumberType::UInt16:
      return convert<Wanted>(load_raw<std::uint16_t>(raw, order_));
    case NumberType::Int32:
      return convert<Wanted>(load_raw<std::int32_t>(raw, order_));
    case NumberType::UInt32:
      return convert<Wanted>(load_raw<std::uint32_t>(raw, order_));
    case NumberType::Int64:
      return convert<Wanted>(load_raw<std::int64_t>(raw, order_));
    case NumberType::UInt64:
      return convert<Wanted>(load_raw<std::uint64_t>(raw, order_));
    case NumberType::Float32:
      return convert<Wanted>(load_raw<float>(raw, order_));
    case NumberType::Float64:
      return convert<Wanted>(load_raw<double>(raw, order_));
  }
  return {};
}

std::int64_t NumberStream::integer(const char* what) {
  return type_ ? load<std::int64_t>(what) : source_.integer(what);
}

double NumberStream::real(const char* what) {
  return type_ ? load<double>(what) : source_.real(what);
}

std::uint32_t NumberStream::index(const char* what, std::size_t count) {
  const std::int64_t value = integer(what);
  if (value < 0 || static_cast<std::uint64_t>(value) >= count)
    fail("the " + std::string(what) + " is " + std::to_string(value) + ", but there are " + std::to_string(count) +
         " vertices");
  return static_cast<std::uint32_t>(value);
}

void NumberStream::fail(const std::string& reason) const {
  type_ ? source_.fail_byte(reason) : source_.fail(reason);
}

}  // namespace tetsoup
