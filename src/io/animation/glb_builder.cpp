#include "io/animation/glb_builder.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string_view>
#include <utility>

#include "io/atomic_file.h"
#include "io/raw_numbers.h"
#include "tetsoup/error.h"

namespace tetsoup::animation {
namespace {

using json = nlohmann::json;

constexpr int kFloat = 5126, kUnsignedInt = 5125;                  // Component types.
constexpr int kNoTarget = 0, kVertices = 34962, kIndices = 34963;  // What a buffer view is for.

template <class T>
std::string_view bytes_of(std::span<const T> values) {
  return {reinterpret_cast<const char*>(values.data()), values.size_bytes()};
}

}  // namespace

GlbBuilder::GlbBuilder() : root{{"asset", {{"version", "2.0"}, {"generator", "tetsoup"}}}} {}

std::size_t GlbBuilder::add(const char* list, json object) {
  json& entries = root[list];
  entries.push_back(std::move(object));
  return entries.size() - 1;
}

std::size_t GlbBuilder::add_accessor(const char* type, int component, std::size_t count, std::string_view bytes,
                                     int target) {
  json view{{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", bytes.size()}};
  if (target != kNoTarget) view["target"] = target;
  binary_ += bytes;
  return add("accessors", {{"bufferView", add("bufferViews", std::move(view))},
                           {"componentType", component},
                           {"count", count},
                           {"type", type}});
}

std::size_t GlbBuilder::add_indices(std::span<const std::uint32_t> indices) {
  return add_accessor("SCALAR", kUnsignedInt, indices.size(), bytes_of(indices), kIndices);
}

std::size_t GlbBuilder::add_vectors(std::span<const Vec3> vectors) {
  return add_accessor("VEC3", kFloat, vectors.size(), bytes_of(vectors), kVertices);
}

std::size_t GlbBuilder::add_positions(std::span<const Vec3> positions) {
  const std::size_t accessor = add_vectors(positions);
  std::array<float, 3> low, high;
  low.fill(std::numeric_limits<float>::max());
  high.fill(std::numeric_limits<float>::lowest());
  for (const Vec3& p : positions) {
    low = {std::min(low[0], p.x), std::min(low[1], p.y), std::min(low[2], p.z)};
    high = {std::max(high[0], p.x), std::max(high[1], p.y), std::max(high[2], p.z)};
  }
  root["accessors"][accessor]["min"] = low;
  root["accessors"][accessor]["max"] = high;
  return accessor;
}

std::size_t GlbBuilder::add_texcoords(std::span<const Vec2> texcoords) {
  return add_accessor("VEC2", kFloat, texcoords.size(), bytes_of(texcoords), kVertices);
}

std::size_t GlbBuilder::add_samples(std::span<const float> values, std::size_t width) {
  constexpr std::array<const char*, 5> kTypes{"", "SCALAR", "VEC2", "VEC3", "VEC4"};
  return add_accessor(kTypes[width], kFloat, values.size() / width, bytes_of(values), kNoTarget);
}

std::size_t GlbBuilder::add_times(std::span<const float> times) {
  const std::size_t accessor = add_samples(times, 1);
  root["accessors"][accessor]["min"] = {times.front()};
  root["accessors"][accessor]["max"] = {times.back()};
  return accessor;
}

void GlbBuilder::write(const std::filesystem::path& path) {
  if (!binary_.empty()) root["buffers"] = {{{"byteLength", binary_.size()}}};
  // Names may come from files in any encoding.
  std::string text = root.dump(-1, ' ', false, json::error_handler_t::replace);
  text.resize((text.size() + 3) / 4 * 4, ' ');  // Chunks end at whole words; all arrays do already.
  constexpr std::size_t kHeaders = 12 + 8 + 8;
  const std::size_t total = kHeaders + text.size() + binary_.size();
  if (total > std::numeric_limits<std::uint32_t>::max())
    throw IoError("cannot write '" + path.string() + "': it would have " + std::to_string(total) +
                  " bytes, more than a .glb can have");
  const auto word = [](std::string& bytes, std::size_t value) { append_raw(bytes, static_cast<std::uint32_t>(value)); };
  std::string head = "glTF";
  word(head, 2);
  word(head, total);
  word(head, text.size());
  head += "JSON" + text;
  word(head, binary_.size());
  head.append("BIN\0", 4);
  AtomicFile file(path);
  file.write(head);
  file.write(binary_);
  file.commit();
}

}  // namespace tetsoup::animation
