// Room for a mesh as text.
#pragma once

#include <cstddef>
#include <string>

#include "tetsoup/types.h"

namespace tetsoup {

/// Empty, with room for a line per vertex and per tet: typical line lengths, to allocate once.
inline std::string text_for(const TetMesh& mesh) {
  constexpr std::size_t kBytesPerVertex = 40, kBytesPerTet = 36;
  std::string text;
  text.reserve(1024 + kBytesPerVertex * mesh.vertices.size() + kBytesPerTet * mesh.tets.size());
  return text;
}

}  // namespace tetsoup
