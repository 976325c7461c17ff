#include "io/gltf_extensions.h"

#include <algorithm>
#include <array>
#include <optional>
#include <set>

namespace tetsoup::readers::gltf {
namespace {

using nlohmann::json;

constexpr const char* kMeshopt = "EXT_meshopt_compression";
constexpr const char* kDraco = "KHR_draco_mesh_compression";

/// An entry that is there and an object, or null.
const json* object_in(const json& parent, const char* key) {
  if (!parent.is_object()) return nullptr;
  const auto found = parent.find(key);
  return found != parent.end() && found->is_object() ? &*found : nullptr;
}

const json* extension_of(const json& object, const char* extension) {
  const json* const extensions = object_in(object, "extensions");
  return extensions ? object_in(*extensions, extension) : nullptr;
}

/// Null: it is no array.
const json* array_in(const json& parent, const char* key) {
  if (!parent.is_object()) return nullptr;
  const auto found = parent.find(key);
  return found != parent.end() && found->is_array() ? &*found : nullptr;
}

/// A whole number that is not negative.
std::optional<std::size_t> whole_in(const json& object, const char* key) {
  if (!object.is_object()) return {};
  const auto found = object.find(key);
  if (found == object.end() || !found->is_number_unsigned()) return {};
  return found->get<std::size_t>();
}

std::string text_in(const json& object, const char* key, const char* otherwise) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : otherwise;
}

void add_names(const json& object, std::set<std::string>& names) {
  const json* const extensions = object_in(object, "extensions");
  if (!extensions) return;
  for (const auto& [name, content] : extensions->items()) names.insert(name);
}

/// Names of the extensions that stand where geometry is described.
std::set<std::string> extensions_of_geometry(const json& root) {
  std::set<std::string> names;
  for (const char* key : {"nodes", "meshes", "accessors", "bufferViews", "buffers"}) {
    const json* const list = array_in(root, key);
    if (!list) continue;
    for (const json& object : *list) {
      add_names(object, names);
      const json* const primitives = array_in(object, "primitives");
      if (!primitives) continue;
      for (const json& primitive : *primitives) add_names(primitive, names);
    }
  }
  return names;
}

bool has_bytes(const json& root, const json& accessor_index) {
  const json* const accessors = array_in(root, "accessors");
  if (!accessors || !accessor_index.is_number_unsigned()) return false;
  const auto i = accessor_index.get<std::size_t>();
  return i < accessors->size() && (whole_in((*accessors)[i], "bufferView") || object_in((*accessors)[i], "sparse"));
}

/// All of the attributes that are packed, and the indices, are there unpacked too.
bool has_other_copy(const json& root, const json& primitive, const json& packed) {
  const auto indices = primitive.find("indices");
  if (indices != primitive.end() && !has_bytes(root, *indices)) return false;
  const json* const attributes = object_in(primitive, "attributes");
  if (!attributes) return false;
  for (const auto& [name, id] : packed.items()) {
    const auto accessor = attributes->find(name);
    if (accessor == attributes->end() || !has_bytes(root, *accessor)) return false;
  }
  return true;
}

}  // namespace

void check_extensions(const Source& source, const json& root) {
  constexpr std::array<std::string_view, 12> kHarmless = {"KHR_mesh_quantization",
                                                          "EXT_mesh_gpu_instancing",
                                                          kMeshopt,
                                                          kDraco,
                                                          "KHR_materials_",
                                                          "KHR_texture_",
                                                          "EXT_texture_",
                                                          "KHR_lights_",
                                                          "MSFT_texture_",
                                                          "KHR_xmp",
                                                          "KHR_animation_",
                                                          "KHR_node_visibility"};
  const json* const required = array_in(root, "extensionsRequired");
  if (!required) return;
  const std::set<std::string> used = extensions_of_geometry(root);
  for (const json& entry : *required) {
    if (!entry.is_string()) continue;
    const auto& extension = entry.get_ref<const std::string&>();
    const bool harmless = std::any_of(kHarmless.begin(), kHarmless.end(),
                                      [&](std::string_view prefix) { return extension.starts_with(prefix); });
    if (harmless || used.count(extension) == 0) continue;
    const bool compression = extension.find("compression") != std::string::npos;
    fail(source.name, "uses " + extension.substr(0, 64) + ", which is not supported" +
                          (compression ? ": export without compression" : ""));
  }
}

