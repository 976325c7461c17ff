// Where the camera of a preview stands: one view for all panels.
#pragma once

#include <array>
#include <vector>

#include "io/pictures/raster.h"
#include "tetsoup/types.h"

namespace tetsoup {

bool is_drawable(const Vec3& v);
bool is_drawable(const TriangleSoup& soup, const Triangle& triangle);
bool is_drawable(const TetMesh& mesh, const Tet& tet);

/// Three-quarter view from the front and above; the object fills the panel.
class PreviewView {
 public:
  /// @param points   All that must fit; not empty.
  /// @param up_axis  0, 1 or 2.
  PreviewView(const std::vector<Vec3d>& points, int up_axis, int width, int height);

  ScreenPoint project(const Vec3d& p) const;
  const Vec3d& centre() const { return centre_; }
  const Vec3d& towards_eye() const { return towards_eye_; }
  const Vec3d& right() const { return right_; }
  const Vec3d& up() const { return up_; }
  Vec3d eye() const;
  Vec3d ray(double x, double y) const;   ///< From the eye through a place on the screen, in samples as project() gives.
  Vec3d on_floor(const Vec3d& p) const;  ///< Straight below p, at the height of the lowest point.
  /// Level axes of the object that look to the viewer's right and to the viewer.
  const std::array<Vec3d, 2>& level_axes() const { return level_; }

 private:
  ScreenPoint project_unscaled(const Vec3d& p) const;

  Vec3d centre_, vertical_;
  double size_ = 1;
  std::array<Vec3d, 2> level_;
  Vec3d right_, up_, towards_eye_;
  double floor_ = 0;
  double scale_ = 1, shift_x_ = 0, shift_y_ = 0;
};

/// 2 if the soup clearly stands on its z side rather than on its y side, else 1, as most models are drawn: what stands
/// is unlike itself upside down and has a broad footing.
int guess_up_axis(const TriangleSoup& soup);

}  // namespace tetsoup
