// Which files an animation has written, and the names of those of a series.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>

#include "tetsoup/animation.h"

namespace tetsoup::animation {

/// Writes files whole or not at all, and notes them and their sizes.
class FileLog {
 public:
  void write(const std::filesystem::path& path, std::string_view bytes);
  /// Of a file that somebody else has written.
  void note(const std::filesystem::path& path);

  AnimationReport report;

 private:
  std::map<std::filesystem::path, std::uint64_t> sizes_;
};

/// "stem_0012.ext" beside `path`.
std::filesystem::path numbered(const std::filesystem::path& path, const std::string& stem, std::size_t number,
                               const std::string& extension);

}  // namespace tetsoup::animation