std::map<int, Instancing> instancing_of(const json& root) {
  std::map<int, Instancing> result;
  const json* const nodes = array_in(root, "nodes");
  for (std::size_t i = 0; nodes && i < nodes->size(); ++i) {
    const json* const extension = extension_of((*nodes)[i], "EXT_mesh_gpu_instancing");
    const json* const attributes = extension ? object_in(*extension, "attributes") : nullptr;
    if (!attributes) continue;
    const auto accessor = [&](const char* name) {
      const auto index = whole_in(*attributes, name);
      return index ? static_cast<int>(std::min<std::size_t>(*index, 0x7fffffff)) : -1;
    };
    result[static_cast<int>(i)] = {accessor("TRANSLATION"), accessor("ROTATION"), accessor("SCALE")};
  }
  return result;
}

bool is_promise(const json& buffer) {
  return buffer.is_object() && buffer.find("uri") == buffer.end() && extension_of(buffer, kMeshopt);
}

std::vector<PackedView> packed_views(const std::string& name, const json& root) {
  std::vector<PackedView> packed;
  const json* const views = array_in(root, "bufferViews");
  const json* const buffers = array_in(root, "buffers");
  for (std::size_t i = 0; views && i < views->size(); ++i) {
    const json* const extension = extension_of((*views)[i], kMeshopt);
    if (!extension) continue;
    const auto own = whole_in((*views)[i], "buffer");
    if (own && buffers && *own < buffers->size() && !is_promise((*buffers)[*own])) continue;
    const auto number = [&](const char* key, std::optional<std::size_t> otherwise = {}) {
      const auto found = whole_in(*extension, key);
      if (!found && !otherwise)
        fail(name, "bufferView " + std::to_string(i) + ": its " + kMeshopt + " has no number '" + key + "'");
      return found ? *found : *otherwise;
    };
    packed.push_back({i, number("buffer"), number("byteOffset", 0), number("byteLength"), number("count"),
                      number("byteStride"), text_in(*extension, "mode", ""), text_in(*extension, "filter", "NONE")});
  }
  return packed;
}

std::vector<PackedPrimitive> take_packed_primitives(const std::string& name, json& root) {
  std::vector<PackedPrimitive> taken;
  const auto meshes = root.find("meshes");
  if (meshes == root.end() || !meshes->is_array()) return taken;
  for (std::size_t m = 0; m < meshes->size(); ++m) {
    if (!array_in((*meshes)[m], "primitives")) continue;
    json& primitives = (*meshes)[m]["primitives"];
    for (std::size_t p = 0; p < primitives.size(); ++p) {
      const json* const extension = extension_of(primitives[p], kDraco);
      const json* const attributes = extension ? object_in(*extension, "attributes") : nullptr;
      if (!attributes || has_other_copy(root, primitives[p], *attributes)) continue;
      const auto view = whole_in(*extension, "bufferView");
      if (!view) fail(name, "mesh " + std::to_string(m) + ": its " + kDraco + " has no number 'bufferView'");
      PackedPrimitive packed{m, p, *view, {}};
      for (const auto& [attribute, id] : attributes->items()) {
        if (!id.is_number_unsigned()) continue;
        packed.attributes[attribute] = id.get<std::uint32_t>();
        if (object_in(primitives[p], "attributes")) primitives[p]["attributes"].erase(attribute);
      }
      primitives[p].erase("indices");
      taken.push_back(std::move(packed));
    }
  }
  return taken;
}

}  // namespace tetsoup::readers::gltf
