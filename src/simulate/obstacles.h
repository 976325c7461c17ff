// What does not move: planes, and signed distances on a grid.
#pragma once

#include <optional>

#include "base/vec.h"
#include "tetsoup/progress.h"
#include "tetsoup/types.h"

namespace tetsoup::simulate {

/// Bodies stay where `distance_from` is positive.
struct Obstacle {
  Vec3d normal;       ///< Of the plane dot(normal, p) = offset, a unit vector;
  double offset = 0;  ///< without meaning where there is a field.
  double friction = 0;
  std::optional<Grid<float>> field;
};

/// Signed distance and the direction in which it grows.
struct Clearance {
  double distance = 0;
  Vec3d normal;
};

/// Nothing if p is off the field's grid, or the field is flat there.
std::optional<Clearance> distance_from(const Obstacle& obstacle, const Vec3d& p);

/// Of the pseudo volume of a soup: positive outside.
Grid<float> signed_distance(const TriangleSoup& soup, int voxels, const Progress& progress);

}  // namespace tetsoup::simulate
