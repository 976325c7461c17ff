#include "simulate_files.h"

#include <system_error>
#include <utility>

namespace tetsoup::cli {

namespace {

AnimationScene animation_scene(const LoadedScene& loaded) {
  AnimationScene scene;
  for (const LoadedBody& body : loaded.bodies) {
    const SceneAsset& asset = loaded.assets[body.asset];
    const bool has_surface = asset.has_surface();
    scene.bodies.push_back(
        {body.name, &asset.mesh, has_surface ? &asset.surface : nullptr, has_surface ? &asset.embedding : nullptr});
  }
  for (const LoadedObstacle& obstacle : loaded.obstacles) scene.obstacles.push_back({obstacle.name, &obstacle.soup});
  for (const SceneObstacle& obstacle : loaded.scene.obstacles)
    if (obstacle.plane) scene.planes.push_back({obstacle.plane->normal, obstacle.plane->offset});
  return scene;
}

}  // namespace

FrameFiles::FrameFiles(std::vector<std::filesystem::path> paths, const LoadedScene& loaded,
                       const std::optional<Box3>& view)
    : loaded_(loaded) {
  if (paths.empty()) return;
  AnimationOptions options;
  options.fps = loaded.scene.fps;
  options.view = view;
  options.first_frame = loaded.frame > 0 ? loaded.frame + 1 : 0;  // the last one is there already
  writer_.emplace(std::move(paths), animation_scene(loaded), options);
}

void FrameFiles::add_frame(std::uint64_t state_hash) {
  if (!writer_) return;
  AnimationFrame frame;
  frame.time = static_cast<double>(loaded_.frame) / loaded_.scene.fps;
  frame.state_hash = state_hash;
  for (std::size_t body = 0; body < loaded_.bodies.size(); ++body) {
    frame.positions.push_back(loaded_.simulation.positions(body));
    frame.velocities.push_back(loaded_.simulation.velocities(body));
    frame.surfaces.push_back(loaded_.surfaces[body]);
  }
  writer_->add_frame(frame);
}

void FrameFiles::finish() {
  if (writer_) writer_->finish();
}

void FrameFiles::remove_all() const {
  if (!writer_) return;
  std::error_code ignored;
  for (const std::filesystem::path& path : writer_->report().files) std::filesystem::remove(path, ignored);
}

std::optional<Box3> FrameFiles::view() const {
  if (!writer_) return {};
  const Box3 box = writer_->view();
  return box == Box3{} ? std::nullopt : std::optional(box);
}

}  // namespace tetsoup::cli
