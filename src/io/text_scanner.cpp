// The slow paths of the scanner: names, and saying what was found instead.
#include "io/text_scanner.h"

#include <algorithm>

namespace tetsoup::readers {

namespace {

/// The line's first word, which is cut off; empty if there is none.
std::string_view take_word(std::string_view& line) {
  constexpr std::string_view kBlanks = " \t\v\f";
  line.remove_prefix(std::min(line.find_first_not_of(kBlanks), line.size()));
  const std::string_view word = line.substr(0, line.find_first_of(kBlanks));
  line.remove_prefix(word.size());
  return word;
}

}  // namespace

std::string joined_words(std::string_view line) {
  std::string words(take_word(line));
  for (std::string_view word = take_word(line); !word.empty(); word = take_word(line))
    words.append(1, ' ').append(word);
  return words;
}

void parse_numbers(std::string_view line, std::span<float> numbers) {
  for (float& number : numbers) {
    const std::string_view word = take_word(line);
    const char* at = word.data();
    double value = 0;
    if (word.empty() || !parse_number(at, word.data() + word.size(), value)) return;
    if (at != word.data() + word.size()) return;
    number = static_cast<float>(value);
  }
}

void TextScanner::fail_at_word(const char* begin, const std::string& what) {
  constexpr std::size_t kLongestShown = 24;  // characters; enough to recognise the word
  at_ = begin;
  if (at_end()) fail("expected " + what + ", but the file ends");
  if (at_line_end()) fail("expected " + what + ", but the line ends");
  std::string shown(word().substr(0, kLongestShown));
  for (char& c : shown) {
    if (static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) >= 0x7f) c = '?';
  }
  fail("expected " + what + ", found '" + shown + "'");
}

}  // namespace tetsoup::readers
