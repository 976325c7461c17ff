#include "io/gltf_scene.h"

#include <algorithm>
#include <array>

namespace tetsoup::readers::gltf {
namespace {

/// Rotation by a quaternion (x, y, z, w) of any length but zero.
Affine rotation(const double* q) {
  const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  if (!(length > 0)) return {};
  const double x = q[0] / length, y = q[1] / length, z = q[2] / length, w = q[3] / length;
  return {{{{1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w), 0},
            {2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w), 0},
            {2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y), 0}}}};
}

/// From 16 numbers, column by column; the last row is taken for 0 0 0 1.
Affine of_columns(const double* numbers) {
  Affine result;
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t c = 0; c < 4; ++c) result.rows[r][c] = numbers[4 * c + r];
  }
  return result;
}

/// Null where there is none of it.
Affine of_parts(const double* translation, const double* turn, const double* scale) {
  Affine result;
  if (turn) result = rotation(turn);
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t c = 0; c < 3 && scale; ++c) result.rows[r][c] *= scale[c];
    if (translation) result.rows[r][3] = translation[r];
  }
  return result;
}

Affine local_transform(const tinygltf::Node& node) {
  if (node.matrix.size() == 16) return of_columns(node.matrix.data());
  const auto part = [](const std::vector<double>& numbers, std::size_t count) {
    return numbers.size() == count ? numbers.data() : nullptr;
  };
  return of_parts(part(node.translation, 3), part(node.rotation, 4), part(node.scale, 3));
}

std::string name_of_node(const Document& document, int node) {
  return document.name + ": node " + std::to_string(node);
}

std::vector<int> parents_of(const Document& document) {
  std::vector<int> parents(document.model.nodes.size(), -1);
  for (std::size_t i = 0; i < parents.size(); ++i) {
    for (const int child : document.model.nodes[i].children) {
      if (child >= 0 && static_cast<std::size_t>(child) < parents.size())
        parents[static_cast<std::size_t>(child)] = static_cast<int>(i);
    }
  }
  return parents;
}

/// The nodes a scene starts from; without scenes, those that are nobody's children.
std::vector<int> roots(const Document& document) {
  const tinygltf::Model& model = document.model;
  const auto scene = static_cast<std::size_t>(std::max(model.defaultScene, 0));
  if (scene < model.scenes.size()) return model.scenes[scene].nodes;
  if (model.defaultScene >= 0) fail(document.name, "scene " + std::to_string(scene) + " does not exist");
  const std::vector<int> parents = parents_of(document);
  std::vector<int> result;
  for (std::size_t i = 0; i < parents.size(); ++i) {
    if (parents[i] < 0) result.push_back(static_cast<int>(i));
  }
  return result;
}

Instance instance_of(const Document& document, int index, const Affine& to_world) {
  const auto i = static_cast<std::size_t>(index);
  const tinygltf::Node& node = document.model.nodes[i];
  if (static_cast<std::size_t>(node.mesh) >= document.model.meshes.size())
    fail(name_of_node(document, index), "shows a mesh that does not exist");
  const auto mesh = static_cast<std::size_t>(node.mesh);
  const std::string& name = document.node_names[i];
  return {mesh, node.skin, to_world, name.empty() ? document.mesh_names[mesh] : name, index};
}

}  // namespace

NodePlaces::NodePlaces(const Document& document)
    : document_(document), parents_(parents_of(document)), places_(parents_.size()) {}

const Affine& NodePlaces::of(int node) {
  if (node < 0 || static_cast<std::size_t>(node) >= places_.size())
    fail(name_of_node(document_, node), "does not exist");
  std::vector<std::size_t> chain;  // from the node up to the first whose place is known
  for (int at = node; at >= 0 && !places_[static_cast<std::size_t>(at)]; at = parents_[static_cast<std::size_t>(at)]) {
    if (chain.size() > places_.size()) fail(name_of_node(document_, node), "is its own ancestor");
    chain.push_back(static_cast<std::size_t>(at));
  }
  for (auto at = chain.rbegin(); at != chain.rend(); ++at) {
    const Affine local = local_transform(document_.model.nodes[*at]);
    const int parent = parents_[*at];
    places_[*at] = parent < 0 ? local : *places_[static_cast<std::size_t>(parent)] * local;
  }
  return *places_[static_cast<std::size_t>(node)];
}

const std::vector<Affine>& SkinPoses::of(int skin) {
  const auto [known, is_new] = poses_.try_emplace(skin);
  if (!is_new) return known->second;
  const std::string where = document_.name + ": skin " + std::to_string(skin);
  if (static_cast<std::size_t>(skin) >= document_.model.skins.size()) fail(where, "does not exist");
  const tinygltf::Skin& described = document_.model.skins[static_cast<std::size_t>(skin)];
  std::vector<double> inverses;
  if (described.inverseBindMatrices >= 0) {
    if (accessor_count(document_, described.inverseBindMatrices) < described.joints.size())
      fail(where, "has fewer inverse bind matrices than joints");
    inverses = read_accessor(document_, described.inverseBindMatrices, TINYGLTF_TYPE_MAT4);
  }
  for (std::size_t i = 0; i < described.joints.size(); ++i) {
    const Affine& joint = nodes_.of(described.joints[i]);
    known->second.push_back(inverses.empty() ? joint : joint * of_columns(&inverses[16 * i]));
  }
  return known->second;
}

/// Every node at most once: glTF demands a forest, and a graph with cycles or shared children need not end.
std::vector<Instance> find_instances(const Document& document) {
  const tinygltf::Model& model = document.model;
  std::vector<Instance> instances;
  if (model.nodes.empty()) {
    for (std::size_t i = 0; i < model.meshes.size(); ++i) instances.push_back({i, -1, {}, document.mesh_names[i], -1});
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
    if (index < 0 || static_cast<std::size_t>(index) >= model.nodes.size())
      fail(name_of_node(document, index), "does not exist");
    const auto i = static_cast<std::size_t>(index);
    if (seen[i]) fail(name_of_node(document, index), "has two parents or is its own ancestor");
    seen[i] = true;
    const tinygltf::Node& node = model.nodes[i];
    const Affine to_world = parent * local_transform(node);
    if (node.mesh >= 0) instances.push_back(instance_of(document, index, to_world));
    push(node.children, to_world);
  }
  return instances;
}

std::optional<std::vector<Affine>> places_within(const Document& document, int node) {
  const auto found = document.instancing.find(node);
  if (found == document.instancing.end()) return {};
  const std::string where = name_of_node(document, node);
  std::optional<std::size_t> count;
  const auto read = [&](int accessor, int type) {
    if (accessor < 0) return std::vector<double>();
    const std::size_t own = accessor_count(document, accessor);
    if (count && *count != own) fail(where, "its instances have different numbers of places, turns and scales");
    count = own;
    return read_accessor(document, accessor, type);
  };
  const std::vector<double> translations = read(found->second.translation, TINYGLTF_TYPE_VEC3),
                            turns = read(found->second.rotation, TINYGLTF_TYPE_VEC4),
                            scales = read(found->second.scale, TINYGLTF_TYPE_VEC3);
  std::vector<Affine> places;
  for (std::size_t i = 0; i < count.value_or(0); ++i) {
    places.push_back(of_parts(translations.empty() ? nullptr : &translations[3 * i],
                              turns.empty() ? nullptr : &turns[4 * i], scales.empty() ? nullptr : &scales[3 * i]));
  }
  return places;
}

}  // namespace tetsoup::readers::gltf
