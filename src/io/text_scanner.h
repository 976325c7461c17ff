// A cursor over text that counts lines and never leaves its bytes. Lines end in \n, \r\n or \r.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "io/parse_number.h"
#include "io/soup_readers.h"

namespace tetsoup::readers {

class TextScanner {
 public:
  explicit TextScanner(const Source& source, std::size_t offset = 0, std::size_t line = 1)
      : name_(source.name),
        begin_(reinterpret_cast<const char*>(source.bytes.data())),
        at_(begin_ + offset),
        end_(begin_ + source.bytes.size()),
        line_(line) {
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    if (offset == 0 && rest().starts_with(kByteOrderMark)) at_ += kByteOrderMark.size();
  }

  bool at_end() const { return at_ == end_; }
  bool at_line_end() const { return at_ == end_ || is_line_end(*at_); }
  bool at(char c) const { return at_ != end_ && *at_ == c; }
  std::size_t offset() const { return static_cast<std::size_t>(at_ - begin_); }
  std::size_t bytes_left() const { return static_cast<std::size_t>(end_ - at_); }
  std::size_t line() const { return line_; }
  std::string_view rest() const { return {at_, bytes_left()}; }

  /// To the next word of this line; a backslash at a line's end continues the line.
  void skip_blanks() {
    for (; at_ != end_; ++at_) {
      if (is_blank(*at_)) continue;
      if (!at_continuation()) return;
      ++at_;
      take_line_end();
      --at_;
    }
  }

  /// To the next word, on this line or a later one.
  void skip_space() {
    while (at_ != end_) {
      if (is_blank(*at_)) {
        ++at_;
      } else if (is_line_end(*at_)) {
        take_line_end();
      } else {
        return;
      }
    }
  }

  /// The same, and over comments from # to the line's end.
  void skip_space_and_comments() {
    for (skip_space(); at('#'); skip_space()) skip_line();
  }

  /// To the start of the next line.
  void skip_line() {
    while (!at_line_end()) ++at_;
    if (at_ != end_) take_line_end();
  }

  /// The caller has seen these, none of them a line's end.
  void skip_characters(std::size_t count) { at_ += count; }

  bool take(char c) {
    if (!at(c)) return false;
    ++at_;
    return true;
  }

  /// All up to the next blank or line end; may be empty.
  std::string_view word() {
    const char* const begin = at_;
    while (at_ != end_ && !is_blank(*at_) && !is_line_end(*at_)) ++at_;
    return {begin, static_cast<std::size_t>(at_ - begin)};
  }

  /// All up to the line's end, where the cursor does not go.
  std::string_view rest_of_line() const {
    TextScanner ahead = *this;
    while (!ahead.at_line_end()) ++ahead.at_;
    return {at_, static_cast<std::size_t>(ahead.at_ - at_)};
  }

  /// The number at the cursor, as a word of its own.
  double number() {
    double value = 0;
    const char* const begin = at_;
    if (!parse_number(at_, end_, value) || !at_word_end()) fail_at_word(begin, "a number");
    return value;
  }
  std::int64_t integer() {
    const char* const begin = at_;
    const std::int64_t value = leading_integer();
    if (!at_word_end()) fail_at_word(begin, "a whole number");
    return value;
  }
  /// The same, where other characters may follow.
  std::int64_t leading_integer() {
    std::int64_t value = 0;
    if (!parse_integer(at_, end_, value)) fail_at_word(at_, "a whole number");
    return value;
  }

  bool at_word_end() const { return at_ == end_ || is_blank(*at_) || is_line_end(*at_) || at_continuation(); }

  [[noreturn]] void fail(const std::string& what) const { fail_at_line(name_, line_, what); }
  /// "expected `what`, found ..." with the word at the cursor.
  [[noreturn]] void fail_expected(const std::string& what) { fail_at_word(at_, what); }

 private:
  static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }
  static bool is_line_end(char c) { return c == '\n' || c == '\r'; }

  bool at_continuation() const { return *at_ == '\\' && at_ + 1 != end_ && is_line_end(at_[1]); }

  void take_line_end() {
    if (*at_ == '\r' && at_ + 1 != end_ && at_[1] == '\n') ++at_;
    ++at_;
    ++line_;
  }

  [[noreturn]] void fail_at_word(const char* begin, const std::string& what);

  std::string_view name_;
  const char* begin_;
  const char* at_;
  const char* end_;
  std::size_t line_;
};

/// Words of a line with one blank between them.
std::string joined_words(std::string_view line);
/// As many numbers as the line begins with, up to those wanted; the others stay as they are.
void parse_numbers(std::string_view line, std::span<float> numbers);

}  // namespace tetsoup::readers
