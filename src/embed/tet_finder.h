// The tet on which a point hangs.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/tet_locator.h"
#include "base/triangle_boxes.h"
#include "tetsoup/types.h"

namespace tetsoup {

class TetFinder {
 public:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  /// Indices are valid, vertices finite, and some tet has four different ones; the mesh must outlive this. O(tets).
  TetFinder(const TetMesh& mesh, StageWatch& watch);

  /// The first tet that holds the point, or kNone.
  std::uint32_t holder(const Vec3d& point) const;
  bool holds(std::uint32_t tet, const Vec3d& point) const { return locator_.holds(tet, point); }
  /// Whether the point lies well inside of two tets, as it does where there are copies.
  bool is_in_several(const Vec3d& point) const;
  /// The tet of the nearest boundary triangle; of equally near ones that which the point is least far beyond, then the
  /// first. `near` is a triangle to begin with, 0 at first, and becomes the nearest.
  std::uint32_t nearest(const Vec3d& point, std::uint32_t& near) const;

 private:
  const TetMesh& mesh_;
  TetLocator locator_;
  std::vector<std::uint64_t> slots_;  ///< Of the boundary's triangles.
  TriangleSoup boundary_;
  TriangleBoxes boxes_;
  /// A boundary triangle in the unit of the boxes.
  struct Face {
    std::array<Vec3d, 3> corners;
    Vec3d centre;
    double radius = 0;  ///< Of a ball around the centre.
  };
  std::vector<Face> faces_;
};

}  // namespace tetsoup
