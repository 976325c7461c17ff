// What the readers of triangle soups share: where bytes come from, how they fail, how polygons become triangles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tetsoup/types.h"

namespace tetsoup::readers {

struct Source {
  std::span<const std::byte> bytes;
  std::string_view name;  ///< As errors call it.
};

[[noreturn]] void fail(std::string_view name, const std::string& what);
[[noreturn]] void fail_at_line(std::string_view name, std::size_t line, const std::string& what);
[[noreturn]] void fail_at_byte(std::string_view name, std::size_t byte, const std::string& what);

/// 'text', as errors show names.
inline std::string in_quotes(std::string_view text) {
  std::string result = "'";
  result.append(text).push_back('\'');
  return result;
}

/// The whole file, in one go. Throws IoError with the system's reason, or if the file is empty.
std::vector<std::byte> read_whole_file(const std::filesystem::path& path);

TriangleSoup read_obj(const Source& source);
TriangleSoup read_stl(const Source& source);
TriangleSoup read_ply(const Source& source);
TriangleSoup read_off(const Source& source);
/// `folder`: where external buffers may lie; none: they are refused.
TriangleSoup read_gltf(const Source& source, const std::optional<std::filesystem::path>& folder);

/// True if the bytes can be nothing but an STL file, by their text or by their exact size.
bool is_stl(std::span<const std::byte> bytes);
/// True if the text starts with one of OFF's header words.
bool is_off(std::span<const std::byte> bytes);

/// The index that no soup has a vertex for: what cannot be an index becomes this, and clean_soup() counts it.
inline constexpr std::uint32_t kNoVertex = 0xffffffff;

/// Zero-based index as the file has it, or kNoVertex where a 32-bit index cannot say it.
inline std::uint32_t vertex_index(std::int64_t index) {
  return index < 0 || index >= kNoVertex ? kNoVertex : static_cast<std::uint32_t>(index);
}
inline std::uint32_t vertex_index(double index) {
  if (!(index >= 0 && index < kNoVertex)) return kNoVertex;
  const auto whole = static_cast<std::uint32_t>(index);
  return static_cast<double>(whole) == index ? whole : kNoVertex;
}

/// Cuts one polygon into a fan while its corners arrive; fewer than three corners leave nothing.
class Fan {
 public:
  explicit Fan(std::vector<Triangle>& triangles) : triangles_(triangles) {}

  void add(std::uint32_t corner) {
    if (corner_count_ == 0) first_ = corner;
    if (corner_count_ >= 2) triangles_.push_back({first_, previous_, corner});
    previous_ = corner;
    ++corner_count_;
  }

 private:
  std::vector<Triangle>& triangles_;
  std::uint32_t first_ = 0, previous_ = 0;
  std::size_t corner_count_ = 0;
};

/// Turns a strip into triangles of one orientation while its corners arrive.
class Strip {
 public:
  explicit Strip(std::vector<Triangle>& triangles) : triangles_(triangles) {}

  void restart() { corner_count_ = 0; }
  void add(std::uint32_t corner) {
    if (corner_count_ >= 2) {
      if (corner_count_ % 2 == 0) {
        triangles_.push_back({older_, previous_, corner});
      } else {
        triangles_.push_back({previous_, older_, corner});
      }
    }
    older_ = previous_;
    previous_ = corner;
    ++corner_count_;
  }

 private:
  std::vector<Triangle>& triangles_;
  std::uint32_t older_ = 0, previous_ = 0;
  std::size_t corner_count_ = 0;
};

}  // namespace tetsoup::readers
