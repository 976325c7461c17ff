// What the fuzz targets share. Each defines fuzz_one(): anything but what it promises to do with any bytes is a
// finding. With libFuzzer it is run on bytes that seek new paths, without it on the files of tests/fuzz/corpus
// (main.cpp).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <unistd.h>
#include <utility>

namespace tetsoup::fuzz {

using Bytes = std::span<const std::uint8_t>;

/// Defined by each target.
void fuzz_one(Bytes bytes);

/// A finding.
inline void expect(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "does not hold: %s\n", what);
  std::abort();
}

inline std::string_view text_of(Bytes bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// Choices taken from the front of the bytes; zeros once they are used up.
class Choices {
 public:
  explicit Choices(Bytes bytes) : rest_(bytes) {}
  bool are_left() const { return !rest_.empty(); }
  Bytes rest() const { return rest_; }

  template <class Number>
  Number take() {
    static_assert(std::is_arithmetic_v<Number>);
    Number value{};
    const std::size_t count = std::min(sizeof(Number), rest_.size());
    if (count > 0) std::memcpy(&value, rest_.data(), count);
    rest_ = rest_.subspan(count);
    return value;
  }
  /// 0 to count - 1.
  unsigned below(unsigned count) { return take<std::uint8_t>() % count; }
  /// In [low, high], in 255 steps.
  double between(double low, double high) { return low + (high - low) * take<std::uint8_t>() / 255.0; }
  std::string_view text() {
    const std::size_t count = std::min<std::size_t>(take<std::uint8_t>(), rest_.size());
    const std::string_view text = text_of(rest_.first(count));
    rest_ = rest_.subspan(count);
    return text;
  }
  /// Two files in one: up to the first 0xff that follows a 0x00, and behind it.
  std::pair<Bytes, Bytes> halves() const {
    for (std::size_t i = 0; i + 1 < rest_.size(); ++i)
      if (rest_[i] == 0 && rest_[i + 1] == 0xff) return {rest_.first(i), rest_.subspan(i + 2)};
    return {rest_, {}};
  }

 private:
  Bytes rest_;
};

/// A folder of this process, removed when it ends well.
inline const std::filesystem::path& own_folder() {
  struct Folder {
    std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("tetsoup-fuzz-" + std::to_string(::getpid()));
    Folder() { std::filesystem::create_directories(path); }
    ~Folder() {
      std::error_code ignored;
      std::filesystem::remove_all(path, ignored);
    }
  };
  static const Folder folder;
  return folder.path;
}

}  // namespace tetsoup::fuzz
