// Pictures of frames, all from one point of view.
#pragma once

#include <optional>
#include <vector>

#include "io/animation/cast.h"
#include "io/animation/drawable.h"
#include "io/animation/ground.h"
#include "io/pictures/preview_view.h"
#include "io/pictures/raster.h"

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
  std::vector<Drawable> drawables(FrameView& view, std::size_t begin, std::size_t end) const;
  void add(Layers& layers, const std::vector<Drawable>& drawables) const;

  PreviewView view_;
  Light light_;
  std::vector<Ground> grounds_;
  Image backdrop_;                // Sky and grounds.
  std::optional<Layers> static_;  // Obstacles.
};

}  // namespace tetsoup::animation
