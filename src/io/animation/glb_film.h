// Everything as one glTF animation: each body a node that moves and turns, bent by morph targets of its make.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "io/animation/cast.h"
#include "io/animation/file_log.h"
#include "io/animation/glb_builder.h"
#include "io/animation/make_motion.h"

namespace tetsoup::animation {

class GlbFilm {
 public:
  GlbFilm(const Cast& cast, UpAxis up);

  void add(FrameView& view);
  /// Can be called once.
  void write(const std::filesystem::path& path, FileLog& log);

 private:
  struct SharedMesh {
    nlohmann::json primitive;  // But for its material.
    std::size_t targets = 0;
  };
  SharedMesh add_mesh(GlbBuilder& glb, std::size_t make, const ReducedMotion& motion) const;
  std::size_t add_body(GlbBuilder& glb, std::size_t body, const SharedMesh& mesh, const BodyTrack& track,
                       std::size_t times, nlohmann::json& animation);
  void add_still(GlbBuilder& glb, nlohmann::json& children);
  std::size_t mesh_in_tone(GlbBuilder& glb, std::size_t body, const SharedMesh& mesh);

  const Cast& cast_;
  UpAxis up_;
  std::vector<MakeMotion> motions_;         // Of every make.
  std::vector<std::size_t> place_in_make_;  // Of every body.
  std::vector<float> times_;
  std::optional<Box3> box_;                                           // Of all frames.
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> toned_;  // Meshes by make and tone.
};

}  // namespace tetsoup::animation
