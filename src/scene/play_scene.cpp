// A scene in time: pins that move by hand, steps, surfaces, and what is kept between two runs.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/elementary.h"
#include "base/vec.h"
#include "scene/pins.h"
#include "tetsoup/error.h"
#include "tetsoup/scene.h"

namespace tetsoup {

using scene::is_driven;

namespace {

/// About an axis through the origin, by its length in radians [Rodrigues].
Vec3d rotated(const Vec3d& rotation, const Vec3d& p) {
  const double angle = length(rotation);
  if (!(angle > 0)) return p;
  const Vec3d axis = rotation * (1 / angle);
  return p * elementary::cos(angle) + cross(axis, p) * elementary::sin(angle) +
         axis * (dot(axis, p) * (1 - elementary::cos(angle)));
}

void move_pin(const MovedPin& pin, double time, std::span<Vec3> positions) {
  const double t = std::min(time, pin.until.value_or(time));
  for (std::size_t i = 0; i < pin.vertices.size(); ++i)
    positions[pin.vertices[i]] =
        to_float(pin.centre + pin.velocity * t + rotated(pin.spin * t, to_double(pin.starts[i]) - pin.centre));
}

/// Each body is written once, however many pins it has: they stand body after body.
void move_pins(LoadedScene& loaded, double time) {
  const std::vector<MovedPin>& all = loaded.moved;
  std::vector<Vec3> positions;
  for (std::size_t begin = 0, end = 0; begin < all.size(); begin = end) {
    positions.clear();
    for (; end < all.size() && all[end].body == all[begin].body; ++end) {
      if (!is_driven(all[end]) || all[end].released) continue;
      const std::span<const Vec3> now = loaded.simulation.positions(all[end].body);
      if (positions.empty()) positions.assign(now.begin(), now.end());
      move_pin(all[end], time, positions);
    }
    if (!positions.empty()) loaded.simulation.set_positions(all[begin].body, positions);
  }
}

/// Pins are free, or held, as they are while a frame is simulated; -1: as in the beginning.
void release_pins(LoadedScene& loaded, double frame) {
  for (MovedPin& pin : loaded.moved) {
    const bool free = pin.release && frame >= *pin.release * loaded.scene.fps;
    if (free == pin.released) continue;
    pin.released = free;
    for (const std::uint32_t v : pin.vertices) {
      if (free)
        loaded.simulation.unpin({pin.body, v});
      else
        loaded.simulation.pin({pin.body, v});
    }
  }
}

}  // namespace

/// Vertices that are driven move before every step; a frame is then as many steps as it has searches for contacts.
int steps_of_frame(const LoadedScene& loaded) {
  constexpr double kLongestStep = 1.0 / 60;  // s
  constexpr double kRounding = 1e-9;         // 60 fps make one step
  const int steps = static_cast<int>(std::ceil(1 / (loaded.scene.fps * kLongestStep) - kRounding));
  const SimulationOptions& options = loaded.scene.simulation;
  const bool driven = std::any_of(loaded.moved.begin(), loaded.moved.end(), is_driven<MovedPin>);
  return std::max(1, steps) * (driven ? (options.substeps - 1) / options.contact_interval + 1 : 1);
}

void advance_frame(LoadedScene& loaded) {
  release_pins(loaded, static_cast<double>(loaded.frame));
  const Scene& scene = loaded.scene;
  const int steps = steps_of_frame(loaded);
  for (int i = 0; i < steps; ++i) {
    const double time = (static_cast<double>(loaded.frame) + (i + 1.0) / steps) / scene.fps;
    move_pins(loaded, time);
    loaded.simulation.step(1 / scene.fps / steps);
  }
  ++loaded.frame;
}

void seek_frame(LoadedScene& loaded, std::size_t frame) {
  release_pins(loaded, static_cast<double>(frame) - 1);
  loaded.frame = frame;
}

void deform_surfaces(LoadedScene& loaded) {
  for (std::size_t body = 0; body < loaded.bodies.size(); ++body) {
    const SceneAsset& asset = loaded.assets[loaded.bodies[body].asset];
    if (asset.has_surface())
      loaded.surfaces[body] = deform_points(asset.embedding, asset.mesh.tets, loaded.simulation.positions(body));
  }
}

std::vector<std::byte> save_scene_state(const LoadedScene& loaded) {
  const std::uint64_t frame = loaded.frame;
  std::vector<std::byte> bytes(sizeof(frame));
  std::memcpy(bytes.data(), &frame, sizeof(frame));
  const std::vector<std::byte> state = loaded.simulation.save_state();
  bytes.insert(bytes.end(), state.begin(), state.end());
  return bytes;
}

void restore_scene_state(LoadedScene& loaded, std::span<const std::byte> bytes) {
  std::uint64_t frame = 0;
  if (bytes.size() < sizeof(frame)) throw InvalidInput("the saved state is damaged");
  std::memcpy(&frame, bytes.data(), sizeof(frame));
  const std::vector<std::byte> before = loaded.simulation.save_state();
  // Whether a vertex is held is not part of a state, but must be as it was then.
  release_pins(loaded, static_cast<double>(frame) - 1);
  try {
    loaded.simulation.restore_state(bytes.subspan(sizeof(frame)));
  } catch (const InvalidInput&) {
    release_pins(loaded, static_cast<double>(loaded.frame) - 1);
    loaded.simulation.restore_state(before);
    throw;
  }
  loaded.frame = frame;
  deform_surfaces(loaded);
}

}  // namespace tetsoup
