// Whether a scene is one.
#pragma once

#include <string>

#include "tetsoup/scene.h"

namespace tetsoup::scene {

/// @throws Problem  for the first thing that is wrong.
void check(const Scene& scene);

/// Instances of a body.
std::size_t instance_count(const SceneBody& body);

}  // namespace tetsoup::scene
