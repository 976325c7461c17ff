// docs/SCENES.md and the table of keys say the same.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "scene/fields.h"
#include "tetsoup/scene.h"

namespace tetsoup {
namespace {

/// The keys of one struct, in order.
struct KeyList {
  template <class Member, class Rule>
  void operator()(std::string_view key, const Member&, const Rule&) {
    keys.emplace_back(key);
  }
  void angle(std::string_view key, double, const scene::Range&) { keys.emplace_back(key); }
  void angles(std::string_view key, const Vec3d&, const scene::Range&) { keys.emplace_back(key); }
  void instances(std::string_view key, const SceneBody&) { keys.emplace_back(key); }
  void surface(std::string_view key, const SceneBody&) { keys.emplace_back(key); }
  std::vector<std::string> keys;
};

template <class Struct>
std::vector<std::string> keys_of() {
  KeyList list;
  Struct value;
  scene::visit_fields(list, value);
  std::sort(list.keys.begin(), list.keys.end());
  return list.keys;
}

/// First columns of the table below a heading.
std::vector<std::string> documented_keys(const std::string& page, const std::string& heading) {
  std::istringstream lines(page.substr(page.find("\n## " + heading + "\n") + 1));
  std::vector<std::string> keys;
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line) && !line.starts_with("## "))
    if (line.starts_with("| `")) keys.push_back(line.substr(3, line.find('`', 3) - 3));
  std::sort(keys.begin(), keys.end());
  return keys;
}

std::string the_page() {
  std::ifstream file(TETSOUP_DOCS_DIR "/SCENES.md");
  std::ostringstream page;
  page << file.rdbuf();
  return page.str();
}

TEST(ScenePage, the_page_lists_every_key_and_no_other) {
  const std::string text = the_page();
  ASSERT_GT(text.size(), 1000U);
  EXPECT_EQ(documented_keys(text, "The scene"), keys_of<Scene>());
  EXPECT_EQ(documented_keys(text, "Bodies"), keys_of<SceneBody>());
  EXPECT_EQ(documented_keys(text, "mesh"), keys_of<MeshOptions>());
  EXPECT_EQ(documented_keys(text, "material"), keys_of<SimMaterial>());
  EXPECT_EQ(documented_keys(text, "place"), keys_of<ScenePlace>());
  EXPECT_EQ(documented_keys(text, "instances"), keys_of<SceneGrid>());
  EXPECT_EQ(documented_keys(text, "pins"), keys_of<ScenePin>());
  EXPECT_EQ(documented_keys(text, "springs"), keys_of<SceneSpring>());
  EXPECT_EQ(documented_keys(text, "Obstacles"), keys_of<SceneObstacle>());
  EXPECT_EQ(documented_keys(text, "plane"), keys_of<ScenePlane>());
  EXPECT_EQ(documented_keys(text, "potentials"), keys_of<PotentialOptions>());
}

TEST(ScenePage, the_example_of_the_page_is_a_scene) {
  const std::string text = the_page();
  const std::size_t begin = text.find("```json\n") + 8;
  const Scene scene = parse_scene(text.substr(begin, text.find("```", begin) - begin), {});
  EXPECT_EQ(scene.bodies.at(0).instances.size(), 2U);
}

}  // namespace
}  // namespace tetsoup
