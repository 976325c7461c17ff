// The two halves of a .glb: what JSON says of numbers, and their bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "tetsoup/render_mesh.h"
#include "tetsoup/types.h"

namespace tetsoup::animation {

class GlbBuilder {
 public:
  GlbBuilder();

  nlohmann::json root;

  /// Appends to one of the root's lists.
  /// @return  Its index there.
  std::size_t add(const char* list, nlohmann::json object);

  // Accessors; each gives its index.
  std::size_t add_indices(std::span<const std::uint32_t> indices);
  std::size_t add_positions(std::span<const Vec3> positions);
  std::size_t add_vectors(std::span<const Vec3> vectors);
  std::size_t add_texcoords(std::span<const Vec2> texcoords);
  /// Of an animation: `width` floats an element, 1 to 4.
  std::size_t add_samples(std::span<const float> values, std::size_t width);
  std::size_t add_times(std::span<const float> times);

  /// @throws IoError  also beyond the 4 GB that the format can tell.
  void write(const std::filesystem::path& path);

 private:
  std::size_t add_accessor(const char* type, int component, std::size_t count, std::string_view bytes, int target);

  std::string binary_;
};

}  // namespace tetsoup::animation
