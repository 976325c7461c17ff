// tetsoup::io: what moves, as files: series for ParaView and for artists, one glTF animation, pictures, a film.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tetsoup/embed.h"
#include "tetsoup/render_mesh.h"
#include "tetsoup/simulate.h"
#include "tetsoup/tet_model.h"
#include "tetsoup/types.h"

namespace tetsoup {

/// One body of a scene; what it points to must outlive the writer. Bodies of one make point to the same things, and
/// share them in files.
struct AnimationBody {
  std::string name = "body";
  const TetMesh* mesh = nullptr;         ///< Its vertices are those at rest.
  const RenderMesh* surface = nullptr;   ///< What is seen; without it the mesh's boundary is.
  const Embedding* embedding = nullptr;  ///< Where the vertices of `surface` lie in the mesh; goes with it.
};

/// Triangles that do not move.
struct AnimationObstacle {
  std::string name = "obstacle";
  const TriangleSoup* soup = nullptr;
};

/// Where dot(normal, p) = offset; bodies are on the side of larger values.
struct AnimationPlane {
  Vec3d normal{0, 0, 1};
  double offset = 0;
};

struct AnimationScene {
  std::vector<AnimationBody> bodies;
  std::vector<AnimationObstacle> obstacles;
  std::vector<AnimationPlane> planes;
};

/// The scene at one time. What the spans show is not kept.
struct AnimationFrame {
  double time = 0;                                ///< s
  std::uint64_t state_hash = 0;                   ///< Stated in .vtu files.
  std::vector<std::span<const Vec3>> positions;   ///< Of every body's vertices.
  std::vector<std::span<const Vec3>> velocities;  ///< Likewise, m/s; may be empty.
  std::vector<std::span<const Vec3>> surfaces;  ///< deform_points() of every body with a surface, where the caller has
                                                ///< it already; may be empty, as may each of them.
};

/// The simulation as it is now.
AnimationFrame animation_frame(const Simulation& simulation);

struct AnimationOptions {
  double fps = 60;                ///< Frames of a second of the film, (0, 1000]; .glb goes by the frames' own times.
  int width = 960, height = 540;  ///< Of pictures, 64..4096.
  UpAxis up = UpAxis::Z;          ///< Of the scene.
  /// What pictures show; without it the first frame, the way down from there to the ground, and obstacles. One that is
  /// continued should be given the view() of its first part.
  std::optional<Box3> view{};
  std::size_t first_frame = 0;  ///< Number of the first frame; above 0 a series is continued.
};

struct AnimationReport {
  std::size_t frame_count = 0;               ///< Added to this writer.
  std::vector<std::filesystem::path> files;  ///< Written so far, in that order, each once.
  std::uint64_t bytes = 0;                   ///< Of them.
  std::size_t glb_targets = 0;               ///< Morph targets of .glb, of all makes of bodies together.
  double glb_error = 0;                      ///< Largest root mean square error of a body in a frame of .glb, m.
};

/// Writes frames as they come, into as many files and series as wanted; what several of them need is computed once.
///
///   DIR      DIR/frames.pvd, DIR/frame_0000.vtu, ...: all bodies' tets, velocities, body and tet ids
///   x.pvd    the same as x.pvd, x_0000.vtu, ...
///   x.obj    x_0000.obj, ...: the surfaces with polygons, texture coordinates and names; likewise x.ply, as triangles
///   x.png    x_0000.png, ...: pictures by a software rasteriser, from a fixed point of view
///   x.webp   the same pictures as one film
///   x.glb    one glTF animation: rigid motion of each body and morph targets shared by all of its make
///
/// Obstacles lie once beside .pvd, .obj and .ply series, as DIR/obstacles.obj or x_obstacles.obj. A folder that is not
/// there is made. Every file is written whole or not at all; series are complete after every frame.
class AnimationWriter {
 public:
  /// @throws InvalidInput  if an option is out of range, a body has no mesh, or embedding and surface do not fit;
  ///         IoError       if an extension is none of these, a film is to be continued, or a .pvd to be continued
  ///                       cannot be read.
  AnimationWriter(std::vector<std::filesystem::path> paths, AnimationScene scene, const AnimationOptions& options = {});
  ~AnimationWriter();
  AnimationWriter(AnimationWriter&&) noexcept;
  AnimationWriter& operator=(AnimationWriter&&) noexcept;

  /// @throws InvalidInput  if there are not as many spans as bodies, or points as vertices, or time does not grow;
  ///         IoError.
  void add_frame(const AnimationFrame& frame);
  /// Writes .glb and .webp, of the frames so far; without it they are not written. Nothing can be added then.
  void finish();

  const AnimationReport& report() const;
  /// What pictures show; of no extent before the first frame, unless given.
  Box3 view() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace tetsoup
