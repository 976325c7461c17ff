// What a path's extension says.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tetsoup {

std::string lower_extension(const std::filesystem::path& path);

/// TetGen's files; the path may name any of them or have none of their extensions.
struct TetgenSet {
  std::filesystem::path nodes, tets, faces;
};
TetgenSet tetgen_set(const std::filesystem::path& path);

/// ".msh, .vtk, ...": what read_tets() takes, for messages.
std::string readable_tet_extensions();

}  // namespace tetsoup
