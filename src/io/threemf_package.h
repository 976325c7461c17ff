// A 3MF file: parts in a zip file, objects in the parts, and what is to be built of them.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "io/affine.h"
#include "io/soup_readers.h"

namespace tetsoup::readers::threemf {

/// An object put somewhere.
struct Placement {
  std::string part;  ///< Of the package.
  std::string object;
  Affine place;
};

struct Object {
  std::string name;
  std::vector<Vec3d> vertices;
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> materials;  ///< Of the triangles: an entry of Part::materials.
  std::vector<Placement> components;
};

struct Part {
  std::map<std::string, Object> objects;  ///< By id.
  std::vector<Placement> items;
  std::vector<std::string> materials{""};  ///< Names; the first is none.
};

struct Package {
  std::map<std::string, Part> parts;
  std::string root;
  std::size_t unpacked_bytes = 0;
};

/// All parts that the root leads to. @throws IoError
Package read_package(const Source& source);

}  // namespace tetsoup::readers::threemf
