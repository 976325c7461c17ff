// Pictures of frames, all from one point of view.
#pragma once

#include <optional>
#include <vector>

#include "io/animation/cast.h"
#include "io/animation/ground.h"
#include "io/preview_view.h"
#include "io/raster.h"

namespace tetsoup::animation {

/// What pictures show unless the caller says: the first frame, the way down from there to the ground, and obstacles.
Box3 default_view(const Cast& cast, FrameView& first, UpAxis up);

class Painter {
 public:
  Painter(const Cast& cast, const Box3& box, const AnimationOptions& options);

  Image draw(FrameView& view) const;

 private:
  struct Layers {
    TriangleTarget seen;
    std::vector<TriangleTarget> shadows;  // Of every ground.
  };
  void add_smooth(Layers& layers, std::span<const Vec3> points, const std::vector<Triangle>& triangles,
                  const Rgb& colour) const;
  void add_tets(Layers& layers, std::span<const Vec3> points, const std::vector<Triangle>& triangles,
                const Rgb& colour) const;
  void add_shadows(Layers& layers, std::span<const Vec3> points, const std::vector<Triangle>& triangles) const;
  std::vector<ScreenPoint> projected(std::span<const Vec3> points) const;
  Rgb shaded(const Rgb& colour, const Vec3& normal) const;

  PreviewView view_;
  Vec3d vertical_, light_;
  std::vector<Ground> grounds_;
  Image backdrop_;                // Sky and grounds.
  std::optional<Layers> static_;  // Obstacles.
};

}  // namespace tetsoup::animation
