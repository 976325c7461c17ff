// A Collada file as far as its surfaces go: geometries, and the nodes that show them.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "io/affine.h"
#include "io/soup_readers.h"

namespace tetsoup::readers::collada {

enum class Kind { Polygons, Strips, Fans };

/// Polygons of one material.
struct Primitives {
  Kind kind = Kind::Polygons;
  std::string material;              ///< A symbol that instances bind to a material.
  std::vector<std::uint32_t> sizes;  ///< Corners of each polygon, strip or fan.
  std::vector<std::uint32_t> corners;
};

struct Geometry {
  std::string name;
  std::vector<Vec3d> vertices;
  std::vector<Primitives> primitives;
};

/// A geometry or a node that a node shows.
struct Shown {
  std::string id;
  std::map<std::string, std::string> materials;  ///< Ids by symbol.
};

struct Node {
  std::string name;
  Affine place;
  std::vector<std::size_t> children;
  std::vector<Shown> geometries, controllers, nodes;
};

/// A skin in the pose it was bound in.
struct Controller {
  std::string geometry;
  Affine bound;
};

struct Document {
  double metres = 1;  ///< Of a unit.
  Affine upright;     ///< Makes z point up.
  std::map<std::string, Geometry> geometries;
  std::map<std::string, Controller> controllers;
  std::map<std::string, std::string> materials;  ///< Names by id.
  std::vector<Node> nodes;
  std::map<std::string, std::size_t> node_of_id;
  std::map<std::string, std::vector<std::size_t>> scenes;  ///< Their outermost nodes.
  std::string scene;                                       ///< Empty: none is chosen.
};

/// @throws IoError  naming the line.
Document read_document(const Source& source);

}  // namespace tetsoup::readers::collada
