#include "io/animation/file_log.h"

#include <cstdio>
#include <span>
#include <system_error>

#include "tetsoup/io.h"

namespace tetsoup::animation {

void FileLog::write(const std::filesystem::path& path, std::string_view bytes) {
  write_file_atomic(path, std::as_bytes(std::span(bytes)));
  note(path);
}

void FileLog::note(const std::filesystem::path& path) {
  std::error_code unknown;  // As of a pipe.
  const std::uintmax_t size = std::filesystem::file_size(path, unknown);
  const auto [place, is_new] = sizes_.try_emplace(path, 0);
  if (is_new) report.files.push_back(path);
  report.bytes -= place->second;
  place->second = unknown ? 0 : size;
  report.bytes += place->second;
}

std::filesystem::path numbered(const std::filesystem::path& path, const std::string& stem, std::size_t number,
                               const std::string& extension) {
  char digits[24];
  std::snprintf(digits, sizeof digits, "_%04zu", number);
  return path.parent_path() / (stem + digits + extension);
}

}  // namespace tetsoup::animation
