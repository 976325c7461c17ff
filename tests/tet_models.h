// Models of few tets with all that files may say about them.
#pragma once

#include <string>

#include "tet_file_fixtures.h"
#include "tetsoup/tet_model.h"

namespace tetsoup {

/// Two positive tets, of volume 1/6 and 1/3, that share the face 1, 2, 3; whole numbers.
inline TetMesh two_tets() {
  TetMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  mesh.tets = {{0, 1, 2, 3}, {1, 2, 3, 4}};
  return mesh;
}

/// The same, each of a region of its own, a third region empty; two pin sets.
inline TetModel two_regions() {
  TetModel model;
  model.name = "two";
  model.mesh = two_tets();
  model.regions = {{"left arm", {1000, 2000, 0.25, 1}}, {"LEFT_ARM", {500, 4000, 0.5 - 0.125, 1}}, {"", {}}};
  model.tet_regions = {1, 0};
  model.pins = {{"floor", {0, 2}}, {"wall", {2, 4}}};
  return model;
}

/// `block_of_tets` split in two at half its height, with its lowest layer pinned.
inline TetModel block_of_regions(int cells) {
  TetModel model;
  model.mesh = block_of_tets(cells);
  model.regions = {{"lower", {}}, {"upper", {}}};
  for (const Tet& tet : model.mesh.tets) {
    float height = 0;
    for (const std::uint32_t vertex : tet) height += model.mesh.vertices[vertex].z / 4;
    model.tet_regions.push_back(height > static_cast<float>(cells) / 2 ? 1 : 0);
  }
  VertexSet floor{"floor", {}};
  for (std::uint32_t v = 0; v < model.mesh.vertices.size(); ++v)
    if (model.mesh.vertices[v].z < 0.5F) floor.vertices.push_back(v);
  model.pins = {floor};
  return model;
}

}  // namespace tetsoup
