// Saved states. A simulation that takes one goes on and saves the same again, one that refuses it (InvalidInput) is as
// it was. The checksum is put right, since no flip would get past it.
#include <vector>

#include "base/hash.h"
#include "fuzz.h"
#include "tetsoup/error.h"
#include "tetsoup/simulate.h"

namespace tetsoup::fuzz {
namespace {

Simulation small_world() {
  TetMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  mesh.tets = {{0, 1, 2, 3}, {1, 2, 3, 4}};
  SimulationOptions options;
  options.substeps = options.max_substeps = 2;
  Simulation world(options);
  world.add_plane({0, 0, 1}, 0);
  world.add_body(mesh, {}, {.translate = {0, 0, 0.01}});
  world.add_body(mesh, {}, {.translate = {0.2, 0.1, 1.2}});
  world.pin({0, 2});
  world.add_spring({1, 4}, {1, 1, 3}, 100);
  return world;
}

/// Where the mutated bytes go: over a true state from a place on, with its checksum, which is the last word.
std::vector<std::byte> mixed_state(const std::vector<std::byte>& state, Choices& choices) {
  std::vector<std::byte> mixed = state;
  const unsigned changes = choices.below(8);
  for (unsigned i = 0; i < changes; ++i) {
    const std::size_t at = choices.take<std::uint16_t>() % mixed.size();
    const std::string_view text = choices.text();
    std::memcpy(mixed.data() + at, text.data(), std::min(text.size(), mixed.size() - at));
  }
  if (choices.below(4) == 0) mixed.resize(choices.take<std::uint16_t>() % (2 * mixed.size()));
  return mixed;
}

void repair(std::vector<std::byte>& state) {
  if (state.size() < 16) return;
  WordHash hash;
  const std::size_t end = state.size() - 8;
  for (std::size_t i = 0; i < end; i += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, state.data() + i, std::min<std::size_t>(8, end - i));
    hash.add(word);
  }
  const std::uint64_t value = hash.value();
  std::memcpy(state.data() + end, &value, 8);
}

}  // namespace

void fuzz_one(Bytes bytes) {
  static Simulation world = small_world();
  static const std::vector<std::byte> start = [] {
    for (int i = 0; i < 20; ++i) world.step(1.0 / 60);
    return world.save_state();
  }();
  Choices choices(bytes);
  std::vector<std::byte> state = mixed_state(start, choices);
  if (choices.below(8) != 0) repair(state);
  world.restore_state(start);
  try {
    world.restore_state(state);
  } catch (const InvalidInput&) {
    expect(world.save_state() == start, "a state that is refused changes nothing");
    return;
  }
  world.step(1.0 / 60);
  world.save_state();
}

}  // namespace tetsoup::fuzz
