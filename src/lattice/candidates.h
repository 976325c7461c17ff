// The tets that may become the mesh, between density and the steps that mend what density alone leaves.
#pragma once

#include <cstdint>
#include <vector>

#include "tetsoup/types.h"

namespace tetsoup {

/// In Candidates::kept: the tet belongs to the mesh, and the clean-up drops it only where nothing else helps.
inline constexpr std::uint8_t kHeld = 2;

/// Every tet that holds a voxel of the body or is kept, and every tet around a vertex of one of those, so that whoever
/// adds tets to the mesh finds them here.
struct Candidates {
  TetMesh mesh;                    ///< Positive tets, faces matching; vertices and tets in lattice order.
  std::vector<float> density;      ///< Share of each tet that is in the body, 0..1.
  std::vector<std::uint8_t> kept;  ///< 0: not in the mesh; 1 or kHeld: in the mesh.
};

/// Edge of a regular tet of the mean volume, which is about the lattice's mean edge.
double lattice_edge(const TetMesh& mesh);

/// The mesh of the kept tets; vertices and tets keep their order.
TetMesh kept_mesh(const Candidates& candidates);

}  // namespace tetsoup
