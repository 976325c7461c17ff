// Normals at the corners of triangles, smooth but across creases; windings may be anything.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tetsoup/types.h"

namespace tetsoup::animation {

/// A crease is where the triangles of a vertex lie more than this apart from their mean.
inline constexpr double kCreaseCosine = 0.72;  // 44 degrees: a cube's corners stay sharp, a dodecagon's are round

struct SurfaceNormals {
  std::vector<Vec3> of_vertices, of_triangles;  ///< Unit, or zero where there is no area.

  SurfaceNormals(std::span<const Vec3> points, std::span<const Triangle> triangles);
  /// Whether a corner takes its vertex's normal; else it takes its triangle's.
  bool is_smooth(const Triangle& triangle, std::size_t index, std::size_t corner) const;
};

}  // namespace tetsoup::animation
