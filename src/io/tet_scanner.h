// Words, numbers and raw bytes of a tet mesh file held in memory. Every failure is an IoError with file and line.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "io/raw_numbers.h"

namespace tetsoup {

class TetScanner {
 public:
  /// Both must outlive the scanner. Text from `comment` to the end of its line is skipped like a blank.
  TetScanner(std::string_view text, const std::string& name, char comment = '\0')
      : text_(text), name_(name), comment_(comment) {}

  std::size_t position() const { return position_; }
  void seek(std::size_t position) { position_ = position; }
  std::string_view text() const { return text_; }
  /// Bytes not yet read.
  std::size_t left() const { return text_.size() - position_; }

  /// Skips blanks; true if nothing follows.
  bool at_end();
  /// Next word, empty at the end.
  std::string_view word();
  std::string_view peek_word();
  /// The rest of this line, without its end; the scanner then stands behind it.
  std::string_view line();
  std::string_view bytes(std::size_t count, const char* what);

  std::int64_t integer(const char* what);
  double real(const char* what);
  /// A count of things that take at least `least_bytes` each in what is left of the file: no file can make us allocate
  /// more than a small multiple of its size.
  std::size_t count(const char* what, std::size_t least_bytes);
  std::size_t checked_count(std::int64_t claimed, const char* what, std::size_t least_bytes);
  template <class Number>
  Number raw(const char* what) {
    return load_raw<Number>(bytes(sizeof(Number), what));
  }

  /// Skips to behind the next `mark`; false, and no move, if there is none.
  bool skip_past(std::string_view mark);

  /// Line of the last word or number read.
  std::size_t line_number() const;
  /// Fails at the last word or number read, naming its line.
  [[noreturn]] void fail(const std::string& reason) const;
  /// The same naming its byte, for binary data.
  [[noreturn]] void fail_byte(const std::string& reason) const;

 private:
  void skip_blanks();
  [[noreturn]] void fail_expected(const char* what, std::string_view found) const;

  std::string_view text_;
  const std::string& name_;
  char comment_;
  std::size_t position_ = 0;
  std::size_t last_ = 0;  // Where the last word or number began.
};

}  // namespace tetsoup
