// The tets that may become the mesh, between density and the steps that mend what density alone leaves.
#pragma once

#include <cstdint>
#include <vector>

#include "tetsoup/types.h"

namespace tetsoup {

/// In Candidates::kept: the tet belongs to the mesh, and the clean-up drops it only where nothing else helps.
inline constexpr std::uint8_t kHeld = 2;

/// Every tet that holds an inside voxel or is kept, and every tet around a vertex of one of those, so that whoever adds
/// tets to the mesh finds them here.
struct Candidates {
  TetMesh mesh;                    ///< Positive tets, faces matching; vertices and tets in lattice order.
  std::vector<float> density;      ///< Share of each tet that is inside, 0..1.
  std::vector<std::uint8_t> kept;  ///< 0: not in the mesh; 1 or kHeld: in the mesh.
  /// Share of each tet that is inside or in voxels the soup passes through; empty if nobody asked. Every tet with some
  /// is listed then. Of the tets as the lattice made them: steps that add tets leave it alone.
  std::vector<float> passed;
};

/// The mesh of the kept tets; vertices and tets keep their order.
TetMesh kept_mesh(const Candidates& candidates);

}  // namespace tetsoup
