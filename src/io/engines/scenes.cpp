// Which function writes which engine's scene: one file scene_<engine>.cpp each.
#include "io/engines/scenes.h"

#include <map>
#include <string>
#include <string_view>

#include "base/require.h"
#include "io/engines/scene_parts.h"

namespace tetsoup {

namespace {

using SceneWriter = std::string (*)(const SceneInput&);

const std::map<std::string_view, SceneWriter>& scene_writers() {
  static const std::map<std::string_view, SceneWriter> writers{
      {"bullet", pybullet_scene}, {"calculix", calculix_scene}, {"drake", drake_scene},
      {"mujoco", mujoco_scene},   {"newton", newton_scene},     {"sofa", sofa_scene},
  };
  return writers;
}

}  // namespace

std::string scene_text(const Engine& engine, const SceneInput& input) {
  const auto writer = scene_writers().find(engine.name);
  require(writer != scene_writers().end(), "engine", engine.name, "one that has a scene");
  return writer->second(input);
}

}  // namespace tetsoup
