// Finds the tets that hold a point.
#pragma once

#include <array>
#include <vector>

#include "base/groups.h"
#include "base/tet_geometry.h"
#include "tetsoup/types.h"

namespace tetsoup {

class TetLocator {
 public:
  /// Edges of the largest tet: single-precision vertices put a point on a face up to this far outside.
  static constexpr double kOnFace = 1e-5;

  /// Indices are valid and vertices finite; tets that are flat or inverted hold nothing. O(tets), of
  /// any shape.
  explicit TetLocator(const TetMesh& mesh, double on_face = kOnFace);

  /// visit(tet) for every tet that holds the point or has it on its faces, in ascending order.
  template <class Visit>
  void visit_holders(const Vec3d& point, const Visit& visit) const {
    const auto bucket = bucket_of(point);
    for (std::size_t i = 0; i < 3; ++i)
      if (bucket[i] < 0 || bucket[i] >= count_[i]) return;
    for (const std::uint32_t t : tets_[number_of(bucket)])
      if (holds(t, point)) visit(t);
  }
  /// Of tets in buckets: what the memory is for.
  std::size_t entry_count() const { return tets_.items().size(); }
  bool holds(std::uint32_t tet, const Vec3d& point) const {
    for (const Plane& plane : planes_[tet])
      if (dot(plane.normal, point) + plane.offset < 0) return false;
    return true;
  }

 private:
  /// Where dot(normal, p) + offset >= 0.
  struct Plane {
    Vec3d normal;
    double offset = 0;
  };
  std::array<int, 3> bucket_of(const Vec3d& point) const;
  std::size_t number_of(const std::array<int, 3>& bucket) const {
    return static_cast<std::size_t>(bucket[0]) +
           static_cast<std::size_t>(count_[0]) *
               (static_cast<std::size_t>(bucket[1]) +
                static_cast<std::size_t>(count_[1]) * static_cast<std::size_t>(bucket[2]));
  }

  Vec3d origin_;
  double edge_ = 1;
  std::array<int, 3> count_{};
  std::vector<std::array<Plane, 4>> planes_;
  Groups<std::uint32_t> tets_;  ///< That reach into each bucket.
};

}  // namespace tetsoup
