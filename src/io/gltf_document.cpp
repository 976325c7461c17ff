// The container, the JSON and its extensions. tinygltf 2.7 reads up to 8 bytes beyond a GLB whose last chunk lies about
// its length, follows URIs outside the folder and recurses into any nesting, so it only ever sees JSON that has been
// checked here and cut down to geometry; container and buffers are ours.
#include "io/gltf_document.h"

#include <algorithm>
#include <limits>

#include "io/gltf_extensions.h"
#include "io/load_bytes.h"

namespace tetsoup::readers::gltf {
namespace {

using nlohmann::json;

struct Container {
  std::string_view text;
  std::size_t text_offset = 0;
  std::optional<std::span<const std::byte>> binary;
};

std::string_view as_text(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

Container open_glb(const Source& source) {
  constexpr std::size_t kFileHeader = 12, kChunkHeader = 8;
  constexpr std::uint32_t kJson = 0x4E4F534A, kBinary = 0x004E4942;
  const auto bytes = source.bytes;
  if (bytes.size() < kFileHeader + kChunkHeader) fail_at_byte(source.name, bytes.size(), "the file ends in its header");
  const auto word = [&](std::size_t at) { return load<std::uint32_t>(bytes.data() + at); };
  if (word(4) != 2) fail_at_byte(source.name, 4, "glTF version " + std::to_string(word(4)) + " is not supported");
  const std::size_t length = word(8);
  if (length > bytes.size()) {
    fail_at_byte(source.name, 8,
                 "the header promises " + std::to_string(length) + " bytes, there are " + std::to_string(bytes.size()));
  }
  Container container;
  for (std::size_t at = kFileHeader; at + kChunkHeader <= length;) {
    const std::size_t size = word(at), begin = at + kChunkHeader;
    if (size > length - begin) fail_at_byte(source.name, at, "a chunk reaches beyond the file's end");
    if (at == kFileHeader && word(at + 4) != kJson) fail_at_byte(source.name, at + 4, "the first chunk is not JSON");
    if (at == kFileHeader) {
      container.text = as_text(bytes.subspan(begin, size));
      container.text_offset = begin;
    } else if (word(at + 4) == kBinary && !container.binary) {
      container.binary = bytes.subspan(begin, size);
    }
    at = begin + size;
  }
  return container;
}

[[noreturn]] void fail_in_json(const Source& source, const Container& container, std::size_t offset,
                               const std::string& what) {
  if (container.text_offset > 0) fail_at_byte(source.name, container.text_offset + offset, what);
  const auto end = container.text.begin() + static_cast<std::ptrdiff_t>(std::min(offset, container.text.size()));
  const auto lines = std::count(container.text.begin(), end, '\n');
  fail_at_line(source.name, static_cast<std::size_t>(lines) + 1, what);
}

/// Before any parser allocates or recurses.
void check_nesting(const Source& source, const Container& container) {
  constexpr std::size_t kDeepest = 64;            // glTF itself needs 8
  constexpr std::size_t kMostValues = 4'000'000;  // each takes up to 0.2 KB once parsed; bulk data belongs in buffers
  std::size_t depth = 0, values = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < container.text.size(); ++i) {
    const char c = container.text[i];
    if (in_string) {
      if (c == '\\') ++i;
      in_string = c != '"';
    } else if (c == '"') {
      in_string = true;
    } else if (c == '{' || c == '[') {
      if (++depth > kDeepest) fail_in_json(source, container, i, "nested too deeply for glTF");
      ++values;
    } else if (c == '}' || c == ']') {
      depth -= depth > 0;
    } else if (c == ',') {
      ++values;
    }
    if (values > kMostValues) fail_in_json(source, container, i, "more than 4 million values in its JSON part");
  }
}

json parse_json(const Source& source, const Container& container) {
  constexpr std::size_t kLongestShown = 160;  // characters of the parser's message, which quotes the file
  check_nesting(source, container);
  try {
    json root = json::parse(container.text.begin(), container.text.end());
    if (!root.is_object()) fail_in_json(source, container, 0, "not glTF: its JSON is no object");
    return root;
  } catch (const json::parse_error& error) {
    const std::string what = error.what();
    const std::size_t begin = what.find("] ");
    fail_in_json(source, container, error.byte > 0 ? error.byte - 1 : 0,
                 "not valid JSON: " + what.substr(begin == std::string::npos ? 0 : begin + 2, kLongestShown));
  } catch (const json::exception& error) {
    fail_in_json(source, container, 0, std::string("not valid JSON: ") + error.what());
  }
}

void check_version(const Source& source, const json& root) {
  const auto asset = root.find("asset");
  if (asset == root.end() || !asset->is_object()) fail(source.name, "not glTF: 'asset' is missing");
  const auto version = asset->find("version");
  if (version == asset->end() || !version->is_string()) fail(source.name, "not glTF: 'asset.version' is missing");
  if (!version->get_ref<const std::string&>().starts_with("2")) {
    fail(source.name, "only glTF 2 is supported, not " + version->get_ref<const std::string&>().substr(0, 16));
  }
}

/// Resolves all buffers; each external file is read once.
class BufferLoader {
 public:
  BufferLoader(const std::optional<std::filesystem::path>& folder, std::optional<std::span<const std::byte>> binary,
               Document& document)
      : folder_(folder), binary_(binary), document_(document) {}

