// Numbers one after another, as text or as the raw bytes of a named type: what VTK's formats hold their arrays in.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "io/raw_numbers.h"
#include "io/tet_scanner.h"

namespace tetsoup {

enum class NumberType { Int8, UInt8, Int16, UInt16, Int32, UInt32, Int64, UInt64, Float32, Float64 };

inline std::size_t size_of(NumberType type) {
  constexpr std::size_t sizes[] = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  return sizes[static_cast<std::size_t>(type)];
}

class NumberStream {
 public:
  /// Text up to the scanner's end.
  explicit NumberStream(TetScanner& source) : source_(source) {}
  /// Bytes up to the scanner's end.
  NumberStream(TetScanner& source, NumberType type, ByteOrder order) : source_(source), type_(type), order_(order) {}

  /// Fewest bytes that the next number can take.
  std::size_t least_bytes() const { return type_ ? size_of(*type_) : 2; }
  bool at_end() { return type_ ? source_.left() == 0 : source_.at_end(); }

  std::int64_t integer(const char* what);
  double real(const char* what);
  /// An integer below `count`.
  std::uint32_t index(const char* what, std::size_t count);
  [[noreturn]] void fail(const std::string& reason) const;

 private:
  template <class Wanted>
  Wanted load(const char* what);

  TetScanner& source_;
  std::optional<NumberType> type_;  // None: text.
  ByteOrder order_ = ByteOrder::Little;
};

}  // namespace tetsoup
