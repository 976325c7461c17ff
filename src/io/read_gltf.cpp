// glTF 2 and GLB: the default scene, each node's mesh moved to where the node puts it. Skins and morph targets are left
// at rest; points and lines are passed over.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "base/vec.h"
#include "io/gltf_document.h"
#include "tetsoup/error.h"

namespace tetsoup::readers {
namespace {

using gltf::Document;

/// Rows of a 3x4 matrix.
struct Affine {
  std::array<std::array<double, 4>, 3> rows{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};

  Vec3d apply(double x, double y, double z) const {
    const auto row = [&](std::size_t r) { return rows[r][0] * x + rows[r][1] * y + rows[r][2] * z + rows[r][3]; };
    return {row(0), row(1), row(2)};
  }

  /// The unit normal of what the map makes of a plane with this normal; zero if there is none.
  Vec3 apply_to_normal(const Vec3d& normal) const {
    const auto row = [&](std::size_t r) { return Vec3d{rows[r][0], rows[r][1], rows[r][2]}; };
    const std::array<Vec3d, 3> cofactors{cross(row(1), row(2)), cross(row(2), row(0)), cross(row(0), row(1))};
    const double sign = dot(row(0), cofactors[0]) < 0 ? -1 : 1;
    const Vec3d moved{dot(cofactors[0], normal), dot(cofactors[1], normal), dot(cofactors[2], normal)};
    const double size = length(moved);
    return size > 0 && std::isfinite(size) ? to_float(moved * (sign / size)) : Vec3{};
  }
};

Affine operator*(const Affine& a, const Affine& b) {
  Affine product;
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t c = 0; c < 4; ++c) {
      double sum = c == 3 ? a.rows[r][3] : 0;
      for (std::size_t k = 0; k < 3; ++k) sum += a.rows[r][k] * b.rows[k][c];
      product.rows[r][c] = sum;
    }
  }
  return product;
}

/// Rotation by a quaternion (x, y, z, w) of any length but zero.
Affine rotation(const std::vector<double>& q) {
  const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  if (!(length > 0)) return {};
  const double x = q[0] / length, y = q[1] / length, z = q[2] / length, w = q[3] / length;
  return {{{{1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w), 0},
            {2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w), 0},
            {2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y), 0}}}};
}

Affine local_transform(const tinygltf::Node& node) {
  Affine result;
  if (node.matrix.size() == 16) {
    for (std::size_t r = 0; r < 3; ++r) {
      for (std::size_t c = 0; c < 4; ++c) result.rows[r][c] = node.matrix[4 * c + r];
    }
    return result;
  }
  if (node.rotation.size() == 4) result = rotation(node.rotation);
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t c = 0; c < 3 && node.scale.size() == 3; ++c) result.rows[r][c] *= node.scale[c];
    if (node.translation.size() == 3) result.rows[r][3] = node.translation[r];
  }
  return result;
}

struct Instance {
  std::size_t mesh;
  Affine to_world;
  std::string name;  ///< The node's, or else the mesh's.
};

/// The nodes a scene starts from; without scenes, those that are nobody's children.
std::vector<int> roots(const Document& document) {
  const tinygltf::Model& model = document.model;
  const auto scene = static_cast<std::size_t>(std::max(model.defaultScene, 0));
  if (scene < model.scenes.size()) return model.scenes[scene].nodes;
  if (model.defaultScene >= 0) fail(document.name, "scene " + std::to_string(scene) + " does not exist");
  std::vector<bool> is_child(model.nodes.size(), false);
  for (const auto& node : model.nodes) {
    for (const int child : node.children) {
      if (child >= 0 && static_cast<std::size_t>(child) < is_child.size())
        is_child[static_cast<std::size_t>(child)] = true;
    }
  }
  std::vector<int> result;
  for (std::size_t i = 0; i < is_child.size(); ++i) {
    if (!is_child[i]) result.push_back(static_cast<int>(i));
  }
  return result;
}

