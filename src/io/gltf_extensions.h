// The extensions of glTF that change geometry: what the description says of them, before it is cut down to what
// tinygltf is to see.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/gltf_document.h"

namespace tetsoup::readers::gltf {

/// A bufferView packed by EXT_meshopt_compression.
struct PackedView {
  std::size_t view = 0, buffer = 0, offset = 0, length = 0;  ///< Where the packed bytes lie, in bytes.
  std::size_t count = 0, stride = 0;                         ///< Elements once unpacked, and bytes of each.
  std::string mode, filter;
};

/// A primitive that only KHR_draco_mesh_compression tells of: no other copy of its numbers is there.
struct PackedPrimitive {
  std::size_t mesh = 0, primitive = 0, view = 0;
  std::map<std::string, std::uint32_t> attributes;  ///< Ids within the packed bytes.
};

/// @throws IoError  A required extension that is not known is used by nodes, meshes, accessors or buffers. Extensions
/// of
///         materials, pictures, lights and the like do no harm, whatever they are called.
void check_extensions(const Source& source, const nlohmann::json& root);

std::map<int, Instancing> instancing_of(const nlohmann::json& root);

/// Those views that have no other bytes: where a buffer is a mere promise, or compression is required.
std::vector<PackedView> packed_views(const std::string& name, const nlohmann::json& root);

/// Takes the packed attributes and indices out of the primitives, which have no accessors that can be read.
std::vector<PackedPrimitive> take_packed_primitives(const std::string& name, nlohmann::json& root);

/// A buffer that holds nothing, in whose place packed views are.
bool is_promise(const nlohmann::json& buffer);

/// Unpack into buffers of the document's own, so that its accessors read from there.
void unpack_views(Document& document, const std::vector<PackedView>& views);
void unpack_primitives(Document& document, const std::vector<PackedPrimitive>& primitives);

}  // namespace tetsoup::readers::gltf
