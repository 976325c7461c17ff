// The boundary of a tet mesh and its pieces.
#pragma once

#include <cstdint>
#include <vector>

#include "base/tet_faces.h"
#include "base/tet_geometry.h"
#include "base/unions.h"
#include "tetsoup/types.h"

namespace tetsoup {

struct MeshSkin {
  std::vector<Triangle> triangles;          ///< Counter-clockwise from outside.
  std::vector<std::uint32_t> triangle_tet;  ///< Whose face each is.
  std::vector<std::uint32_t> piece;  ///< Of every tet: joined through faces; invalid tets are pieces of their own.
  std::uint32_t pieces = 0;          ///< Of valid tets; numbered from 0.
  double mean_edge = 0;              ///< Over the tets' edges, each as often as it has tets.
};

inline MeshSkin find_skin(const TetMesh& mesh) {
  const std::vector<TetFace> faces = sorted_faces(mesh);
  MeshSkin skin;
  for (const std::uint64_t slot : lone_slots(faces)) {
    skin.triangles.push_back(face_at(mesh, slot));
    skin.triangle_tet.push_back(static_cast<std::uint32_t>(slot / 4));
  }
  Unions tets(mesh.tets.size());
  for (std::size_t i = 1; i < faces.size(); ++i)
    if (faces[i].corners == faces[i - 1].corners) tets.join(faces[i - 1].slot / 4, faces[i].slot / 4);
  skin.piece.assign(mesh.tets.size(), 0);
  double edges = 0;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    if (!is_valid_tet(mesh.tets[t], mesh.vertices.size())) continue;
    skin.piece[t] = tets.find(t) == t ? skin.pieces++ : skin.piece[tets.find(t)];
    const TetCorners p = corners_of(mesh, mesh.tets[t]);
    for (const auto& [i, j] : kTetEdges) {
      skin.mean_edge += length(p[static_cast<std::size_t>(i)] - p[static_cast<std::size_t>(j)]);
      ++edges;
    }
  }
  if (edges > 0) skin.mean_edge /= edges;
  return skin;
}

}  // namespace tetsoup