/// Every node at most once: glTF demands a forest, and a graph with cycles or shared children need not end.
std::vector<Instance> find_instances(const Document& document) {
  const tinygltf::Model& model = document.model;
  std::vector<Instance> instances;
  if (model.nodes.empty()) {
    for (std::size_t i = 0; i < model.meshes.size(); ++i) instances.push_back({i, {}, document.mesh_names[i]});
    return instances;
  }
  std::vector<bool> seen(model.nodes.size(), false);
  std::vector<std::pair<int, Affine>> stack;
  const auto push = [&](const std::vector<int>& nodes, const Affine& parent) {
    for (auto node = nodes.rbegin(); node != nodes.rend(); ++node) stack.emplace_back(*node, parent);
  };
  push(roots(document), {});
  while (!stack.empty()) {
    const auto [index, parent] = stack.back();
    stack.pop_back();
    const std::string where = document.name + ": node " + std::to_string(index);
    if (index < 0 || static_cast<std::size_t>(index) >= model.nodes.size()) fail(where, "does not exist");
    const auto i = static_cast<std::size_t>(index);
    if (seen[i]) fail(where, "has two parents or is its own ancestor");
    seen[i] = true;
    const tinygltf::Node& node = model.nodes[i];
    const Affine to_world = parent * local_transform(node);
    if (node.mesh >= 0) {
      if (static_cast<std::size_t>(node.mesh) >= model.meshes.size()) fail(where, "shows a mesh that does not exist");
      const auto mesh = static_cast<std::size_t>(node.mesh);
      const std::string& name = document.node_names[i];
      instances.push_back({mesh, to_world, name.empty() ? document.mesh_names[mesh] : name});
    }
    push(node.children, to_world);
  }
  return instances;
}

/// Appends the mesh of one instance after another, within limits: instances can multiply a small file at will.
template <class Sink>
class SurfaceBuilder {
 public:
  SurfaceBuilder(const Document& document, Sink& sink)
      : document_(document), most_(kFreeElements + document.file_bytes), sink_(sink) {}

  void add(const Instance& instance) {
    first_of_accessor_.clear();
    first_of_attribute_.clear();
    if constexpr (Sink::kDetails) sink_.set_object(instance.name);
    const auto& primitives = document_.model.meshes[instance.mesh].primitives;
    for (std::size_t i = 0; i < primitives.size(); ++i) {
      where_ = document_.name + ": mesh " + std::to_string(instance.mesh) + ", primitive " + std::to_string(i);
      add_primitive(primitives[i], instance.to_world);
    }
  }

 private:
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

  /// Primitives of a mesh often share their vertices.
  Range add_vertices(int accessor, const Affine& to_world) {
    if (const auto known = first_of_accessor_.find(accessor); known != first_of_accessor_.end()) return known->second;
    const std::vector<double> p = gltf::read_accessor(document_, accessor, TINYGLTF_TYPE_VEC3);
    const Range added{sink_.vertex_count(), p.size() / 3};
    check_room(added.first, added.count, "vertices");
    for (std::size_t i = 0; i < p.size(); i += 3) sink_.add_vertex(to_world.apply(p[i], p[i + 1], p[i + 2]));
    return first_of_accessor_[accessor] = added;
  }

  void add_primitive(const tinygltf::Primitive& primitive, const Affine& to_world) {
    const int mode = primitive.mode;
    if (mode >= TINYGLTF_MODE_POINTS && mode <= TINYGLTF_MODE_LINE_STRIP) return;
    if (mode < TINYGLTF_MODE_POINTS || mode > TINYGLTF_MODE_TRIANGLE_FAN) fail(where_, "is of an unknown mode");
    const auto position = primitive.attributes.find("POSITION");
    if (position == primitive.attributes.end()) return;
    const Range vertices = add_vertices(position->second, to_world);
    const std::vector<std::uint32_t> corners = read_corners(primitive, vertices);
    check_room(sink_.face_count(), corners.size(), "triangles");
    if constexpr (Sink::kDetails) {
      const std::size_t first_corner = sink_.corner_count();
      set_material(primitive.material);
      add_triangles(mode, corners);
      add_texcoords(primitive, vertices, first_corner);
      add_normals(primitive, vertices, first_corner, to_world);
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
                   const Affine& to_world) {
    const Range range = add_attribute(primitive, "NORMAL", TINYGLTF_TYPE_VEC3, vertices, sink_.normal_count(),
                                      [&](const std::vector<double>& n) {
                                        for (std::size_t i = 0; i < n.size(); i += 3)
                                          sink_.add_normal(to_world.apply_to_normal({n[i], n[i + 1], n[i + 2]}));
                                      });
    if (range.count > 0) sink_.take_vertex_normals(first_corner, vertices.first, range.count, range.first);
  }

  const Document& document_;
  std::size_t most_;
  std::string where_;
  std::map<int, Range> first_of_accessor_;
  std::map<std::pair<std::string_view, int>, Range> first_of_attribute_;
  Sink& sink_;
};

}  // namespace

template <class Sink>
void read_gltf(const Source& source, const std::optional<std::filesystem::path>& folder, Sink& sink) {
  const Document document = gltf::read_document(source, folder);
  SurfaceBuilder<Sink> builder(document, sink);
  for (const Instance& instance : find_instances(document)) builder.add(instance);
}

template void read_gltf(const Source&, const std::optional<std::filesystem::path>&, SoupSink&);
template void read_gltf(const Source&, const std::optional<std::filesystem::path>&, MeshSink&);

}  // namespace tetsoup::readers
