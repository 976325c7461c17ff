// The motion of all bodies of one make, as few numbers: where each is and how it is turned, and so much of each of a
// few shapes that all of them share.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "tetsoup/types.h"

namespace tetsoup::animation {

/// A body in a frame: scale, then turn, then shift, after its shape has been bent by `weights` of the shared shapes.
struct MotionKey {
  Vec3d translation;
  std::array<double, 4> rotation{0, 0, 0, 1};  ///< Unit quaternion x, y, z, w; near that of the frame before.
  std::vector<float> weights;
  double left_out = 0;  ///< Squared length of what no shape has, in the mesh's unit.
};

struct BodyTrack {
  double scale = 1;
  std::vector<MotionKey> keys;
};

/// What is told in full: p = translation + scale rotation (rest + sum of weight x shape).
struct ReducedMotion {
  std::vector<std::vector<Vec3>> shapes;  ///< Displacements of the mesh's vertices; weights lie in [-1, 1].
  std::vector<BodyTrack> tracks;
  double error = 0;  ///< Largest root mean square of a body in a frame, m.
};

/// Takes frames as they come and keeps only the shapes and their weights. A frame that the shapes do not tell within
/// tolerance adds one, up to a limit; in the end principal components take their place, as few as tolerance allows.
class MakeMotion {
 public:
  MakeMotion(const TetMesh& mesh, std::size_t body_count);

  /// The body's next frame.
  void add(std::size_t body, std::span<const Vec3> positions);
  /// Can be called once.
  ReducedMotion reduce(std::size_t max_shapes);

 private:
  std::vector<double> local_displacements(std::size_t body, std::span<const Vec3> positions, MotionKey& key);
  double tolerance_squared() const;

  std::size_t vertex_count_;
  std::vector<std::uint32_t> used_;  // Vertices that tets have; others stay where they are, whatever the body does.
  Vec3d centre_;
  std::vector<Vec3d> rest_;                // From the centre.
  double rest_size_ = 0;                   // Root of the sum of squares of those.
  double tolerance_ = 0;                   // Root mean square, in the mesh's unit.
  std::vector<std::vector<float>> basis_;  // Unit vectors.
  std::vector<BodyTrack> tracks_;
};

}  // namespace tetsoup::animation
