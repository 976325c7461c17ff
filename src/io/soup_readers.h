// What the readers of triangle soups share: where bytes come from, how they fail, what an index may be.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/surface_sinks.h"

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

// One reader a format, for either sink of surface_sinks.h. Geometry that cannot be read is an error; a texture
// coordinate or a normal that cannot is left out, so that a render mesh comes of every file that a soup comes of.
template <class Sink>
void read_obj(const Source& source, Sink& sink);
template <class Sink>
void read_stl(const Source& source, Sink& sink);
template <class Sink>
void read_ply(const Source& source, Sink& sink);
template <class Sink>
void read_off(const Source& source, Sink& sink);
/// `folder`: where external buffers may lie; none: they are refused.
template <class Sink>
void read_gltf(const Source& source, const std::optional<std::filesystem::path>& folder, Sink& sink);

template <class Sink>
void read_3mf(const Source& source, Sink& sink);
template <class Sink>
void read_collada(const Source& source, Sink& sink);

/// True if the text is XML whose outermost element is Collada's.
bool is_collada(std::span<const std::byte> bytes);
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

}  // namespace tetsoup::readers
