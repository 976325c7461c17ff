// Whatever a scene may be by its keys, nothing in it becomes other than a number; whatever a file may be, it is read or
// refused in words.
#include <gtest/gtest.h>

#include <cmath>

#include "random_scenes.h"
#include "tetsoup/error.h"
#include "tetsoup/progress.h"

namespace tetsoup::test {
namespace {

bool all_finite(std::span<const Vec3> points) {
  for (const Vec3& p : points)
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) return false;
  return true;
}

bool all_finite(const LoadedScene& loaded) {
  for (std::size_t body = 0; body < loaded.bodies.size(); ++body)
    if (!all_finite(loaded.simulation.positions(body)) || !all_finite(loaded.simulation.velocities(body)) ||
        !all_finite(loaded.surfaces[body]))
      return false;
  return true;
}

TEST(SceneRandom, no_scene_that_may_be_played_leaves_the_numbers) {
  constexpr std::uint64_t kScenes = 400;
  std::size_t played = 0;
  for (std::uint64_t seed = 1; seed <= kScenes; ++seed) {
    const Scene scene = random_scene(seed);
    try {
      LoadedScene loaded = load_scene(scene);
      ASSERT_TRUE(all_finite(loaded)) << seed << "\n" << scene_text(scene);
      for (int frame = 0; frame < 4; ++frame) {
        advance_frame(loaded);
        deform_surfaces(loaded);
        ASSERT_TRUE(all_finite(loaded)) << seed << " frame " << frame << "\n" << scene_text(scene);
      }
      ++played;
    } catch (const InvalidInput&) {
      // What only the meshes tell: a vertex too far out, or too fast.
    }
  }
  EXPECT_GT(played, kScenes / 3);
}

TEST(SceneRandom, a_scene_is_read_back_from_its_text) {
  std::size_t sound = 0;
  for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
    const Scene scene = random_scene(seed);
    try {
      check_scene(scene);
    } catch (const InvalidInput&) {
      continue;
    }
    ++sound;
    const std::string text = scene_text(scene);
    ASSERT_EQ(scene_text(parse_scene(text, {})), text) << seed;
  }
  EXPECT_GT(sound, 1000U);
}

/// A byte or a run of bytes is dropped, doubled, exchanged for others of the text or of what JSON is made of.
std::string mutated(std::string text, std::mt19937_64& random) {
  static constexpr std::array<std::string_view, 20> kPieces{"{",    "}",     "[",  "]",     ",",    ":",   "\"",
                                                            "-",    "1e999", "0",  "null",  "true", "NaN", "\\u0000",
                                                            "\xff", "1e5",   "-1", "\"x\"", "[[[[", "0.5"};
  const auto below = [&](std::size_t count) { return static_cast<std::size_t>(random() % count); };
  for (std::size_t changes = 1 + below(3); changes > 0 && !text.empty(); --changes) {
    const std::size_t at = below(text.size()), size = 1 + below(std::min<std::size_t>(8, text.size() - at));
    switch (below(4)) {
      case 0:
        text.erase(at, size);
        break;
      case 1:
        text.insert(at, text.substr(at, size));
        break;
      case 2:
        text.replace(at, size, kPieces[below(kPieces.size())]);
        break;
      default:
        text.replace(at, size, text.substr(below(text.size()), size));
        break;
    }
  }
  return text;
}

TEST(SceneRandom, a_damaged_text_is_read_or_refused_in_words) {
  std::mt19937_64 random(7);
  std::size_t refused = 0, read = 0;
  for (const std::string& name : scene_names()) {
    const std::string text = scene_text(make_scene(name));
    for (int i = 0; i < 3000; ++i) {
      const std::string damaged = mutated(text, random);
      try {
        check_scene(parse_scene(damaged, {}, "x.json"));
        ++read;
      } catch (const IoError& error) {
        ++refused;
        const std::string what = error.what();
        ASSERT_TRUE(what.starts_with("x.json: ")) << what;
        ASSERT_GT(what.size(), 15U) << what;
        ASSERT_LT(what.size(), 600U) << what;
      }
    }
  }
  EXPECT_GT(refused, 9000U);
  EXPECT_GT(read, 300U);
}

}  // namespace
}  // namespace tetsoup::test
