// tetsoup: which part of the input a tet belongs to, and which vertices are to be held.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "tetsoup/progress.h"
#include "tetsoup/smooth.h"
#include "tetsoup/types.h"

namespace tetsoup {

/// Some of a mesh's vertices, by a name.
struct VertexSet {
  std::string name;
  std::vector<std::uint32_t> vertices;  ///< Ascending.
  bool operator==(const VertexSet&) const = default;
};

/// How much of a tet has a label.
struct LabelShare {
  std::uint32_t label = 0;
  float share = 0;  ///< Of its volume, in (0, 1].
};

/// The labels of a mesh's tets.
struct TetLabels {
  std::vector<std::uint32_t> first;  ///< Of each tet its first share; one more at the end.
  std::vector<LabelShare> shares;    ///< Of a tet the largest first, of equal ones the lowest label; their sum is 1.

  std::size_t size() const { return first.empty() ? 0 : first.size() - 1; }
  std::span<const LabelShare> operator[](std::size_t tet) const {
    return std::span(shares).subspan(first[tet], first[tet + 1] - first[tet]);
  }
};

/// How much of every tet lies in which part of the input.
///
/// A place belongs to the closed part around it (every edge has an even number of triangles of that label): of several
/// the innermost, which is the one of the least volume, and of equal ones that of the lowest label. A hollow space that
/// a label's own shells leave is not in it. Where no closed part is around, or a triangle of an open part is nearer
/// than any other, the nearest triangle decides. Tets that a surface may pass through are asked at 20 points.
///
/// @param labels  One for every triangle of the soup.
/// @return        One list for every tet; label 0 alone if no triangle is usable.
/// @throws InvalidInput  if there are not as many labels as triangles; Cancelled.
/// Cost: O((tets + triangles) log triangles); mostly on all threads.
TetLabels share_tets(const TetMesh& mesh, const TriangleSoup& soup, std::span<const std::uint32_t> labels,
                     const Progress& progress = {});

/// The label of which each tet has most.
std::vector<std::uint32_t> label_tets(const TetMesh& mesh, const TriangleSoup& soup,
                                      std::span<const std::uint32_t> labels, const Progress& progress = {});

/// The same of what is known already.
std::vector<std::uint32_t> largest_of(const TetLabels& labels);

/// Moves the vertices so that faces of tets follow the borders between labels, as smoothing draws the boundary to the
/// surface: layers come out as layers. Where tets have corners on both sides, inner edges that cross the border are
/// removed, so that some tets are replaced by others of the same vertices. The boundary keeps its shape; the limits of
/// `options` are kept, its passes and snapping are not looked at. Where no part is closed the mesh stays as it is.
///
/// @throws InvalidInput  as share_tets() and smooth_tets() do; Cancelled.
/// Cost: a few times that of share_tets().
TetMesh fit_to_labels(const TetMesh& mesh, const TriangleSoup& soup, std::span<const std::uint32_t> labels,
                      const SmoothOptions& options = {}, const Progress& progress = {});

/// The label of the soup's triangle that is nearest to each vertex; among equally near ones the lowest label.
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
