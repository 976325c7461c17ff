// Which meshes a glTF scene shows, and where: nodes below nodes, instances of a node, joints of skins.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "io/affine.h"
#include "io/gltf_document.h"

namespace tetsoup::readers::gltf {

/// Where a node stands in the world, whatever scene it is in.
class NodePlaces {
 public:
  explicit NodePlaces(const Document& document);
  /// @throws IoError  The node does not exist or is its own ancestor.
  const Affine& of(int node);

 private:
  const Document& document_;
  std::vector<int> parents_;  ///< -1: none.
  std::vector<std::optional<Affine>> places_;
};

/// For each joint of a skin, what it makes of the mesh's points in the pose that the nodes have; found once a skin.
class SkinPoses {
 public:
  explicit SkinPoses(const Document& document) : document_(document), nodes_(document) {}
  const std::vector<Affine>& of(int skin);

 private:
  const Document& document_;
  NodePlaces nodes_;
  std::map<int, std::vector<Affine>> poses_;
};

struct Instance {
  std::size_t mesh;
  int skin;          ///< -1: none.
  Affine to_world;   ///< Means nothing to what is skinned.
  std::string name;  ///< The node's, or else the mesh's.
  int node;          ///< -1: the file has none.
};

/// Those of the default scene; without nodes, every mesh as it is.
std::vector<Instance> find_instances(const Document& document);

/// Where the instances of a node by EXT_mesh_gpu_instancing stand within it; nothing if the node has no such extension.
std::optional<std::vector<Affine>> places_within(const Document& document, int node);

}  // namespace tetsoup::readers::gltf
