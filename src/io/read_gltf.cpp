// glTF 2 and GLB: the default scene, each node's mesh moved to where the node puts it, or where the joints of its skin
// stand. Morph targets are left at rest; points and lines are passed over.
#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "io/gltf_scene.h"
#include "tetsoup/error.h"

namespace tetsoup::readers {
namespace {

using gltf::Document;

using gltf::Instance;

/// What moves the vertices of one primitive: a node as a whole, or the joints of a skin, each with a share in each
/// vertex.
class VertexPlaces {
 public:
  explicit VertexPlaces(const Affine& whole) : whole_(whole) {}

  /// Takes JOINTS_n and WEIGHTS_n of the primitive, as many as there are.
  void read_joints(const Document& document, const std::string& where, const tinygltf::Primitive& primitive,
                   std::size_t vertex_count, const std::vector<Affine>& joints) {
    joints_ = &joints;
    const auto read = [&](const std::string& name) {
      const auto accessor = primitive.attributes.find(name);
      if (accessor == primitive.attributes.end()) return std::vector<double>();
      if (gltf::accessor_count(document, accessor->second) != vertex_count)
        fail(where, name + " has another number of elements than POSITION");
      return gltf::read_accessor(document, accessor->second, TINYGLTF_TYPE_VEC4);
    };
    constexpr int kMostSets = 16;
    for (int set = 0; set < kMostSets; ++set) {
      std::vector<double> ids = read("JOINTS_" + std::to_string(set));
      std::vector<double> shares = read("WEIGHTS_" + std::to_string(set));
      if (ids.empty() || shares.empty()) return;
      for (std::size_t i = 0; i < ids.size(); ++i) {
        if (shares[i] != 0 && !(ids[i] >= 0 && ids[i] < static_cast<double>(joints.size())))
          fail(where, "a vertex hangs on a joint that its skin does not have");
      }
      sets_.push_back({std::move(ids), std::move(shares)});
    }
  }

  /// Shares are taken relative to their sum; where that is nothing, the vertex stays with the node.
  Affine of(std::size_t vertex) const {
    if (sets_.empty()) return whole_;
    double sum = 0;
    for (const Set& set : sets_) {
      for (std::size_t k = 4 * vertex; k < 4 * vertex + 4; ++k) sum += set.shares[k];
    }
    if (!(std::abs(sum) > 0)) return whole_;
    Affine place{};
    for (auto& row : place.rows) row.fill(0);
    for (const Set& set : sets_) {
      for (std::size_t k = 4 * vertex; k < 4 * vertex + 4; ++k)
        if (set.shares[k] != 0) place.add((*joints_)[static_cast<std::size_t>(set.ids[k])], set.shares[k] / sum);
    }
    return place;
  }

 private:
  struct Set {
    std::vector<double> ids, shares;
  };
  Affine whole_;
  const std::vector<Affine>* joints_ = nullptr;
  std::vector<Set> sets_;
};

/// Appends the mesh of one instance after another, within limits: instances can multiply a small file at will.
template <class Sink>
class SurfaceBuilder {
 public:
  SurfaceBuilder(const Document& document, Sink& sink)
      : document_(document), skins_(document), most_(kFreeElements + document.file_bytes), sink_(sink) {}

  void add(const Instance& instance) {
    const auto places = gltf::places_within(document_, instance.node);
    if (!places) return add_at(instance, instance.to_world);
    check_room(instance_count_, places->size(), "instances");
    instance_count_ += places->size();
    for (const Affine& place : *places) add_at(instance, instance.to_world * place);
  }

 private:
  void add_at(const Instance& instance, const Affine& to_world) {
    first_of_vertices_.clear();
    first_of_attribute_.clear();
    if constexpr (Sink::kDetails) sink_.set_object(instance.name);
    const auto& primitives = document_.model.meshes[instance.mesh].primitives;
    for (std::size_t i = 0; i < primitives.size(); ++i) {
      where_ = document_.name + ": mesh " + std::to_string(instance.mesh) + ", primitive " + std::to_string(i);
      add_primitive(primitives[i], instance.skin, to_world);
    }
  }

