// The distinct corners, edges and faces of a soup, in voxel units, and which of them meet.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/groups.h"
#include "base/parallel.h"
#include "kernel/triangle_distance.h"
#include "tetsoup/soup.h"

namespace tetsoup {

struct SoupFeatures {
  struct Edge {
    std::uint32_t from, to;               ///< Corners, the lower first.
    std::uint32_t first_side, last_side;  ///< Range in `sides`.
  };
  std::span<const Triangle> triangles;  ///< Of the soup the features were found in.
  std::vector<Vec3> corners;            ///< Voxel centres are the whole numbers.
  std::vector<Edge> edges;              ///< By lower corner.
  std::vector<kernel::FacePlan> faces;  ///< One a triangle.
  std::vector<std::uint32_t> sides;     ///< 4 face + side for the sides of all edges: side i of a FacePlan.
  Groups<std::uint32_t> spokes;         ///< The edges that meet in each corner.
};

/// The soup on the grid: planned from double coordinates, so position and scale of the soup cost no precision.
std::vector<Vec3> voxel_vertices(const CleanSoup& soup, const GridFrame& frame);

SoupFeatures find_features(const CleanSoup& soup, const GridFrame& frame, StageWatch& watch);

}  // namespace tetsoup
