// What a path's extension says.
#pragma once

#include <filesystem>
#include <string>

namespace tetsoup {

std::string lower_extension(const std::filesystem::path& path);

/// TetGen's two files; the path may name either or have neither extension.
struct TetgenPair {
  std::filesystem::path nodes, tets;
};
TetgenPair tetgen_pair(const std::filesystem::path& path);

/// ".msh, .vtk, ...": what read_tets() takes, for messages.
std::string known_tet_extensions();

}  // namespace tetsoup
