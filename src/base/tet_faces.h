// Which faces of a tet mesh are shared and which are its boundary; smoothing and quality both ask.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tetsoup/types.h"

namespace tetsoup {

/// One side of a tet: face `slot % 4` (as in kTetFaces) of tet `slot / 4`.
struct TetFace {
  std::array<std::uint32_t, 3> corners;  ///< Ascending: the same for all tets that share the face.
  std::uint64_t slot;
};

/// Four distinct indices, all in range.
bool is_valid_tet(const Tet& tet, std::size_t vertex_count);

/// The four faces of every valid tet, equal corners next to each other.
std::vector<TetFace> sorted_faces(const TetMesh& mesh);

/// End of the run of faces that share their corners with `faces[begin]`.
std::size_t face_run_end(const std::vector<TetFace>& faces, std::size_t begin);

/// The slots of the faces that exactly one tet has, ascending.
std::vector<std::uint64_t> lone_slots(const std::vector<TetFace>& faces);

/// The face at a slot, counter-clockwise from outside of a positive tet.
Triangle face_at(const TetMesh& mesh, std::uint64_t slot);

/// The faces that exactly one tet has, in the order of the tets, counter-clockwise from outside of a positive tet.
std::vector<Triangle> lone_faces(const TetMesh& mesh, const std::vector<TetFace>& faces);

}  // namespace tetsoup
