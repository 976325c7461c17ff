// The readers of tet meshes, each from a file's bytes in memory; `name` stands for the path in errors.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tetsoup/types.h"

namespace tetsoup {

/// As files hold it.
struct WideTetMesh {
  std::vector<Vec3d> vertices;
  std::vector<Tet> tets;

  /// Counted from where make_soup() would count from.
  TetMesh narrowed() &&;
};

TetMesh parse_msh(std::string_view text, const std::string& name);    ///< MSH 2.2 and 4.1, ASCII and binary.
TetMesh parse_vtk(std::string_view text, const std::string& name);    ///< Legacy VTK up to 5.1, ASCII and binary.
TetMesh parse_vtu(std::string_view text, const std::string& name);    ///< ASCII, base64 and raw, uncompressed.
TetMesh parse_medit(std::string_view text, const std::string& name);  ///< ASCII.
TetMesh parse_npz(std::string_view bytes, const std::string& name);   ///< Arrays vertices and tet_indices.
TetMesh parse_tetgen(std::string_view nodes, const std::string& nodes_name, std::string_view tets,
                     const std::string& tets_name);

}  // namespace tetsoup
