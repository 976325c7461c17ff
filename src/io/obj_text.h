// Surfaces as OBJ text, several in one file if wanted.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "tetsoup/render_mesh.h"

namespace tetsoup {

/// What a mesh is written with instead of its own, and where in the file.
struct ObjPlace {
  std::span<const Vec3> vertices;                    ///< As many as the mesh has.
  std::span<const Vec3> normals;                     ///< None: corners have none.
  std::string object;                                ///< Goes before the names of its own objects.
  std::size_t first_vertex = 0, first_texcoord = 0;  ///< Of the file, before this.
  Vec3d origin{};                                    ///< That the vertices are counted from.
};

/// The mesh's index lists must fit together.
void append_obj(std::string& text, const RenderMesh& mesh, const ObjPlace& place);

/// A name that ends its line and does not start a new one.
void append_name_line(std::string& text, const char* keyword, const std::string& name);

}  // namespace tetsoup
