// The voxels whose centres lie in a tet mesh.
#pragma once

#include <cstddef>

#include "base/parallel.h"
#include "tetsoup/types.h"

namespace tetsoup {

struct MeshVoxels {
  std::size_t in_mesh = 0, in_both = 0;  ///< In the mesh, and of these in `inside`.
  MeshVoxels& operator+=(const MeshVoxels& other) {
    in_mesh += other.in_mesh;
    in_both += other.in_both;
    return *this;
  }
};

/// Voxels beyond the grid are not inside; they count as far as the grid's longest side away from it. A centre within a
/// millionth of a voxel of a tet lies in it; a tet without volume, or not finite, holds nothing.
MeshVoxels count_mesh_voxels(const TetMesh& mesh, const BitGrid& inside, StageWatch& watch);

}  // namespace tetsoup
