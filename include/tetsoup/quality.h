// tetsoup: is this tet mesh fit for simulation? All numbers a report shows are measured here.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "tetsoup/soup.h"
#include "tetsoup/types.h"

namespace tetsoup {

inline constexpr std::size_t kDihedralBins = 36;  ///< Of 5 degrees each.

struct Quality {
  std::size_t vertex_count = 0;
  std::size_t tet_count = 0;
  std::size_t inverted_tets = 0;    ///< Signed volume <= 0, or not a number.
  std::size_t invalid_tets = 0;     ///< Index out of range, or a vertex used twice: counted, otherwise ignored.
  std::size_t unused_vertices = 0;  ///< Of no tet, or of invalid tets only.
  double volume = 0;                ///< Sum of the signed volumes; those that are not finite are left out.
  double min_tet_volume = 0, max_tet_volume = 0;  ///< Signed; of the finite ones.
  double volume_variation = 0;  ///< Standard deviation of the tets' volumes over their mean; of the positive ones.
  double min_dihedral = 0, max_dihedral = 0;                    ///< Radians; over all tets with a volume, of any sign.
  double min_dihedral_p1 = 0;                                   ///< One tet in a hundred has a smallest angle below it.
  std::array<std::size_t, kDihedralBins> dihedral_histogram{};  ///< Six angles a tet.
  double max_edge_ratio = 0;  ///< Longest over shortest edge of a tet, worst tet with a volume.
  /// 12 (3 V)^(2/3) / sum of squared edges: 1 = regular, 0 = flat or inverted.
  double mean_ratio_min = 0, mean_ratio_mean = 0;
  std::size_t components = 0;  ///< Joined through shared faces.
  std::size_t boundary_triangles = 0;
  std::size_t boundary_vertices = 0;
  bool boundary_closed = false;  ///< Every boundary edge has an even number of boundary triangles, no face three tets.
  std::size_t non_manifold_edges = 0;     ///< Boundary edges without exactly two boundary triangles.
  std::size_t non_manifold_vertices = 0;  ///< Boundary vertices whose boundary triangles do not form one fan.
  bool boundary_manifold = false;         ///< Closed, and neither of the two above.
  std::size_t boundary_only_tets = 0;     ///< All four vertices on the boundary.
  std::size_t boundary_only_faces = 0;    ///< Interior faces with three vertices on the boundary,
  std::size_t boundary_only_edges = 0;    ///< and interior edges with two: they stiffen what bends, and lock contacts.
  double roughness = 0;  ///< Radians; mean angle between the normals of boundary triangles that share an edge.
  double boundary_area = 0;
  /// Integral of the boundary's mean curvature without its sign: half the sum of length x angle over its edges. Unlike
  /// the roughness it does not depend on how finely a smooth surface is divided.
  double boundary_curvature = 0;
};

/// Measures a mesh, valid or not. Never throws on geometry; where there is nothing to measure a number stays 0.
/// Cost: O(tets log tets).
Quality measure_quality(const TetMesh& mesh);

/// One tet, for colouring; 0 where it is invalid or has no volume.
struct TetQuality {
  float mean_ratio = 0;    ///< As above.
  float min_dihedral = 0;  ///< Smallest of its six angles, radians.
};
std::vector<TetQuality> measure_tets(const TetMesh& mesh);

/// The mesh's outer and inner boundary triangles (faces of exactly one tet), counter-clockwise from outside a positive
/// tet, indices into the mesh's vertices, in the order of the tets. Invalid tets have none.
std::vector<Triangle> boundary_triangles(const TetMesh& mesh);

/// Those of boundary_triangles() that bound a closed space in the mesh's midst, from which no way leads out: connected
/// surfaces that turn their back on what they enclose. Pressure on them blows the mesh up.
std::vector<Triangle> cavity_triangles(const TetMesh& mesh);

/// How far a mesh's boundary lies from a soup.
struct BoundaryDistance {
  double mean = 0;          ///< Over the boundary's area,
  double percentile95 = 0;  ///< and what 95 % of it is within.
};

/// Distance from points all over the boundary (10 a triangle, weighted by area) to the nearest point of the soup, in
/// multiples of `unit`, such as the mean edge of the lattice. All 0 if either is empty.
/// Cost: O((boundary + triangles) log triangles); all threads.
BoundaryDistance boundary_distance(const TetMesh& mesh, const TriangleSoup& soup, double unit);

/// What became of a soup's shape in a mesh of it. Edges are the mesh's mean edge, each counted as often as it has tets.
struct Fidelity {
  double mean_edge = 0;  ///< In the soup's unit.
  /// Size of the largest stretch of the soup, held together by its surface, that the mesh does not reach: it is farther
  /// from the mesh than three quarters of an edge. In edges, as all below that are not shares.
  double lost_edges = 0;
  std::size_t lost_stretches = 0;  ///< Those longer than 1.5 edges.
  bool closed = false;             ///< Every edge of the soup has two triangles: it has a volume to compare with.
  double soup_volume = 0;          ///< Of a closed soup; where its parts overlap they count once, to about a hundredth.
  double volume_ratio = 1;         ///< Volume of the mesh over that.
  double wall_edges = 0;           ///< Twice volume over area of a closed soup: how thick it is where it is thin.
  double volume_limit = 1;         ///< What the ratio may be: 1.1, more where walls are thinner than half an edge.
  double stray_share = 0;  ///< Of the mesh's volume, outside a closed soup and farther than half an edge from it.
  std::size_t soup_pieces =
      0;  ///< What hangs together at a 256th of the soup's longest side; a 128th for a mesh of one piece.
  std::size_t mesh_pieces = 0;    ///< Joined through faces.
  std::size_t torn_pieces = 0;    ///< Pieces of the mesh beyond one of what hangs together in the soup.
  std::size_t joined_pieces = 0;  ///< Pieces of the soup that the mesh joins to another, which they do not touch.
  std::size_t lost_pieces = 0;    ///< Pieces of the soup that the mesh does not reach.
  double soup_tunnels = 0, mesh_tunnels = 0;  ///< Through both, where the soup is closed and one part; else 0.
  std::size_t overlapping_pairs = 0;          ///< Tets of one piece that lie in each other,
  double overlap_share = 0;                   ///< and the share of the mesh's volume that lies in two of them.
  std::size_t apart_pairs = 0;                ///< The same of tets of two pieces, as where parts are kept apart that
  double apart_share = 0;                     ///< share a place.
  bool flat = false;                          ///< The soup is closed and made of planes and sharp edges only.
  double tilted_share =
      0;  ///< Of such a soup: share of the boundary's area more than 25 degrees off the soup beside it.
};

/// Compares a mesh with the soup that it stands for, whatever lay between them: by points on the soup's surface, and
/// along lines through both. The soup has distinct positions. Windings count where they agree all over it: shells that
/// turn their outside inwards are cavities then.
/// Cost: O(n log n), some 10 ms for 2,000 tets and 70,000 triangles; the same bits for any number of threads.
Fidelity measure_fidelity(const TetMesh& mesh, const TriangleSoup& soup);
/// The same with the windings that the soup was given in.
Fidelity measure_fidelity(const TetMesh& mesh, const CleanSoup& soup);

/// Intersection over union of the voxels whose centre lies in the mesh with the `inside` voxels; 1 if both are empty.
///
/// Voxels that the mesh covers beyond the grid count as not inside, as far as the grid's longest side away from it. A
/// centre within a millionth of a voxel of a tet lies in it; a tet without volume, or not finite, covers nothing.
/// Cost: O(tets + voxels of the grid + rows of voxels in the tets' boxes); all threads.
double intersection_over_union(const TetMesh& mesh, const BitGrid& inside);

}  // namespace tetsoup
