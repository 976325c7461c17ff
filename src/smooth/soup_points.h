// Points of the soup that the mesh reaches when smoothing begins, and what holds it there.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/groups.h"
#include "base/parallel.h"
#include "smooth/connectivity.h"
#include "tetsoup/types.h"

namespace tetsoup {

/// A place of a boundary triangle that should come to lie where dot(normal, x) >= offset.
struct Pull {
  std::array<double, 3> weights{};  ///< Of the triangle's corners.
  Vec3d normal;
  double offset = 0;
};

/// Rays from the boundary find the surface of what is thick. From the rim of a sheet or the end of a rod thinner than a
/// tet they find its sides, and draw the rim in. So the soup is asked as well: where a point of it that lay in the mesh
/// or beside it gets farther away than a share of an edge, the triangle nearest to it is pulled.
class SoupPoints {
 public:
  /// @param edge  Mean edge of the mesh, the unit of all distances here.
  /// O(soup's vertices and area + points log triangles), all threads.
  SoupPoints(const TriangleSoup& soup, const Connectivity& links, const TetMesh& mesh, double edge, StageWatch& watch);

  /// What pulls at every boundary triangle as the mesh lies now. It follows the mesh from call to call.
  ///
  /// @param normals  As unit_normals() gives them.
  Groups<Pull> pulls(const Connectivity& links, const TetMesh& mesh, std::span<const Vec3d> normals, StageWatch& watch);

 private:
  struct Point {
    Vec3d at;
    std::uint32_t triangle = 0;  ///< Of the boundary, the nearest.
  };

  void find_nearest(const Connectivity& links, const TetMesh& mesh, StageWatch& watch);

  double edge_;
  std::vector<Point> points_;
};

}  // namespace tetsoup
