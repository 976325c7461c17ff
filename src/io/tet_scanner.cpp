#include "io/tet_scanner.h"

#include <algorithm>
#include <charconv>

#include "io/number_text.h"
#include "tetsoup/error.h"

namespace tetsoup {

namespace {

constexpr std::size_t kMaxQuoted = 40;  // Characters of a bad word shown in a message.

bool is_blank(char c) {
  return c == ' ' || (c >= '\t' && c <= '\r');
}

// Words of damaged files may hold anything, terminals should not get it.
std::string quoted(std::string_view word) {
  std::string shown(word.substr(0, kMaxQuoted));
  std::replace_if(
      shown.begin(), shown.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return "'" + shown + (word.size() > kMaxQuoted ? "...'" : "'");
}

}  // namespace

void TetScanner::skip_blanks() {
  while (position_ < text_.size()) {
    const char c = text_[position_];
    if (comment_ != '\0' && c == comment_)
      position_ = std::min(text_.find('\n', position_), text_.size());
    else if (is_blank(c))
      ++position_;
    else
      return;
  }
}

bool TetScanner::at_end() {
  skip_blanks();
  return position_ == text_.size();
}

std::string_view TetScanner::word() {
  skip_blanks();
  last_ = position_;
  while (position_ < text_.size() && !is_blank(text_[position_])) ++position_;
  return text_.substr(last_, position_ - last_);
}

std::string_view TetScanner::peek_word() {
  const std::size_t begin = position_;
  const std::string_view next = word();
  position_ = begin;
  return next;
}

std::string_view TetScanner::line() {
  last_ = position_;
  const std::size_t end = std::min(text_.find('\n', position_), text_.size());
  std::string_view rest = text_.substr(position_, end - position_);
  position_ = std::min(end + 1, text_.size());
  if (rest.ends_with('\r')) rest.remove_suffix(1);
  return rest;
}

std::string_view TetScanner::bytes(std::size_t count, const char* what) {
  last_ = position_;
  if (count > left()) fail_byte("the file ends within " + std::string(what));
  position_ += count;
  return text_.substr(last_, count);
}

std::int64_t TetScanner::integer(const char* what) {
  const std::string_view found = word(), digits = without_plus(found);
  std::int64_t value = 0;
  const char* end = digits.data() + digits.size();
  const auto result = std::from_chars(digits.data(), end, value);
  if (result.ec != std::errc() || result.ptr != end) fail_expected(what, found);
  return value;
}

double TetScanner::real(const char* what) {
  const std::string_view found = word();
  double value = 0;
  if (!parse_real(found, value)) fail_expected(what, found);
  return value;
}

std::size_t TetScanner::count(const char* what, std::size_t least_bytes) {
  return checked_count(integer(what), what, least_bytes);
}

std::size_t TetScanner::checked_count(std::int64_t claimed, const char* what, std::size_t least_bytes) {
  // Two numbers take three characters, so the last one's missing blank is forgiven.
  if (claimed < 0 || static_cast<std::uint64_t>(claimed) > (left() + 1) / least_bytes)
    fail("the " + std::string(what) + " is " + std::to_string(claimed) + ", but only " + std::to_string(left()) +
         " bytes follow");
  return static_cast<std::size_t>(claimed);
}

bool TetScanner::skip_past(std::string_view mark) {
  const std::size_t found = text_.find(mark, position_);
  if (found == text_.npos) return false;
  position_ = found + mark.size();
  return true;
}

std::size_t TetScanner::line_number() const {
  const auto end = text_.begin() + static_cast<std::ptrdiff_t>(std::min(last_, text_.size()));
  return 1 + static_cast<std::size_t>(std::count(text_.begin(), end, '\n'));
}

void TetScanner::fail(const std::string& reason) const {
  throw IoError(name_ + ": line " + std::to_string(line_number()) + ": " + reason);
}

void TetScanner::fail_byte(const std::string& reason) const {
  throw IoError(name_ + ": byte " + std::to_string(last_) + ": " + reason);
}

void TetScanner::fail_expected(const char* what, std::string_view found) const {
  if (found.empty()) fail("the file ends where the " + std::string(what) + " should be");
  fail("expected the " + std::string(what) + ", found " + quoted(found));
}

}  // namespace tetsoup
