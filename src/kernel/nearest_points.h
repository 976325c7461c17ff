// The nearest of many points to all voxels of a box at once.
#pragma once

#include <span>
#include <vector>

#include "tetsoup/types.h"

namespace tetsoup::kernel {

/// Points in columns, for vectors of them.
struct PointColumns {
  std::vector<float> x, y, z;
  std::size_t size() const { return x.size(); }
  void resize(std::size_t n) {
    x.resize(n);
    y.resize(n);
    z.resize(n);
  }
  bool operator==(const PointColumns&) const = default;
};

/// The points of a box: centre + (-half to half) along each axis.
struct CentredBox {
  Vec3 centre, half;
};

/// Points that may be the nearest of all to some point of the box: all that are, and few others. Such a list serves
/// every box within this one. Ties and near ties are kept, so no bit of a distance is lost.
/// @param out  Its memory is used again; not `points`.
void keep_candidates(const PointColumns& points, const CentredBox& box, PointColumns& out);

inline constexpr int kBrick = 8;  ///< Voxels along each edge of a brick.
using BrickSquares = std::span<float, kBrick * kBrick * kBrick>;

/// squares[(z 8 + y) 8 + x] = squared distance from (x0 + x, y0 + y, z0 + z) to the nearest of the points; infinite
/// without points.
void nearest_squares(const PointColumns& points, int x0, int y0, int z0, BrickSquares squares);

}  // namespace tetsoup::kernel
