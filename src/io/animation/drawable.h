// A surface made ready for the rasteriser: what its corners look like on the screen and where their shadows fall.
#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "io/animation/corner_normals.h"
#include "io/animation/ground.h"
#include "io/pictures/preview_view.h"
#include "io/pictures/raster.h"

namespace tetsoup::animation {

enum class Look {
  Smooth,   ///< Light is blended over a triangle.
  Faceted,  ///< Triangles are told apart, with lines between them where they are large enough.
};

/// Where the light and the eye are.
struct Light {
  Vec3d vertical, towards_light, towards_eye;
  Rgb on(const Rgb& colour, const Vec3& normal) const;
};

class Drawable {
 public:
  /// What is given must outlive it.
  Drawable(std::span<const Vec3> points, const std::vector<Triangle>& triangles, const Rgb& colour, Look look,
           const Light& light, const PreviewView& view, const std::vector<Ground>& grounds);

  void draw(TriangleTarget& target, const Rows& rows) const;
  /// On the ground of that number.
  void draw_shadow(std::size_t ground, TriangleTarget& target, const Rows& rows) const;

 private:
  void draw_smooth(TriangleTarget& target, const Rows& rows) const;
  void draw_faceted(TriangleTarget& target, const Rows& rows) const;
  double typical_edge() const;

  const std::vector<Triangle>& triangles_;
  Rgb colour_;
  Look look_;
  const Light& light_;
  SurfaceNormals normals_;
  std::vector<ScreenPoint> seen_;
  std::vector<Rgb> lit_;                           // At every point, by its normal.
  std::vector<std::vector<ScreenPoint>> shadows_;  // Of the points, on every ground.
};

}  // namespace tetsoup::animation
