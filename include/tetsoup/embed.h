// tetsoup: a surface of any fineness hangs on the tets, and moves with them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tetsoup/progress.h"
#include "tetsoup/types.h"

namespace tetsoup {

struct EmbedOptions {
  /// How far beyond the mesh a point may be extrapolated, in heights of its tet above the face that is nearest, >= 0.
  double max_extrapolation = 4;
  bool operator==(const EmbedOptions&) const = default;
};

struct EmbedReport {
  std::size_t inside = 0;        ///< Points in the mesh, within rounding.
  std::size_t outside = 0;       ///< Points beyond it, hung on the nearest tet.
  std::size_t drawn_closer = 0;  ///< Those of them that max_extrapolation has drawn towards the mesh.
  std::size_t other_copy = 0;    ///< Points that another copy of the tets is nearer to than that of their own piece.
  std::size_t non_finite = 0;    ///< Points that are none: hung on the first vertex of the first tet.
  double max_distance = 0;       ///< Of the points outside from the mesh, in the mesh's unit.
};

/// Where points lie in a tet mesh: N points, in their own order.
struct Embedding {
  std::vector<std::uint32_t> tets;            ///< (N)
  std::vector<std::array<float, 4>> weights;  ///< (N) barycentric, sum 1; negative or above 1 outside the tet.
  std::vector<float> distances;               ///< (N) from the mesh; 0 inside.
  EmbedReport report;
};

/// Hangs every vertex of a soup on a tet.
///
/// A point inside the mesh takes the tet that holds it (the first of several on a common face), one outside the tet
/// with the nearest boundary triangle, linearly extrapolated. Where copies of tets lie in one place (Separate::Apart),
/// the soup's triangles tell which copy is meant: that in which the point's own connected piece of the soup lies around
/// it. Without triangles every point stands alone.
///
/// @throws InvalidInput  if the mesh has no tet or an index is out of range, or an option is; Cancelled.
/// Cost: O(points log tets); all threads.
Embedding embed_points(const TetMesh& mesh, const TriangleSoup& soup, const EmbedOptions& options = {},
                       const Progress& progress = {});

/// The embedded points after the mesh's vertices have moved to `positions`: sum of weight x corner, exact at rest and
/// under any affine map but for rounding.
///
/// @param tets       The mesh's own.
/// @param positions  (P) of the mesh's vertices.
/// @return           (N) points.
/// @throws InvalidInput  if an index is out of range.
/// Cost: about 5 ns a point and thread.
std::vector<Vec3> deform_points(const Embedding& embedding, std::span<const Tet> tets, std::span<const Vec3> positions);

/// Unit normals of the embedded points after the deformation: the cofactor of the tet's deformation gradient, times the
/// normal at rest. Where a tet is flat or a normal is zero, the normal stays what it was.
///
/// @param rest     The mesh at rest.
/// @param normals  (N) at rest.
/// @throws InvalidInput  if sizes differ or an index is out of range.
std::vector<Vec3> deform_normals(const Embedding& embedding, const TetMesh& rest, std::span<const Vec3> positions,
                                 std::span<const Vec3> normals);

/// Nodes in the middle of a mesh's edges, which make ten-node tets of it.
struct Midsides {
  std::vector<std::array<std::uint32_t, 2>> edges;  ///< Each once, the lower vertex first, ascending.
  std::vector<Vec3> places;                         ///< Of every edge, counted from the mesh's origin.
  std::size_t moved = 0;                            ///< From the middle of the edge to the surface.
  std::size_t held_back = 0;  ///< Left between the two, or in the middle, lest a tet be too crooked.
};

/// Puts the nodes of boundary edges on the surface that the mesh was made of, all others halfway: the usual remedy for
/// coarse tets, which are too stiff.
///
/// A node goes to the nearest point of the soup, at most a quarter of its edge away, where the determinants of the tets
/// around keep .3 of what they are with straight edges; else a part of the way, or not at all.
///
/// @throws InvalidInput  if an index is out of range; Cancelled.
/// Cost: O((edges + triangles) log triangles).
Midsides place_midsides(const TetMesh& mesh, const TriangleSoup& soup, const Progress& progress = {});

}  // namespace tetsoup
