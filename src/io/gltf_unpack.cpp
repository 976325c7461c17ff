// Packed geometry, by the libraries of those who made the packing, where this build has them.
#include "io/gltf_extensions.h"

#ifdef TETSOUP_WITH_MESHOPT
#include <meshoptimizer.h>
#endif
#ifdef TETSOUP_WITH_DRACO
#include <draco/compression/decode.h>
#endif

namespace tetsoup::readers::gltf {
namespace {

/// The bytes of a view as it stands in the file.
[[maybe_unused]] std::span<const std::byte> bytes_of(const Document& document, const std::string& where,
                                                     std::size_t buffer, std::size_t offset, std::size_t length) {
  if (buffer >= document.buffers.size())
    fail(where, "names buffer " + std::to_string(buffer) + ", which does not exist");
  const auto bytes = document.buffers[buffer];
  if (offset > bytes.size() || length > bytes.size() - offset)
    fail(where, "its packed bytes reach beyond the buffer's end, byte " + std::to_string(bytes.size()));
  return bytes.subspan(offset, length);
}

/// A buffer of the document's own; its number.
[[maybe_unused]] int own_buffer(Document& document, std::vector<std::byte> bytes) {
  document.buffers.push_back(document.owned.emplace_back(std::move(bytes)));
  return static_cast<int>(document.buffers.size()) - 1;
}

#ifdef TETSOUP_WITH_MESHOPT

/// No packed bytes hold more than this; a mere claim takes no memory.
void check_size(const PackedView& view, const std::string& where) {
  constexpr std::size_t kMostPerByte = 64;    // attributes: 256 bytes take 4 at least
  constexpr std::size_t kTriangleBytes = 12;  // indices: a byte a triangle at least
  const bool attributes = view.mode == "ATTRIBUTES";
  const std::size_t most = view.length * (attributes ? kMostPerByte : kTriangleBytes);
  if (view.stride > 256 || view.count > most / std::max<std::size_t>(view.stride, 1))
    fail(where, "promises more than its packed bytes can hold");
  const bool fits = attributes
                        ? view.stride > 0 && view.stride % 4 == 0
                        : (view.stride == 2 || view.stride == 4) && (view.mode != "TRIANGLES" || view.count % 3 == 0);
  if (!fits) fail(where, "has an impossible stride or count");
}

void apply_filter(const PackedView& view, const std::string& where, void* bytes) {
  const bool fits = view.filter == "OCTAHEDRAL"    ? view.stride == 4 || view.stride == 8
                    : view.filter == "QUATERNION"  ? view.stride == 8
                    : view.filter == "EXPONENTIAL" ? view.stride % 4 == 0
                                                   : view.filter == "NONE";
  if (!fits) fail(where, "has an unknown filter, or one that does not go with its stride");
  if (view.filter == "OCTAHEDRAL") meshopt_decodeFilterOct(bytes, view.count, view.stride);
  if (view.filter == "QUATERNION") meshopt_decodeFilterQuat(bytes, view.count, view.stride);
  if (view.filter == "EXPONENTIAL") meshopt_decodeFilterExp(bytes, view.count, view.stride);
}

std::vector<std::byte> unpacked(const Document& document, const PackedView& view, const std::string& where) {
  const auto packed = bytes_of(document, where, view.buffer, view.offset, view.length);
  check_size(view, where);
  std::vector<std::byte> bytes(view.count * view.stride);
  const auto* const from = reinterpret_cast<const unsigned char*>(packed.data());
  int status = -1;
  if (view.mode == "ATTRIBUTES")
    status = meshopt_decodeVertexBuffer(bytes.data(), view.count, view.stride, from, packed.size());
  else if (view.mode == "TRIANGLES")
    status = meshopt_decodeIndexBuffer(bytes.data(), view.count, view.stride, from, packed.size());
  else if (view.mode == "INDICES")
    status = meshopt_decodeIndexSequence(bytes.data(), view.count, view.stride, from, packed.size());
  if (status != 0) fail(where, "its packed bytes are damaged, or packed in a newer way");
  if (view.mode == "ATTRIBUTES") apply_filter(view, where, bytes.data());
  return bytes;
}

#endif

#ifdef TETSOUP_WITH_DRACO

/// Floats of one attribute for every point of the mesh; their number a point.
std::vector<std::byte> floats_of(const draco::Mesh& mesh, const draco::PointAttribute& attribute, int components,
                                 const std::string& where) {
  std::vector<float> values(static_cast<std::size_t>(components) * mesh.num_points());
  for (draco::PointIndex i(0); i < mesh.num_points(); ++i) {
    const draco::AttributeValueIndex value = attribute.mapped_index(i);
    if (value.value() >= attribute.size() ||
        !attribute.ConvertValue<float>(value, static_cast<std::int8_t>(components),
                                       &values[static_cast<std::size_t>(components) * i.value()]))
      fail(where, "its packed numbers cannot be read");
  }
  const auto bytes = std::as_bytes(std::span<const float>(values));
  return {bytes.begin(), bytes.end()};
}

std::vector<std::byte> corners_of(const draco::Mesh& mesh) {
  std::vector<std::uint32_t> corners;
  corners.reserve(3 * std::size_t{mesh.num_faces()});
  for (draco::FaceIndex f(0); f < mesh.num_faces(); ++f) {
    for (const draco::PointIndex& corner : mesh.face(f)) corners.push_back(corner.value());
  }
  const auto bytes = std::as_bytes(std::span<const std::uint32_t>(corners));
  return {bytes.begin(), bytes.end()};
}

/// An accessor of its own over bytes of its own; its number.
int add_accessor(Document& document, std::vector<std::byte> bytes, std::size_t count, int component_type, int type) {
  tinygltf::Model& model = document.model;
  tinygltf::BufferView view;
  view.byteLength = bytes.size();
  view.buffer = own_buffer(document, std::move(bytes));
  tinygltf::Accessor accessor;
  accessor.bufferView = static_cast<int>(model.bufferViews.size());
  accessor.count = count;
  accessor.componentType = component_type;
  accessor.type = type;
  model.bufferViews.push_back(view);
  model.accessors.push_back(accessor);
  return static_cast<int>(model.accessors.size()) - 1;
}

std::unique_ptr<draco::Mesh> decoded(std::span<const std::byte> packed, const std::string& where) {
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(packed.data()), packed.size());
  draco::Decoder decoder;
  auto result = decoder.DecodeMeshFromBuffer(&buffer);
  if (!result.ok()) fail(where, "its packed bytes are damaged: " + result.status().error_msg_string());
  return std::move(result).value();
}

void unpack(Document& document, const PackedPrimitive& packed, const std::string& where) {
  tinygltf::Model& model = document.model;
  if (packed.mesh >= model.meshes.size() || packed.primitive >= model.meshes[packed.mesh].primitives.size())
    fail(where, "is no primitive");
  if (packed.view >= model.bufferViews.size()) fail(where, "names a bufferView that does not exist");
  const tinygltf::BufferView view = model.bufferViews[packed.view];
  if (view.buffer < 0) fail(where, "names no buffer");
  const auto mesh = decoded(
      bytes_of(document, where, static_cast<std::size_t>(view.buffer), view.byteOffset, view.byteLength), where);
  tinygltf::Primitive& primitive = model.meshes[packed.mesh].primitives[packed.primitive];
  const std::size_t points = mesh->num_points();
  for (const auto& [name, id] : packed.attributes) {
    const int components = name == "POSITION" || name == "NORMAL"                        ? 3
                           : name.starts_with("TEXCOORD_")                               ? 2
                           : name.starts_with("JOINTS_") || name.starts_with("WEIGHTS_") ? 4
                                                                                         : 0;
    const draco::PointAttribute* const attribute = mesh->GetAttributeByUniqueId(id);
    if (components == 0) continue;
    if (!attribute) fail(where, "its packed bytes have no " + name.substr(0, 64));
    primitive.attributes[name] = add_accessor(document, floats_of(*mesh, *attribute, components, where), points,
                                              TINYGLTF_COMPONENT_TYPE_FLOAT, components);
  }
  primitive.indices = add_accessor(document, corners_of(*mesh), 3 * std::size_t{mesh->num_faces()},
                                   TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR);
  primitive.mode = TINYGLTF_MODE_TRIANGLES;
}

#endif

[[maybe_unused, noreturn]] void fail_without(const std::string& where, const char* extension) {
  fail(where, std::string("uses ") + extension + ", which this build cannot read: export without compression");
}

}  // namespace

