// Points that must stay on their side of the boundary while its vertices move.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "base/groups.h"
#include "smooth/connectivity.h"
#include "tetsoup/types.h"

namespace tetsoup {

/// The points, but those that lie in no tet and on a face within rounding are put a little deeper into its tet: else a
/// point that enclosing took for held would count as outside, and might be left there.
std::vector<Vec3> pulled_inside(std::span<const Vec3> points, const TetMesh& mesh);

/// The points in buckets. Where a vertex of the boundary moves, only points between its triangles' old and new places
/// can leave the mesh or come into it.
class SidedPoints {
 public:
  SidedPoints(std::span<const Vec3> points, const TetMesh& mesh, const Connectivity& links);

  /// Whether the points in the tets around the vertex are those that were in them while it was at `before`.
  bool are_kept(std::uint32_t vertex, const Vec3& before, const TetMesh& mesh) const;
  bool empty() const { return points_.items().empty(); }

 private:
  std::array<int, 3> bucket_of(const Vec3d& p) const;
  std::size_t index_of(const std::array<int, 3>& bucket) const;

  const Connectivity* links_;
  Vec3d lo_;
  double size_ = 1;
  std::array<int, 3> count_{1, 1, 1};
  Groups<Vec3> points_;
};

}  // namespace tetsoup
