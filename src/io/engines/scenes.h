// Small scenes that an engine runs as they stand: the body dropped on a plane.
#pragma once

#include <string>

#include "tetsoup/engines.h"
#include "tetsoup/tet_model.h"

namespace tetsoup {

struct SceneInput {
  const TetModel& model;     ///< In metres, as the mesh file has it.
  std::string mesh_file;     ///< Name of the mesh file, which stands beside the scene.
  bool material_is_default;  ///< The scene may be softer than the model says, to suit the engine's own time step.
};

/// The scene's file for an engine with a `scene_extension`.
std::string scene_text(const Engine& engine, const SceneInput& input);

}  // namespace tetsoup