  // Vertices, and triangles, that instances may add to what the file itself can hold: 8 million take 0.2 GB.
  static constexpr std::size_t kFreeElements = 8'000'000;

  struct Range {
    std::size_t first = 0, count = 0;
  };

  bool has_room(std::size_t present, std::size_t added) const { return added <= most_ && present <= most_ - added; }
  void check_room(std::size_t present, std::size_t added, const char* what) const {
    if (has_room(present, added)) return;
    fail(document_.name, "its instances add up to more than " + std::to_string(most_) + " " + what);
  }

  VertexPlaces places_of(const tinygltf::Primitive& primitive, int position, int skin, const Affine& to_world) {
    VertexPlaces places(to_world);
    if (skin >= 0 && primitive.attributes.count("JOINTS_0") > 0)
      places.read_joints(document_, where_, primitive, gltf::accessor_count(document_, position), skins_.of(skin));
    return places;
  }

  /// Primitives of a mesh often share their vertices.
  Range add_vertices(const tinygltf::Primitive& primitive, int position, const VertexPlaces& places) {
    const auto named = [&](const char* name) {
      const auto accessor = primitive.attributes.find(name);
      return accessor == primitive.attributes.end() ? -1 : accessor->second;
    };
    const std::tuple<int, int, int> key{position, named("JOINTS_0"), named("WEIGHTS_0")};
    if (const auto known = first_of_vertices_.find(key); known != first_of_vertices_.end()) return known->second;
    const std::vector<double> p = gltf::read_accessor(document_, position, TINYGLTF_TYPE_VEC3);
    const Range added{sink_.vertex_count(), p.size() / 3};
    check_room(added.first, added.count, "vertices");
    for (std::size_t i = 0; i < p.size(); i += 3) sink_.add_vertex(places.of(i / 3).apply({p[i], p[i + 1], p[i + 2]}));
    return first_of_vertices_[key] = added;
  }

  void add_primitive(const tinygltf::Primitive& primitive, int skin, const Affine& to_world) {
    const int mode = primitive.mode;
    if (mode >= TINYGLTF_MODE_POINTS && mode <= TINYGLTF_MODE_LINE_STRIP) return;
    if (mode < TINYGLTF_MODE_POINTS || mode > TINYGLTF_MODE_TRIANGLE_FAN) fail(where_, "is of an unknown mode");
    const auto position = primitive.attributes.find("POSITION");
    if (position == primitive.attributes.end()) return;
    const VertexPlaces places = places_of(primitive, position->second, skin, to_world);
    const Range vertices = add_vertices(primitive, position->second, places);
    const std::vector<std::uint32_t> corners = read_corners(primitive, vertices);
    check_room(sink_.face_count(), corners.size(), "triangles");
    if constexpr (Sink::kDetails) {
      const std::size_t first_corner = sink_.corner_count();
      set_material(primitive.material);
      add_triangles(mode, corners);
      add_texcoords(primitive, vertices, first_corner);
      add_normals(primitive, vertices, first_corner, places);
    } else {
      add_triangles(mode, corners);
    }
  }

  void add_triangles(int mode, const std::vector<std::uint32_t>& corners) {
    if (mode == TINYGLTF_MODE_TRIANGLES) {
      for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
        sink_.add_triangle(corners[i], corners[i + 1], corners[i + 2]);
      }
    } else if (mode == TINYGLTF_MODE_TRIANGLE_STRIP) {
      Strip<Sink> strip(sink_);
      for (const std::uint32_t corner : corners) strip.add(corner);
    } else {
      Fan<Sink> fan(sink_);
      for (const std::uint32_t corner : corners) fan.add(corner);
    }
  }

