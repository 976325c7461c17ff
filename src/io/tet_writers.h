// The writers of tet meshes, each giving a file's bytes. The mesh must have valid indices.
#pragma once

#include <span>
#include <string>

#include "tetsoup/io.h"
#include "tetsoup/types.h"

namespace tetsoup {

std::string msh41_text(const TetMesh& mesh);
std::string msh22_text(const TetMesh& mesh);
std::string vtk_text(const TetMesh& mesh);
std::string vtu_text(const TetMesh& mesh);
std::string medit_text(const TetMesh& mesh);
std::string tetgen_node_text(const TetMesh& mesh);
std::string tetgen_ele_text(const TetMesh& mesh);

/// @throws IoError  listing what there is, if the extension is none of them.
SurfaceFormat surface_format_of(const std::filesystem::path& path);

}  // namespace tetsoup
