// The scenes that come with the tool: samples, boxes, and materials between jelly and rubber.
#include <algorithm>

#include "base/listing.h"
#include "tetsoup/error.h"
#include "tetsoup/scene.h"

namespace tetsoup {

namespace {

SceneObstacle ground() {
  SceneObstacle obstacle;
  obstacle.name = "ground";
  obstacle.plane = ScenePlane{};
  return obstacle;
}

SceneObstacle tree(double size) {
  SceneObstacle obstacle;
  obstacle.source.sample = "tree";
  obstacle.source.size = size;
  obstacle.source.origin = SceneOrigin::Bottom;
  obstacle.voxels = 96;
  obstacle.friction = 0.9;
  return obstacle;
}

SceneBody robot(std::size_t tets, double young) {
  SceneBody body;
  body.source.sample = "robot";
  body.source.size = 1;
  body.source.origin = SceneOrigin::Centre;
  body.mesh.lattice.tets = tets;
  body.material.elastic.young = young;
  body.material.damping_time = 0.004;
  return body;
}

/// Along x, its middle at the origin.
SceneBody beam(double young) {
  SceneBody body;
  body.source.box = Vec3d{1, 0.2, 0.2};
  body.mesh.lattice.cell_size = 0.05;
  body.material.elastic.young = young;
  return body;
}

ScenePin end_of_beam(double side) {
  constexpr double kEnd = 0.49;  // m; the last layer of vertices alone is beyond
  ScenePin pin;
  pin.axis = 0;
  if (side < 0)
    pin.below = -kEnd;
  else
    pin.above = kEnd;
  return pin;
}

Scene make_drop() {
  Scene scene;
  scene.title = "A soft robot falls on the ground";
  SceneBody body = robot(2000, 5e4);
  body.place = {.translate = {0, 0, 1.4}, .rotate = {15, 25, 0}, .spin = {60, 0, 0}};
  scene.bodies.push_back(body);
  scene.obstacles.push_back(ground());
  return scene;
}

Scene make_robots_on_tree() {
  Scene scene;
  scene.title = "Four robots fall on a tree (Spillmann, Wagner, Teschner 2006, Fig. 12)";
  scene.seconds = 5;
  SceneBody body = robot(750, 6e4);
  body.material.friction = 0.9;
  body.instances = {{.translate = {0.1, 0.1, 3.0}, .rotate = {0, 10, 20}},
                    {.translate = {-0.5, -0.2, 3.7}, .rotate = {80, 0, 40}},
                    {.translate = {0.5, -0.3, 4.3}, .rotate = {200, 30, 0}},
                    {.translate = {0, 0.3, 4.9}, .rotate = {30, 90, 120}}};
  scene.bodies.push_back(body);
  scene.obstacles = {ground(), tree(2.4)};
  return scene;
}

Scene make_robots_on_tree_massive() {
  Scene scene;
  scene.title = "125 robots fall on a tree, two million triangles on their skins";
  scene.seconds = 6;
  SceneBody body = robot(464, 8e4);
  body.place.translate = {0, 0, 9.5};
  body.grid = SceneGrid{.count = {5, 5, 5}, .spacing = {1, 0.85, 1.2}, .jitter = 0.04, .jitter_rotate = 25, .seed = 1};
  scene.bodies.push_back(body);
  scene.obstacles = {ground(), tree(6)};
  return scene;
}

Scene make_stack() {
  Scene scene;
  scene.title = "Three boxes and a ring come to rest on each other";
  for (int i = 0; i < 3; ++i) {
    SceneBody body;
    body.source.box = Vec3d{0.6, 0.6, 0.3};
    body.mesh.lattice.cell_size = 0.1;
    body.material.elastic.young = 3e5;
    body.material.damping_time = 0.004;
    body.place.translate = {0.01 * (i % 2), 0, 0.16 + 0.33 * i};
    body.place.rotate = {0, 0, 12.0 * i};
    scene.bodies.push_back(body);
  }
  SceneBody ring;
  ring.source.sample = "torus";
  ring.source.size = 0.6;
  ring.mesh.lattice.tets = 1000;
  ring.material.damping_time = 0.004;
  ring.place = {.translate = {0, 0, 1.25}, .rotate = {0, 8, 0}};
  scene.bodies.push_back(ring);
  scene.obstacles.push_back(ground());
  return scene;
}

Scene make_twist() {
  Scene scene;
  scene.title = "A beam is twisted by one and a half turns and let go";
  scene.seconds = 6;
  SceneBody body = beam(1e5);
  body.material.damping_time = 0.003;
  ScenePin turned = end_of_beam(1);
  turned.spin = {180, 0, 0};
  turned.until = 3;
  turned.release = 4;
  body.pins = {end_of_beam(-1), turned};
  body.place.translate = {0, 0, 1.3};
  scene.bodies.push_back(body);
  scene.obstacles.push_back(ground());
  return scene;
}

Scene make_cantilever() {
  Scene scene;
  scene.title = "A beam held at one end bends under its weight";
  SceneBody body = beam(1e6);
  body.material.elastic.poisson = 0.3;
  body.material.damping_time = 0.004;
  body.pins = {end_of_beam(-1)};
  body.place.translate = {0, 0, 0.9};
  scene.bodies.push_back(body);
  scene.obstacles.push_back(ground());
  return scene;
}

struct BuiltinScene {
  std::string_view name, summary;
  Scene (*make)();
};

constexpr std::array<BuiltinScene, 6> kScenes{{
    {"drop", "a soft robot of 2,000 tets falls on the ground", make_drop},
    {"robots-on-tree", "four robots, 3,000 tets in all, fall on a tree", make_robots_on_tree},
    {"robots-on-tree-massive", "125 robots, 58,000 tets in all, with 2,000,000 triangles on them",
     make_robots_on_tree_massive},
    {"stack", "three boxes and a ring come to rest on each other", make_stack},
    {"twist", "a beam is twisted by one and a half turns and let go", make_twist},
    {"cantilever", "a beam held at one end bends under its weight", make_cantilever},
}};

const BuiltinScene& find_scene(std::string_view name) {
  const auto found =
      std::find_if(kScenes.begin(), kScenes.end(), [&](const auto& scene) { return scene.name == name; });
  if (found != kScenes.end()) return *found;
  throw InvalidInput("scene = " + std::string(name) + ", must be one of " + listing(scene_names()));
}

}  // namespace

std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  for (const BuiltinScene& scene : kScenes) names.emplace_back(scene.name);
  return names;
}

std::string scene_summary(std::string_view name) {
  return std::string(find_scene(name).summary);
}

Scene make_scene(std::string_view name) {
  return find_scene(name).make();
}

}  // namespace tetsoup