  void load_all(const json& root) {
    const auto list = root.find("buffers");
    if (list == root.end() || !list->is_array()) return;
    for (const json& buffer : *list) {
      const std::string where = document_.name + ": buffer " + std::to_string(document_.buffers.size());
      const auto length = buffer.is_object() ? buffer.find("byteLength") : buffer.end();
      if (length == buffer.end() || !length->is_number_unsigned()) fail(where, "'byteLength' is missing or no number");
      if (is_promise(buffer)) {
        document_.buffers.emplace_back();
        continue;
      }
      const auto bytes = find_bytes(buffer, where);
      if (length->get<std::uint64_t>() > bytes.size()) {
        fail(where, "promises " + std::to_string(length->get<std::uint64_t>()) + " bytes, there are " +
                        std::to_string(bytes.size()));
      }
      document_.buffers.push_back(bytes.first(length->get<std::size_t>()));
    }
  }

 private:
  std::span<const std::byte> find_bytes(const json& buffer, const std::string& where) {
    const auto uri = buffer.find("uri");
    if (uri == buffer.end()) {
      if (!binary_) fail(where, "has no 'uri', and the file has no binary part");
      return *binary_;
    }
    if (!uri->is_string()) fail(where, "'uri' is no text");
    const auto& text = uri->get_ref<const std::string&>();
    if (text.starts_with("data:")) return document_.owned.emplace_back(read_data_uri(where, text));
    if (!folder_) fail(where, "lies in another file, which is not followed from memory");
    const std::filesystem::path path = resolve_file_uri(where, text, *folder_);
    if (const auto known = files_.find(path); known != files_.end()) return known->second;
    const auto& bytes = document_.owned.emplace_back(read_whole_file(path));
    document_.file_bytes += bytes.size();
    return files_[path] = bytes;
  }

  const std::optional<std::filesystem::path>& folder_;
  std::optional<std::span<const std::byte>> binary_;
  Document& document_;
  std::map<std::filesystem::path, std::span<const std::byte>> files_;
};

std::vector<std::string> names_of(json& root, const char* key) {
  std::vector<std::string> names;
  const auto list = root.find(key);
  if (list == root.end() || !list->is_array()) return names;
  names.reserve(list->size());
  for (json& object : *list) {
    std::string& name = names.emplace_back();
    if (!object.is_object()) continue;
    const auto found = object.find("name");
    if (found != object.end() && found->is_string()) name = std::move(found->get_ref<std::string&>());
  }
  return names;
}

/// Geometry only, without the parts of unlimited shape.
json reduced_to_geometry(json& root) {
  json reduced = json::object();
  for (const char* key : {"scene", "scenes", "nodes", "skins", "meshes", "accessors", "bufferViews"}) {
    const auto found = root.find(key);
    if (found == root.end()) continue;
    json& part = reduced[key] = std::move(*found);
    if (!part.is_array()) continue;
    for (json& object : part) {
      if (!object.is_object()) continue;
      for (const char* extra : {"extras", "extensions", "name", "weights"}) object.erase(extra);
      const auto primitives = object.find("primitives");
      if (primitives == object.end() || !primitives->is_array()) continue;
      for (json& primitive : *primitives) {
        if (!primitive.is_object()) continue;
        for (const char* extra : {"extras", "extensions", "targets"}) primitive.erase(extra);
      }
    }
  }
  return reduced;
}

/// tinygltf's structs are some 0.5 KB each, while "{}," takes three bytes: as many as that have nothing to say.
void check_object_count(const Source& source, const json& reduced, std::size_t text_bytes) {
  constexpr std::size_t kShortestObject = 8;  // bytes on average; a node that shows a mesh takes 11
  std::size_t objects = 0;
  for (const json& part : reduced) {
    if (!part.is_array()) continue;
    objects += part.size();
    for (const json& object : part) {
      const auto primitives = object.is_object() ? object.find("primitives") : object.end();
      if (primitives != object.end()) objects += primitives->size();
    }
  }
  if (objects > text_bytes / kShortestObject) fail(source.name, "most of its nodes, meshes or accessors are empty");
}

void load_model(const Source& source, const json& reduced, tinygltf::Model& model) {
  const std::string text = reduced.dump(-1, ' ', false, json::error_handler_t::replace);
  if (text.size() > std::numeric_limits<unsigned>::max()) fail(source.name, "its JSON part is too large");
  std::string error, warning;
  bool ok = false;
  try {
    tinygltf::TinyGLTF loader;
    ok = loader.LoadASCIIFromString(&model, &error, &warning, text.c_str(), static_cast<unsigned>(text.size()), "",
                                    tinygltf::NO_REQUIRE);
  } catch (const std::exception& exception) {
    error = exception.what();
  }
  if (ok) return;
  std::replace(error.begin(), error.end(), '\n', ' ');
  fail(source.name, "not valid glTF: " + error);
}

}  // namespace

Document read_document(const Source& source, const std::optional<std::filesystem::path>& folder) {
  const bool is_glb = as_text(source.bytes).starts_with("glTF");
  const Container container = is_glb ? open_glb(source) : Container{as_text(source.bytes), 0, {}};
  json root = parse_json(source, container);
  check_version(source, root);
  check_extensions(source, root);
  Document document;
  document.name = source.name;
  document.file_bytes = source.bytes.size();
  document.instancing = instancing_of(root);
  const std::vector<PackedView> views = packed_views(document.name, root);
  const std::vector<PackedPrimitive> primitives = take_packed_primitives(document.name, root);
  BufferLoader(folder, container.binary, document).load_all(root);
  document.node_names = names_of(root, "nodes");
  document.mesh_names = names_of(root, "meshes");
  document.material_names = names_of(root, "materials");
  const json reduced = reduced_to_geometry(root);
  check_object_count(source, reduced, container.text.size());
  load_model(source, reduced, document.model);
  unpack_views(document, views);
  unpack_primitives(document, primitives);
  return document;
}

}  // namespace tetsoup::readers::gltf
