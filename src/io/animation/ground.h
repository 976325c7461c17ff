// A plane in a picture: a grid that fades with distance, and the shadows on it.
#pragma once

#include <vector>

#include "io/animation/cast.h"
#include "io/pictures/preview_view.h"
#include "io/pictures/raster.h"

namespace tetsoup::animation {

class Ground {
 public:
  /// @param box    What the picture shows.
  /// @param light  Unit vector towards it.
  Ground(const AnimationPlane& plane, const Box3& box, const Vec3d& light);

  /// Draws the plane where it is nearer than `depths`, along the rays of the view, and remembers where that is.
  void draw(Image& image, const PreviewView& view, std::vector<double>& depths);

  /// A new one for the shadows of a frame.
  TriangleTarget shadow_target() const { return {kShadowSize, kShadowSize}; }
  /// Where the shadow of a point falls in it.
  ScreenPoint shadow_of(const Vec3d& p) const;
  void draw_shadows(Image& image, const TriangleTarget& shadows) const;

 private:
  static constexpr int kShadowSize = 384;  // Pixels along a side; shadows are soft anyway.

  struct Pixel {
    int x, y;
    float u, v;      // In the target of shadows.
    float strength;  // Less in the distance.
  };
  std::array<double, 2> on_plane(const Vec3d& p) const {
    return {dot(p - origin_, axes_.u), dot(p - origin_, axes_.v)};
  }

  PlaneAxes axes_;
  Vec3d origin_, light_;
  double radius_, cell_;
  std::vector<Pixel> pixels_;
};

}  // namespace tetsoup::animation
