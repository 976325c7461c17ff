// Planes of the soup larger than a tet, in which the boundary should come to lie plane.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/parallel.h"
#include "base/soup_planes.h"
#include "base/triangle_boxes.h"
#include "smooth/aims.h"
#include "smooth/connectivity.h"
#include "smooth/guard.h"
#include "tetsoup/types.h"

namespace tetsoup {

/// Rays from a boundary blunt what is sharp: a triangle that spans an edge of the soup is held to both sides of it, and
/// comes to lie across. So triangles of the soup that lie in one plane are gathered, connected or not, and where they
/// are as wide as a tet every boundary triangle near them is laid into one plane as a whole. Borders between planes
/// are short; the vertices on them are drawn to both planes, and so to the crease, or to three and the corner. Layers
/// of one tet are left alone: both their faces are drawn to a wall thinner than they can be.
class PlaneFit {
 public:
  /// @param edge  Mean edge of the mesh: a plane's width is at least as much.
  /// The links must outlive this. O(triangles), the large ones sorted.
  PlaneFit(const TriangleSoup& soup, const Connectivity& links, double edge, StageWatch& watch);

  /// Every triangle whose aims lie in a plane of the soup gets that plane as aim. O(boundary triangles log soup).
  /// @param reach  How far from the places that the aims found a plane may lie, about a voxel.
  /// @param level  How far outside of it the boundary should lie, as in aim_at_surface().
  /// @return  By vertex, whether it lies between triangles of different planes; empty where the soup has none.
  std::vector<std::uint8_t> lay(const GuardedMesh& mesh, double reach, double level, std::vector<TriangleAim>& aims,
                                StageWatch& watch) const;

 private:
  /// What a boundary triangle's samples found.
  struct Found {
    std::array<std::uint32_t, kSamples> planes;
    Vec3d normal, smooth_normal;  ///< Of the triangle, and as it would lie on a smooth boundary.
  };

  std::uint32_t plane_near(const Vec3d& p, const Vec3d& normal, double reach) const;
  Found find(std::size_t t, const TriangleAim& aim, const GuardedMesh& mesh, double reach, double level) const;
  SoupPlane outwards(std::uint32_t plane, const Found& found) const;
  double cost(std::size_t t, std::uint32_t plane, const std::vector<Found>& found,
              const std::vector<std::uint32_t>& label) const;
  std::vector<std::uint32_t> settle(const std::vector<Found>& found) const;

  const Connectivity* links_;
  double edge_;
  std::vector<SoupPlane> planes_;
  TriangleSoup soup_;                                 ///< Triangles that lie in planes,
  std::vector<std::uint32_t> plane_of_;               ///< and in which.
  std::optional<TriangleBoxes> boxes_;                ///< Around them; none without planes.
  std::vector<std::array<std::uint32_t, 3>> beside_;  ///< By boundary triangle: those across its edges.
};

}  // namespace tetsoup
