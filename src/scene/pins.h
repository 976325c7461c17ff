// What pins of scenes and pins that are loaded have in common.
#pragma once

#include "base/vec.h"

namespace tetsoup::scene {

/// Whether a pin moves what it holds; of a ScenePin and of the MovedPin that is made of it.
template <class Pin>
bool is_driven(const Pin& pin) {
  return pin.velocity != Vec3d{} || pin.spin != Vec3d{};
}

}  // namespace tetsoup::scene
