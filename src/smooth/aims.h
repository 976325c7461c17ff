// Where the boundary's triangles should come to lie: at the surface of the pseudo volume.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "base/triangle_samples.h"
#include "smooth/connectivity.h"
#include "smooth/guard.h"
#include "tetsoup/types.h"

namespace tetsoup {

/// A sample should come to lie where dot(normal, x) = offset.
struct Aim {
  Vec3d normal;
  double offset = 0;
  bool in_reach = false;
};

struct TriangleAim {
  /// At points of the triangle: fitted are the triangles and not the vertices, whose chords would lose volume.
  std::array<Aim, kSamples> samples;
  Vec3d normal;  ///< Mean of those of its corners: how it would lie on a smooth boundary.
  double area = 0;
};

/// Unit normals by vertex; zero inside and where the triangles around cancel out.
std::vector<Vec3d> unit_normals(const Connectivity& links, const GuardedMesh& mesh);

/// Looks from every sample along the normal for the place where the voxels change: outwards from an inside voxel,
/// inwards from an outside one, as far as `reach`; inwards twice as far in layers one tet thick, so that both faces are
/// drawn to the two surfaces of a thin wall.
///
/// @param normals  As unit_normals() gives them.
/// @param level  How far outside of there the boundary should lie.
std::vector<TriangleAim> aim_at_surface(const Connectivity& links, const GuardedMesh& mesh,
                                        std::span<const Vec3d> normals, const BitGrid& inside, double reach,
                                        double level, StageWatch& watch);

}  // namespace tetsoup
