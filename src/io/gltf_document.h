// A glTF file as far as geometry goes: the description in tinygltf's structs, the buffers as bytes.
#pragma once

#include <tiny_gltf.h>

#include <deque>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "io/soup_readers.h"

namespace tetsoup::readers::gltf {

/// Accessors that say where copies of a node's mesh stand (EXT_mesh_gpu_instancing); -1: none.
struct Instancing {
  int translation = -1, rotation = -1, scale = -1;
};

struct Document {
  std::string name;
  std::size_t file_bytes = 0;  ///< External buffers included.
  tinygltf::Model model;       ///< Scenes, nodes, skins, meshes, accessors, buffer views; nothing else is filled in.
  std::map<int, Instancing> instancing;                             ///< Of nodes.
  std::vector<std::string> node_names, mesh_names, material_names;  ///< Empty where there is none.
  std::vector<std::span<const std::byte>> buffers;                  ///< Into the source or into `owned`.
  std::deque<std::vector<std::byte>> owned;
};

/// @param folder  External buffers must lie below it; none: they are refused.
Document read_document(const Source& source, const std::optional<std::filesystem::path>& folder);

/// Elements that an accessor promises, and
/// all numbers of an accessor, normalised ones as floats, sparse ones put in place; each range checked against the
/// bytes that are there. `type` is what its numbers must form (TINYGLTF_TYPE_...).
std::size_t accessor_count(const Document& document, int accessor);
std::vector<double> read_accessor(const Document& document, int accessor, int type);

/// Bytes of one buffer: a data URI, or a file below `folder`.
std::vector<std::byte> read_data_uri(const std::string& where, std::string_view uri);
std::filesystem::path resolve_file_uri(const std::string& where, const std::string& uri,
                                       const std::filesystem::path& folder);

}  // namespace tetsoup::readers::gltf
