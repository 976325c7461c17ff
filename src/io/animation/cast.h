// Who is in an animation: bodies, the makes that they share, and what of them is seen in a frame.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tetsoup/animation.h"

namespace tetsoup::animation {

/// What bodies of one make share.
struct Make {
  const TetMesh* mesh = nullptr;
  const RenderMesh* surface = nullptr;  ///< Null where the mesh's boundary is seen.
  const Embedding* embedding = nullptr;
  std::vector<Triangle> triangles;   ///< Of what is seen, over its points.
  std::size_t point_count = 0;       ///< Vertices of the surface, or else
  std::vector<std::uint32_t> shown;  ///< these of the mesh: those on its boundary.

  /// The points seen where the mesh's vertices are at `positions`.
  std::vector<Vec3> points(std::span<const Vec3> positions) const;
};

struct Cast {
  AnimationScene scene;
  std::vector<Make> makes;
  std::vector<std::size_t> make_of;     ///< Of every body.
  std::vector<TriangleSoup> obstacles;  ///< Their drawable triangles.
};

/// @throws InvalidInput  if a body has no mesh, or surface and embedding do not fit to each other or to the mesh.
Cast make_cast(AnimationScene scene);

/// A frame, and the surfaces in it as soon as somebody asks for them.
class FrameView {
 public:
  /// @throws InvalidInput  if the frame does not fit to the scene.
  FrameView(const Cast& cast, const AnimationFrame& frame);

  const AnimationFrame& frame() const { return frame_; }
  std::size_t body_count() const { return cast_.make_of.size(); }
  const Make& make(std::size_t body) const { return cast_.makes[cast_.make_of[body]]; }
  /// Seen of a body.
  std::span<const Vec3> points(std::size_t body);

 private:
  const Cast& cast_;
  const AnimationFrame& frame_;
  std::vector<std::vector<Vec3>> surfaces_;
};

/// A plane by unit vectors: its normal, and two in it.
struct PlaneAxes {
  Vec3d normal, u, v;
  double offset = 0;  ///< Of the plane from the origin.
};
PlaneAxes axes_of(const AnimationPlane& plane);

/// Around all points of all bodies.
Box3 box_of(FrameView& view);
void extend(Box3& box, const Vec3d& point);

}  // namespace tetsoup::animation
