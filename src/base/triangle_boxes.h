// Finds the triangles of a soup near a point.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "base/vec.h"
#include "tetsoup/types.h"

namespace tetsoup {

/// Point of the triangle that is nearest to `p` [Ericson05 §5.1.5].
Vec3d closest_on_triangle(const std::array<Vec3d, 3>& triangle, const Vec3d& p);

/// A binary tree of boxes over the triangles along a Morton curve, halved by count: for questions so few that building
/// counts for more than asking. Triangles that are not finite are left out.
///
/// It works in a unit of its own: the longest side of the box around all triangles is 1, its lowest corner 0.
class TriangleBoxes {
 public:
  /// The soup must outlive this. O(triangles log triangles); mostly on all threads.
  TriangleBoxes(const TriangleSoup& soup, StageWatch& watch);

  bool empty() const { return order_.empty(); }
  std::uint32_t any() const { return order_[0]; }

  double scale() const { return scale_; }  ///< Own units a unit of the soup.
  Vec3d to_unit(const Vec3d& p) const { return (p - lo_) * scale_; }
  std::array<Vec3d, 3> corners_in_unit(std::uint32_t triangle) const {
    const auto [a, b, c] = soup_.triangles[triangle];
    return {place(a), place(b), place(c)};
  }

  /// For visit_near(): no box that holds a point within the square root of `square` is left out, though boxes are
  /// rounded.
  static float bound_above(double square) {
    const double distance = std::sqrt(square) * (1 + kRounding) + kRounding;
    return static_cast<float>(distance * distance);
  }

  /// Calls ask(triangle) for the triangles whose boxes lie within the square root of `best` of the point, the nearest
  /// boxes first; `best` may fall meanwhile.
  template <class Ask>
  void visit_near(const Vec3& p, const float& best, const Ask& ask) const {
    if (!empty()) visit(1, p, best, ask);
  }

 private:
  static constexpr double kRounding = 1e-6;  ///< Of coordinates up to 1, with room to spare.
  static constexpr std::size_t kLeaf = 4;    ///< Triangles of a leaf.
  static constexpr float kFar = std::numeric_limits<float>::infinity();
  struct Box {
    Vec3 lo{kFar, kFar, kFar}, hi{-kFar, -kFar, -kFar};
    void add(const Vec3& p) { lo = min(lo, p), hi = max(hi, p); }
    void add(const Box& box) { lo = min(lo, box.lo), hi = max(hi, box.hi); }  // an empty one adds nothing
    float squared_distance(const Vec3& p) const {
      const float dx = std::max({lo.x - p.x, p.x - hi.x, 0.0F}), dy = std::max({lo.y - p.y, p.y - hi.y, 0.0F}),
                  dz = std::max({lo.z - p.z, p.z - hi.z, 0.0F});
      return dx * dx + dy * dy + dz * dz;
    }
  };

  void find_box();
  Vec3d place(std::uint32_t v) const { return to_unit(to_double(soup_.vertices[v])); }

  template <class Ask>
  void visit(std::size_t node, const Vec3& p, const float& best, const Ask& ask) const {
    if (node >= first_leaf_) {
      const std::size_t leaf = node - first_leaf_;
      for (std::size_t i = leaf * kLeaf; i < std::min(order_.size(), (leaf + 1) * kLeaf); ++i) ask(order_[i]);
      return;
    }
    std::size_t first = 2 * node, second = 2 * node + 1;
    float to_first = boxes_[first].squared_distance(p), to_second = boxes_[second].squared_distance(p);
    if (to_second < to_first) std::swap(first, second), std::swap(to_first, to_second);
    if (to_first <= best) visit(first, p, best, ask);
    if (to_second <= best) visit(second, p, best, ask);
  }

  const TriangleSoup& soup_;
  std::vector<std::uint32_t> usable_, order_;
  Vec3d lo_;
  double scale_ = 1;
  std::size_t first_leaf_ = 1;
  std::vector<Box> boxes_;  ///< Node i has the children 2 i and 2 i + 1; node 1 is the root.
};

}  // namespace tetsoup
