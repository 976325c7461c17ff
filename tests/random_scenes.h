// Scenes at random: any value that the table of keys allows, extremes more often than not, few tets.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "scene/problem.h"
#include "tetsoup/scene.h"

namespace tetsoup::test {

/// Sets members of a struct through visit_fields().
class RandomFields {
 public:
  RandomFields(std::mt19937_64& random, double share) : random_(random), share_(share) {}

  template <class Member, class Rule>
  void operator()(std::string_view, Member& member, const Rule& rule) {
    if (chance(share_)) set(member, rule);
  }
  void angle(std::string_view, double& radians, const scene::Range& degrees) {
    if (chance(share_)) radians = number(degrees) * scene::kDegree;
  }
  void angles(std::string_view, Vec3d& radians, const scene::Range& degrees) {
    if (!chance(share_)) return;
    set(radians, degrees);
    radians = {radians.x * scene::kDegree, radians.y * scene::kDegree, radians.z * scene::kDegree};
  }
  void instances(std::string_view, SceneBody&) {}
  void surface(std::string_view, SceneBody& body) { body.surface = chance(0.5); }

  bool chance(double share) { return static_cast<double>(random_() >> 11) * 0x1p-53 < share; }
  std::size_t below(std::size_t count) { return static_cast<std::size_t>(random_() % count); }

  double number(const scene::Range& range) {
    const double u = static_cast<double>(random_() >> 11) * 0x1p-53;
    double value = range.low + u * (range.high - range.low);
    switch (below(6)) {
      case 0:
        value = range.low;
        break;
      case 1:
        value = range.high;
        break;
      case 2:  // near nothing
        value = (chance(0.5) ? 1 : -1) * std::pow(10.0, 8 * u - 8);
        break;
      case 3:  // of everyday size
        value = (chance(0.5) ? 1 : -1) * std::pow(10.0, 4 * u - 2);
        break;
      default:
        break;
    }
    value = std::clamp(value, range.low, range.high);
    return range.holds(value) ? value : 0.5 * (range.low + range.high);
  }

 private:
  template <class Number>
  requires std::is_arithmetic_v<Number>
  void set(Number& member, const scene::Range& range) {
    member = static_cast<Number>(std::is_integral_v<Number> ? std::round(number(range)) : number(range));
    if (!range.holds(static_cast<double>(member))) member = static_cast<Number>(range.low);
  }
  void set(Vec3d& member, const scene::Range& range) { member = {number(range), number(range), number(range)}; }
  void set(std::array<int, 3>&, const scene::Range&) {}
  void set(Box3& member, const scene::Corners&) { member = {{-1e3, -1e3, -1e3}, {1e3, 1e3, 1e3}}; }
  void set(std::string&, const scene::Text&) {}
  template <class Value, std::size_t size>
  void set(Value& member, const scene::Words<Value, size>& words) {
    member = words.all[below(size)].value;
  }
  template <class Member, class Rule>
  void set(std::optional<Member>& member, const Rule& rule) {
    member.emplace();
    set(*member, rule);
  }
  template <class Member>
  requires scene::HasFields<Member>
  void set(Member& member, const scene::Object&) { scene::visit_fields(*this, member); }
  template <class Member>
  void set(std::vector<Member>&, const scene::Objects&) {}

  std::mt19937_64& random_;
  double share_;
};

/// May be refused, but for what check_scene() cannot know only.
inline Scene random_scene(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  RandomFields fields(random, 0.3);
  Scene scene;
  scene::visit_fields(fields, scene);
  scene.simulation.substeps = 1 + static_cast<int>(fields.below(6));
  scene.simulation.max_substeps = 1 + static_cast<int>(fields.below(12));
  scene.seconds = 4 / scene.fps;
  const std::size_t bodies = 1 + fields.below(3);
  for (std::size_t i = 0; i < bodies; ++i) {
    SceneBody body;
    scene::visit_fields(fields, body);
    body.source = {};
    // Bodies of one scene are of like size, so that they meet.
    const double size =
        scene.bodies.empty() ? std::pow(10.0, fields.number({-4, 5, ""})) : scene.bodies[0].source.box->x;
    body.source.box = Vec3d{size, size * (0.2 + 0.1 * static_cast<double>(fields.below(9))), size};
    body.source.origin = SceneOrigin::Centre;
    body.mesh = {};
    body.mesh.distance.voxels = 12;
    body.mesh.lattice.cells = 1 + static_cast<int>(fields.below(3));
    if (fields.chance(0.5)) body.place.translate = {0, 0, size * static_cast<double>(i)};
    if (fields.chance(0.5)) body.place.scale = 1;
    for (Vec3d* v : {&body.place.velocity, &body.place.spin})
      if (fields.chance(0.5)) *v = {v->x * 1e-4, v->y * 1e-4, v->z * 1e-4};
    if (fields.chance(0.3)) {
      ScenePin& pin = body.pins.emplace_back();
      scene::visit_fields(fields, pin);
      pin.box.reset();
      pin.axis = static_cast<int>(fields.below(3));
      pin.below = 0;
      pin.above.reset();
    }
    if (fields.chance(0.2)) scene::visit_fields(fields, body.springs.emplace_back());
    if (fields.chance(0.3)) {
      scene::visit_fields(fields, body.grid.emplace());
      body.grid->count = {1 + static_cast<int>(fields.below(2)), 1, 1 + static_cast<int>(fields.below(3))};
      if (fields.chance(0.7)) body.grid->spacing = {size, size, size};
    }
    scene.bodies.push_back(body);
  }
  const std::size_t obstacles = fields.below(3);
  for (std::size_t i = 0; i < obstacles; ++i) {
    SceneObstacle obstacle;
    if (fields.chance(0.5)) {
      scene::visit_fields(fields, obstacle.plane.emplace());
      if (fields.chance(0.7)) obstacle.plane->offset = 0;
    } else {
      const double size = scene.bodies[0].source.box->x;
      obstacle.source.box = Vec3d{size, size, size};
      scene::visit_fields(fields, obstacle.place);
      obstacle.place.velocity = obstacle.place.spin = {};
      if (fields.chance(0.6)) obstacle.place.translate = {0.3 * size, 0, -0.5 * size};
      if (fields.chance(0.6)) obstacle.place.scale = 1;
      obstacle.voxels = 4 + static_cast<int>(fields.below(12));
    }
    scene.obstacles.push_back(obstacle);
  }
  return scene;
}

}  // namespace tetsoup::test