  /// An index beyond the primitive's own vertices must not reach the next one's.
  std::vector<std::uint32_t> read_corners(const tinygltf::Primitive& primitive, const Range& vertices) const {
    std::vector<std::uint32_t> corners;
    const auto add = [&](double index) {
      const bool exists = index >= 0 && index < static_cast<double>(vertices.count);
      corners.push_back(exists ? vertex_index(static_cast<double>(vertices.first) + index) : kNoVertex);
    };
    if (primitive.indices < 0) {
      corners.reserve(vertices.count);
      for (std::size_t i = 0; i < vertices.count; ++i) add(static_cast<double>(i));
      return corners;
    }
    const std::vector<double> indices = gltf::read_accessor(document_, primitive.indices, TINYGLTF_TYPE_SCALAR);
    corners.reserve(indices.size());
    for (const double index : indices) add(index);
    return corners;
  }

  void set_material(int material) {
    const auto& names = document_.material_names;
    const bool exists = material >= 0 && static_cast<std::size_t>(material) < names.size();
    sink_.set_material(exists ? names[static_cast<std::size_t>(material)] : std::string());
  }

  /// Adds an attribute that has something for each of the vertices, unless these primitives have it already; nothing if
  /// it cannot be read. add_numbers() puts what it is given at `present` and behind.
  template <class AddNumbers>
  Range add_attribute(const tinygltf::Primitive& primitive, const char* name, int type, const Range& vertices,
                      std::size_t present, const AddNumbers& add_numbers) {
    const auto accessor = primitive.attributes.find(name);
    if (accessor == primitive.attributes.end()) return {};
    const auto [known, is_new] = first_of_attribute_.try_emplace({name, accessor->second});
    Range& range = known->second;
    if (!is_new) return range.count == vertices.count ? range : Range{};
    try {
      const std::vector<double> numbers = gltf::read_accessor(document_, accessor->second, type);
      const std::size_t components = type == TINYGLTF_TYPE_VEC3 ? 3 : 2;
      if (numbers.size() != components * vertices.count || !has_room(present, vertices.count)) return {};
      add_numbers(numbers);
      return range = {present, vertices.count};
    } catch (const IoError&) {
      return {};
    }
  }

  /// glTF's v runs downwards.
  void add_texcoords(const tinygltf::Primitive& primitive, const Range& vertices, std::size_t first_corner) {
    const Range range =
        add_attribute(primitive, "TEXCOORD_0", TINYGLTF_TYPE_VEC2, vertices, sink_.texcoord_count(),
                      [&](const std::vector<double>& uv) {
                        for (std::size_t i = 0; i < uv.size(); i += 2)
                          sink_.add_texcoord({static_cast<float>(uv[i]), static_cast<float>(1 - uv[i + 1])});
                      });
    if (range.count > 0) sink_.take_vertex_texcoords(first_corner, vertices.first, range.count, range.first);
  }

  void add_normals(const tinygltf::Primitive& primitive, const Range& vertices, std::size_t first_corner,
                   const VertexPlaces& places) {
    const Range range = add_attribute(
        primitive, "NORMAL", TINYGLTF_TYPE_VEC3, vertices, sink_.normal_count(), [&](const std::vector<double>& n) {
          for (std::size_t i = 0; i < n.size(); i += 3)
            sink_.add_normal(places.of(i / 3).apply_to_normal({n[i], n[i + 1], n[i + 2]}));
        });
    if (range.count > 0) sink_.take_vertex_normals(first_corner, vertices.first, range.count, range.first);
  }

  const Document& document_;
  gltf::SkinPoses skins_;
  std::size_t most_, instance_count_ = 0;
  std::string where_;
  std::map<std::tuple<int, int, int>, Range> first_of_vertices_;
  std::map<std::pair<std::string_view, int>, Range> first_of_attribute_;
  Sink& sink_;
};

}  // namespace

template <class Sink>
void read_gltf(const Source& source, const std::optional<std::filesystem::path>& folder, Sink& sink) {
  const Document document = gltf::read_document(source, folder);
  SurfaceBuilder<Sink> builder(document, sink);
  for (const Instance& instance : gltf::find_instances(document)) builder.add(instance);
}

template void read_gltf(const Source&, const std::optional<std::filesystem::path>&, SoupSink&);
template void read_gltf(const Source&, const std::optional<std::filesystem::path>&, MeshSink&);

}  // namespace tetsoup::readers
