// The slow path of the scanner: saying what was found instead.
#include "io/text_scanner.h"

namespace tetsoup::readers {

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