void unpack_views(Document& document, const std::vector<PackedView>& views) {
  for (const PackedView& packed : views) {
    const std::string where = document.name + ": bufferView " + std::to_string(packed.view);
    if (packed.view >= document.model.bufferViews.size()) fail(where, "does not exist");
#ifdef TETSOUP_WITH_MESHOPT
    std::vector<std::byte> bytes = unpacked(document, packed, where);
    tinygltf::BufferView& view = document.model.bufferViews[packed.view];
    view.byteOffset = 0;
    view.byteLength = bytes.size();
    view.byteStride = packed.mode == "ATTRIBUTES" ? packed.stride : 0;
    view.buffer = own_buffer(document, std::move(bytes));
#else
    fail_without(where, "EXT_meshopt_compression");
#endif
  }
}

void unpack_primitives(Document& document, const std::vector<PackedPrimitive>& primitives) {
  for (const PackedPrimitive& packed : primitives) {
    const std::string where =
        document.name + ": mesh " + std::to_string(packed.mesh) + ", primitive " + std::to_string(packed.primitive);
#ifdef TETSOUP_WITH_DRACO
    unpack(document, packed, where);
#else
    fail_without(where, "KHR_draco_mesh_compression (Draco)");
#endif
  }
}

}  // namespace tetsoup::readers::gltf
