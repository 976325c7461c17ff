// tetsoup: which part of the input a tet belongs to, and which vertices are to be held.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "tetsoup/progress.h"
#include "tetsoup/types.h"

namespace tetsoup {

/// Some of a mesh's vertices, by a name.
struct VertexSet {
  std::string name;
  std::vector<std::uint32_t> vertices;  ///< Ascending.
  bool operator==(const VertexSet&) const = default;
};

/// The label of the soup's triangle that is nearest to each tet's centre; among equally near ones the lowest label.
///
/// @param labels  One for every triangle of the soup.
/// @return        One for every tet; all 0 if no triangle is usable.
/// @throws InvalidInput  if there are not as many labels as triangles; Cancelled.
/// Cost: O((tets + triangles) log triangles); all threads.
std::vector<std::uint32_t> label_tets(const TetMesh& mesh, const TriangleSoup& soup,
                                      std::span<const std::uint32_t> labels, const Progress& progress = {});

/// The same for the mesh's vertices.
std::vector<std::uint32_t> label_vertices(const TetMesh& mesh, const TriangleSoup& soup,
                                          std::span<const std::uint32_t> labels, const Progress& progress = {});

/// The connected part of every triangle of a soup, for models that name nothing: triangles that share a vertex, equal
/// positions being one, are of one part.
///
/// @return  One for every triangle, from 0 in the order of their numbers of triangles, the largest first; of equally
///          large ones that of the earlier triangle. 0 where a triangle is not usable.
/// Cost: O(n) time and memory.
std::vector<std::uint32_t> label_parts(const TriangleSoup& soup);

/// Vertices in a box of the input's place, its faces included.
std::vector<std::uint32_t> vertices_in_box(const TetMesh& mesh, const Box3& box);

/// Vertices with dot(normal, vertex) <= offset. @throws InvalidInput  if the normal is zero or not finite.
std::vector<std::uint32_t> vertices_below(const TetMesh& mesh, const Vec3d& normal, double offset);

}  // namespace tetsoup
