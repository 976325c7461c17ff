// Lattices whose cells end where flat sides of the soup lie.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "base/parallel.h"
#include "lattice/fit_points.h"
#include "tetsoup/types.h"

namespace tetsoup {

/// Three directions at right angles to each other that most of a soup's planes face, and where these lie.
struct FlatSides {
  struct Axis {
    Vec3d direction;
    double lo = 0, hi = 0;  ///< The outermost planes along it, or the soup's ends where there are fewer than two.
    struct Side {
      double offset, share;  ///< Share of the area of all planes.
    };
    std::vector<Side> sides;
  };
  std::array<Axis, 3> axes;
  Vec3d rotate;  ///< Of a lattice along them.
};

/// None where less than half of the soup's area lies in planes along three such directions.
///
/// @param width  Planes are at least as wide.
std::optional<FlatSides> find_flat_sides(const TriangleSoup& soup, double width, StageWatch& watch);

struct AlignedPlace {
  Place place;
  double volume = 0;      ///< Of the soup that a cell takes in.
  bool is_layer = false;  ///< A plate or a bar thinner than cells may be lies within one layer of them.
  double unfit = 0;       ///< How far planes are from faces of the cells, and cells from cubes.
};

/// Places in which a whole number of cells fills the way between the outermost planes along every axis, with cells of
/// about the given size and edges that are nearly equal; best first.
std::vector<AlignedPlace> aligned_places(const FlatSides& sides, double cell_size, const Vec3d& centre);

}  // namespace tetsoup
