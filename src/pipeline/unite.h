// The results of several bodies as one.
#pragma once

#include <cstddef>
#include <vector>

#include "tetsoup/lattice.h"
#include "tetsoup/pseudo_volume.h"
#include "tetsoup/smooth.h"

namespace tetsoup {

/// On a grid of all bodies: a voxel is inside where its centre lies in an inside voxel of one of them.
PseudoVolume united_volume(const std::vector<const PseudoVolume*>& bodies, const GridFrame& grid);
/// Meshes one after the other; counts and volumes added up, sizes of cells those of the body with most tets.
LatticeMesh united_lattice(const std::vector<const LatticeMesh*>& bodies);
SmoothResult united_smooth(const std::vector<const SmoothResult*>& bodies);

/// Where the next body begins in a mesh of several.
struct MeshPlace {
  std::size_t vertex = 0, tet = 0;
};
/// The mesh of the body at `place`, which has as many vertices and tets as `like`; moves `place` behind it.
TetMesh take_mesh(const TetMesh& all, const TetMesh& like, MeshPlace& place);

/// A regular tet of that volume in the middle of a box.
LatticeMesh single_tet(const Box3& box, double volume);

}  // namespace tetsoup
