// tetsoup, stage 5: round the lattice's corners off, keep the volume, never harm a tet.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tetsoup/progress.h"
#include "tetsoup/types.h"

namespace tetsoup {

/// What the boundary is drawn to.
enum class Snap {
  Surface,  ///< The surface of the pseudo volume, where one is given.
  Off,      ///< Nothing: it is only faired.
};

struct SmoothOptions {
  int passes = 6;       ///< 0..1000; 0 leaves the mesh as it is.
  double strength = 1;  ///< Of the fairing, > 0 [Desbrun99 §3]; 1: a time step of one squared edge.
  double min_dihedral = 0.4363323129985824;  ///< Least dihedral angle (25 degrees), radians in [0, pi/3).
  double max_dihedral = 2.705260340591211;   ///< Largest dihedral angle (155 degrees), radians in [pi/2, pi].
  double max_edge_ratio = 3.5;               ///< Longest over shortest edge of a tet, >= 1.
  Snap snap = Snap::Surface;
  bool operator==(const SmoothOptions&) const = default;
};

enum class Stay {
  Free,
  WithinVolume,  ///< The mesh takes in no voxel that is outside and was not in it at the start.
};

/// What smoothing may know besides the mesh.
struct SmoothTarget {
  const BitGrid* inside = nullptr;      ///< The pseudo volume whose surface the boundary is drawn to.
  std::optional<double> volume = {};    ///< Of what the voxels show, where it is known; absent: they are counted.
  const TriangleSoup* soup = nullptr;   ///< Its planes, and what the mesh reaches of it at the start.
  std::span<const Vec3> enclosed = {};  ///< Those of them that lie in the mesh at the start stay in it, the others out.
  Stay stay = Stay::Free;
};

struct SmoothReport {
  int passes = 0;
  bool snapped = false;  ///< The boundary was drawn to the pseudo volume.
  std::size_t boundary_vertices = 0;
  std::size_t shortened_moves = 0;  ///< Moves the limits cut short, over all passes.
  double volume_before = 0;
  double volume_after = 0;
  /// What the volume should be: that before, kept within 1e-4; snapped, the target's, if the mesh began within a tenth
  /// of the voxels' or the fit would leave it up to a fifth too small (else it is what the fit gives, and this is 0).
  double volume_wanted = 0;
  double min_dihedral = 0;  ///< After smoothing, radians.
  /// For each boundary vertex, in ascending vertex order: volume of the tets around it, after over before.
  std::vector<float> boundary_volume_ratio;
  std::vector<std::string>
      notes;  ///< What the user should know, and the option that changes it: one sentence or two each.
};

struct SmoothResult {
  TetMesh mesh;  ///< Same tets, moved vertices.
  SmoothReport report;
};

/// Smooths the boundary by implicit fairing and lets the interior follow harmonically, volume kept.
///
/// Each pass solves (I - lambda L) x' = x for the boundary [Desbrun99 §3], pushes the locally lost volume back along
/// the normals [Spillmann06 §4], and relaxes the interior to the average of its neighbours. Every move is shortened
/// until no tet around it is inverted or beyond a limit (or beyond what it had, where that was worse). Swept volume
/// counts from the start, so many passes converge. In the end every part of the mesh (tets joined through vertices) has
/// its volume again; one that cannot within the limits goes back towards its start until it can.
///
/// @throws InvalidInput  if an option is out of range or a tet of the input is not positive; Cancelled.
/// Cost: O(passes x tets), O(tets) memory.
SmoothResult smooth_tets(const TetMesh& mesh, const SmoothOptions& options = {}, const Progress& progress = {});

/// The same, or with Snap::Surface and a target: fits the boundary's triangles to the surface of the pseudo volume.
///
/// Each pass looks from points of every boundary triangle for the surface, then moves every vertex once to the least
/// of three things weighed against each other: the distance of the triangles around it from there, the bending of the
/// boundary, and the shape of its tets, 1 / q^3 with the mean ratio q. All moves keep the limits as above. The volume
/// of the whole comes out as the target's. Both faces of a layer one tet thick are drawn to the two of the wall in it.
/// With a soup, its planes go before the voxels where they are wider than a tet, so that edges and corners between them
/// are met; and points of it that the mesh reached and draws back from pull as well: without, a layer of tets around a
/// sheet shrinks at its rim. Cost: O(passes x tets), whatever the size of the grid.
SmoothResult smooth_tets(const TetMesh& mesh, const SmoothTarget& target, const SmoothOptions& options = {},
                         const Progress& progress = {});

/// A point of a triangle of a mesh, and the plane that it should come to lie on.
struct FaceAim {
  Triangle corners{};
  std::array<double, 3> weights{};  ///< Of the corners.
  Vec3d normal;                     ///< Unit,
  double offset = 0;                ///< and the plane where dot(normal, x) is this, counted from the mesh's origin.
  double area = 0;                  ///< Of the triangle, that the point stands for.
};

/// Draws triangles of a mesh to planes, as smooth_tets() draws the boundary to a surface: every vertex moves twice to
/// the least of what its aims and the shapes of its tets say. A boundary that is to keep its place needs aims too. All
/// moves keep the limits of the options.
///
/// @throws InvalidInput  if an option is out of range or a tet of the input is not positive; Cancelled.
/// Cost: O(tets + aims).
TetMesh draw_faces(const TetMesh& mesh, std::span<const FaceAim> aims, const SmoothOptions& options = {},
                   const Progress& progress = {});

}  // namespace tetsoup
