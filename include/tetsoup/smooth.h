// tetsoup, stage 5: round the lattice's corners off, keep the volume, never harm a tet.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tetsoup/progress.h"
#include "tetsoup/types.h"

namespace tetsoup {

struct SmoothOptions {
  int passes = 5;       ///< 0..1000; 0 leaves the mesh as it is.
  double strength = 1;  ///< Time step of the fairing in squared mean edge lengths, > 0 [Desbrun99 §3].
  double min_dihedral = 0.26179938779914943;  ///< Quality floor (15 degrees), radians in [0, pi/3).
  bool operator==(const SmoothOptions&) const = default;
};

struct SmoothReport {
  int passes = 0;
  std::size_t boundary_vertices = 0;
  std::size_t shortened_moves = 0;  ///< Moves the floor cut short, over all passes.
  double volume_before = 0;
  double volume_after = 0;  ///< Within 1e-4 of volume_before, relatively.
  double min_dihedral = 0;  ///< After smoothing, radians.
  /// For each boundary vertex, in ascending vertex order: volume of the tets around it, after over before.
  std::vector<float> boundary_volume_ratio;
};

struct SmoothResult {
  TetMesh mesh;  ///< Same tets, moved vertices.
  SmoothReport report;
};

/// Smooths the boundary by implicit fairing and lets the interior follow harmonically, volume kept.
///
/// Each pass solves (I - lambda L) x' = x for the boundary [Desbrun99 §3], pushes the locally lost volume back along
/// the normals [Spillmann06 §4], and relaxes the interior to the average of its neighbours. Every move is shortened
/// until no tet around it is inverted or has a dihedral angle below the floor (or below what it had, where that was
/// lower). Swept volume counts from the start, so many passes converge. In the end every part of the mesh (tets joined
/// through vertices) has its volume again; one that cannot within the limits goes back towards its start until it can.
///
/// @throws InvalidInput  if an option is out of range or a tet of the input is not positive; Cancelled.
/// Cost: O(passes x tets), O(tets) memory.
SmoothResult smooth_tets(const TetMesh& mesh, const SmoothOptions& options = {}, const Progress& progress = {});

}  // namespace tetsoup
