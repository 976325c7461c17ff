// Connected pieces of mesh and reference, and which of them are the same.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tetsoup/calibrate.h"

namespace tetsoup {

/// A connected piece of a mesh, by itself, its longest side 1 and its middle the origin.
struct Piece {
  std::vector<std::uint32_t> tets;  ///< Of the whole mesh.
  TetMesh mesh;                     ///< Vertices as the whole mesh has them, those of other pieces left out.
  std::vector<double> stiffness, density;
  double volume = 0;
};

/// Pieces that share vertices hang together. Ordered by their first tets.
std::vector<Piece> split_pieces(const ElasticMesh& whole);

}  // namespace tetsoup
