// Numbers out of buffers: nothing the file says about offsets, strides or counts is believed.
#include <algorithm>
#include <limits>

#include "io/gltf_document.h"
#include "io/load_bytes.h"

namespace tetsoup::readers::gltf {
namespace {

/// Elements at a stride, all of them inside the buffer.
struct View {
  const std::byte* at = nullptr;
  std::size_t stride = 0;
};

template <class Number>
double load_number(const std::byte* at, bool normalized) {
  const auto value = static_cast<double>(load<Number>(at));
  if (!normalized || !std::numeric_limits<Number>::is_integer) return value;
  return std::max(value / static_cast<double>(std::numeric_limits<Number>::max()), -1.0);
}

double load_component(const std::byte* at, int component_type, bool normalized) {
  switch (component_type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return load_number<std::int8_t>(at, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return load_number<std::uint8_t>(at, normalized);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return load_number<std::int16_t>(at, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return load_number<std::uint16_t>(at, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return load_number<std::uint32_t>(at, normalized);
    default:
      return load_number<float>(at, normalized);
  }
}

std::size_t component_size(int component_type) {
  switch (component_type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return 4;
    default:
      return 0;
  }
}

class Reader {
 public:
  Reader(const Document& document, int index)
      : document_(document), where_(document.name + ": accessor " + std::to_string(index)) {
    if (index < 0 || static_cast<std::size_t>(index) >= document.model.accessors.size()) {
      fail(where_, "does not exist");
    }
    accessor_ = &document.model.accessors[static_cast<std::size_t>(index)];
  }

  std::size_t count() const { return accessor_->count; }

  std::vector<double> read(int type) const {
    if (accessor_->type != type) fail(where_, "holds elements of another kind than its use asks for");
    const auto components =
        static_cast<std::size_t>(tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(type)));
    const std::size_t size = component_size(accessor_->componentType);
    if (size == 0) fail(where_, "has component type " + std::to_string(accessor_->componentType));
    std::vector<double> values = read_dense(components, size);
    if (accessor_->sparse.isSparse) put_sparse(components, size, values);
    return values;
  }

 private:
  std::vector<double> read_dense(std::size_t components, std::size_t size) const {
    const std::size_t count = accessor_->count;
    if (accessor_->bufferView < 0) {
      if (count > document_.file_bytes) fail(where_, "promises more zeros than the file has bytes");
      return std::vector<double>(count * components, 0.0);
    }
    const View view = open_view(accessor_->bufferView, accessor_->byteOffset, count, components * size);
    std::vector<double> values;
    values.reserve(count * components);
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t c = 0; c < components; ++c) {
        values.push_back(
            load_component(view.at + i * view.stride + c * size, accessor_->componentType, accessor_->normalized));
      }
    }
    return values;
  }

  void put_sparse(std::size_t components, std::size_t size, std::vector<double>& values) const {
    const auto& sparse = accessor_->sparse;
    const std::size_t index_size = component_size(sparse.indices.componentType);
    if (sparse.count < 0 || sparse.indices.byteOffset < 0 || sparse.values.byteOffset < 0 || index_size == 0) {
      fail(where_, "has a sparse part of impossible numbers");
    }
    const auto count = static_cast<std::size_t>(sparse.count);
    const View indices =
        open_view(sparse.indices.bufferView, static_cast<std::size_t>(sparse.indices.byteOffset), count, index_size);
    const View replacements = open_view(sparse.values.bufferView, static_cast<std::size_t>(sparse.values.byteOffset),
                                        count, components * size);
    for (std::size_t i = 0; i < count; ++i) {
      const double index = load_component(indices.at + i * indices.stride, sparse.indices.componentType, false);
      if (!(index >= 0 && index < static_cast<double>(accessor_->count))) {
        fail(where_, "its sparse part replaces an element that does not exist");
      }
      for (std::size_t c = 0; c < components; ++c) {
        values[static_cast<std::size_t>(index) * components + c] = load_component(
            replacements.at + i * replacements.stride + c * size, accessor_->componentType, accessor_->normalized);
      }
    }
  }

  View open_view(int index, std::size_t offset, std::size_t count, std::size_t element_size) const {
    const auto& views = document_.model.bufferViews;
    if (index < 0 || static_cast<std::size_t>(index) >= views.size()) {
      fail(where_, "names bufferView " + std::to_string(index) + ", which does not exist");
    }
    const tinygltf::BufferView& view = views[static_cast<std::size_t>(index)];
    if (view.buffer < 0 || static_cast<std::size_t>(view.buffer) >= document_.buffers.size()) {
      fail(where_, "names buffer " + std::to_string(view.buffer) + ", which does not exist");
    }
    const auto buffer = document_.buffers[static_cast<std::size_t>(view.buffer)];
    if (view.byteOffset > buffer.size() || view.byteLength > buffer.size() - view.byteOffset) {
      fail(where_, "its bufferView " + std::to_string(index) + " reaches beyond the buffer's end, byte " +
                       std::to_string(buffer.size()));
    }
    const std::size_t stride = view.byteStride > 0 ? view.byteStride : element_size;
    if (stride < element_size) fail(where_, "its elements overlap");
    const std::size_t room = offset <= view.byteLength ? view.byteLength - offset : 0;
    const std::size_t fitting = room < element_size ? 0 : (room - element_size) / stride + 1;
    if (count > fitting) {
      fail(where_, "promises " + std::to_string(count) + " elements, its bufferView " + std::to_string(index) +
                       " has room for " + std::to_string(fitting));
    }
    return {count > 0 ? buffer.data() + view.byteOffset + offset : nullptr, stride};
  }

  const Document& document_;
  std::string where_;
  const tinygltf::Accessor* accessor_ = nullptr;
};

}  // namespace

std::size_t accessor_count(const Document& document, int accessor) {
  return Reader(document, accessor).count();
}

std::vector<double> read_accessor(const Document& document, int accessor, int type) {
  return Reader(document, accessor).read(type);
}

}  // namespace tetsoup::readers::gltf
