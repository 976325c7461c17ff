// Which label a place in space has: that of the closed part around it, or of the nearest triangle.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/box_hierarchy.h"
#include "base/triangle_boxes.h"
#include "tetsoup/regions.h"
#include "tetsoup/types.h"

namespace tetsoup {

/// Places are counted from the soup's origin.
class LabelPlaces {
 public:
  LabelPlaces(const TriangleSoup& soup, std::span<const std::uint32_t> labels, StageWatch& watch);

  /// No triangle is usable: every label is 0.
  bool empty() const { return !boxes_ || boxes_->empty(); }
  bool has_closed() const { return has_closed_; }

  std::uint32_t at(const Vec3d& place) const;

  /// Whether labels cannot change within the radius: parts are closed, and no triangle lies there.
  bool is_clear(const Vec3d& place, double radius) const;

  /// Unit normal of the triangle nearest to a place, whatever its winding; none where that has no area.
  std::optional<Vec3d> normal_near(const Vec3d& place) const;

 private:
  /// Triangles of one label that hang together through edges.
  struct Part {
    std::uint32_t label = 0;
    bool sound = false, oriented = false;
    double volume = 0;  ///< What lies in fewer cubic units lies deeper.
  };
  struct Hit {
    std::uint32_t part;
    int sign;
  };
  struct Nearest {
    std::uint32_t triangle = 0;
    double square = 0;  ///< Of the way there, in the units of the boxes.
  };

  void add(const TriangleSoup& soup, std::span<const std::uint32_t> triangles, std::uint32_t label, StageWatch& watch);
  std::optional<std::uint32_t> innermost(const Vec3& place) const;
  std::optional<std::uint32_t> innermost_of(std::span<const Hit> hits) const;
  Nearest nearest(const Vec3d& place) const;
  std::uint32_t label_of(std::uint32_t triangle) const { return parts_[of_triangle_[triangle]].label; }

  TriangleSoup soup_;                       ///< Of the parts, one after the other, those of a label together.
  std::vector<std::uint32_t> of_triangle_;  ///< Part of every triangle.
  std::vector<std::int8_t> turns_;          ///< 1, or -1 for a triangle that runs against its corners' order.
  std::vector<Part> parts_;
  bool has_closed_ = false, has_open_ = false;
  BoxHierarchy hierarchy_;              ///< For rays,
  std::optional<TriangleBoxes> boxes_;  ///< and for distances.
};

/// The labels of one tet. @param shift  From its origin to that of the places.
std::vector<LabelShare> share_tet(const std::array<Vec3d, 4>& corners, const LabelPlaces& places, const Vec3d& shift);

/// Of all. @param shift  From the mesh's origin to that of the places.
TetLabels share_tets(const TetMesh& mesh, const LabelPlaces& places, const Vec3d& shift, StageWatch& watch);

}  // namespace tetsoup
