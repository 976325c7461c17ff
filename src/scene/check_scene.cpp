#include <algorithm>
#include <cstdlib>
#include <sstream>

#include "base/listing.h"
#include "base/vec.h"
#include "scene/check.h"
#include "scene/problem.h"
#include "tetsoup/error.h"
#include "tetsoup/samples.h"
#include "tetsoup/scene.h"

namespace tetsoup {

namespace scene {

std::string number_words(double value) {
  for (int digits = 6; digits < 17; ++digits) {
    std::ostringstream text;
    text.precision(digits);
    text << value;
    // Not std::stod, which throws at numbers below the normal ones.
    if (std::strtod(text.str().c_str(), nullptr) == value) return text.str();
  }
  std::ostringstream text;
  text.precision(17);
  text << value;
  return text.str();
}

void check_number(const std::string& path, double value, const Range& range) {
  if (range.holds(value)) return;
  throw Problem(path, (std::isfinite(value) ? number_words(value) : "this") + " is out of range; give " +
                          std::string(range.words));
}

namespace {

constexpr std::size_t kMostInstances = 100000;
constexpr double kMostFrames = 1e6;

/// Ranges of all members; it changes none.
class RangeChecker {
 public:
  explicit RangeChecker(std::string path) : path_(std::move(path)) {}

  template <class Member, class Rule>
  void operator()(std::string_view key, const Member& member, const Rule& rule) {
    check(member_path(path_, key), member, rule);
  }
  void angle(std::string_view key, double radians, const Range& degrees) {
    check_number(member_path(path_, key), degrees_of(radians), degrees);
  }
  void angles(std::string_view key, const Vec3d& radians, const Range& degrees) {
    check(member_path(path_, key), Vec3d{degrees_of(radians.x), degrees_of(radians.y), degrees_of(radians.z)}, degrees);
  }
  void instances(std::string_view key, const SceneBody& body) {
    const std::string path = member_path(path_, key);
    check(path, body.grid, Object{});
    check(path, body.instances, Objects{});
  }
  void surface(std::string_view, const SceneBody&) {}

 private:
  template <class Member, class Rule>
  static void check(const std::string& path, const std::optional<Member>& member, const Rule& rule) {
    if (member) check(path, *member, rule);
  }
  template <class Number>
  requires std::is_arithmetic_v<Number>
  static void check(const std::string& path, Number member, const Range& range) {
    check_number(path, static_cast<double>(member), range);
  }
  static void check(const std::string& path, const Vec3d& member, const Range& range) {
    check_number(item_path(path, 0), member.x, range);
    check_number(item_path(path, 1), member.y, range);
    check_number(item_path(path, 2), member.z, range);
  }
  static void check(const std::string& path, const std::array<int, 3>& member, const Range& range) {
    for (std::size_t i = 0; i < 3; ++i) check_number(item_path(path, i), member[i], range);
  }
  static void check(const std::string& path, const Box3& member, const Corners& corners) {
    check(item_path(path, 0), member.lo, corners.range);
    check(item_path(path, 1), member.hi, corners.range);
  }
  static void check(const std::string&, const std::string&, const Text&) {}
  template <class Value, std::size_t size>
  static void check(const std::string& path, const Value& member, const Words<Value, size>& words) {
    check_word(path, member, words);
  }
  template <class Member>
  requires HasFields<Member>
  static void check(const std::string& path, const Member& member, const Object&) {
    RangeChecker checker(path);
    // Visitors that write need what they visit to be changeable; this one takes it as it is.
    visit_fields(checker, const_cast<Member&>(member));
  }
  template <class Member>
  static void check(const std::string& path, const std::vector<Member>& members, const Objects&) {
    for (std::size_t i = 0; i < members.size(); ++i) check(item_path(path, i), members[i], Object{});
  }

  std::string path_;
};

/// @throws Problem  if more than one of the keys is given.
void check_at_most_one(const std::string& path, std::initializer_list<std::pair<const char*, bool>> given) {
  const char* first = nullptr;
  for (const auto& [key, is_given] : given) {
    if (!is_given) continue;
    if (first != nullptr)
      throw Problem(path, std::string("\"") + first + "\" and \"" + key + "\" are both given; give only one of them");
    first = key;
  }
}

void check_mesh(const std::string& path, const MeshOptions& o) {
  check_at_most_one(path,
                    {{"voxels", o.distance.voxels.has_value()}, {"voxel_size", o.distance.voxel_size.has_value()}});
  check_at_most_one(path, {{"k", o.pseudo_volume.k.has_value()},
                           {"band_voxels", o.pseudo_volume.band_voxels.has_value()},
                           {"band", o.pseudo_volume.band.has_value()}});
  check_at_most_one(path, {{"tets", o.lattice.tets.has_value()},
                           {"vertices", o.lattice.vertices.has_value()},
                           {"edge", o.lattice.edge.has_value()},
                           {"cells", o.lattice.cells.has_value()},
                           {"cell_size", o.lattice.cell_size.has_value()}});
}

void check_source(const std::string& path, const SceneSource& s, const char* kinds) {
  check_at_most_one(path, {{"sample", !s.sample.empty()},
                           {"file", !s.file.empty()},
                           {"tets_file", !s.tets_file.empty()},
                           {"box", s.box.has_value()}});
  if (s.sample.empty() && s.file.empty() && s.tets_file.empty() && !s.box)
    throw Problem(path, std::string("it has no shape; give ") + kinds);
  const std::vector<std::string> samples = sample_names();
  if (!s.sample.empty() && std::find(samples.begin(), samples.end(), s.sample) == samples.end())
    throw Problem(member_path(path, "sample"),
                  "there is no sample \"" + s.sample + "\"; there are " + listing(samples));
  if (s.sample.empty() && s.damage != 0) throw Problem(member_path(path, "damage"), "only a sample can be damaged");
  check_at_most_one(path, {{"size", s.size.has_value()}, {"metres_per_unit", s.metres_per_unit.has_value()}});
  if (s.box && (s.size || s.metres_per_unit))
    throw Problem(member_path(path, s.size ? "size" : "metres_per_unit"), "the sizes of a box are metres already");
}

void check_pin(const std::string& path, const ScenePin& p) {
  if (p.box.has_value() == p.axis.has_value())
    throw Problem(path, p.box ? "\"box\" and \"axis\" are both given; give only one of them"
                              : "it has no place; give \"box\", or \"axis\" with \"below\" or \"above\"");
  if (p.axis && !p.below && !p.above) throw Problem(path, "\"axis\" needs \"below\" or \"above\"");
  if (p.box && (p.below || p.above))
    throw Problem(member_path(path, p.below ? "below" : "above"), "this goes with \"axis\", not with \"box\"");
  if (p.box && (p.box->lo.x > p.box->hi.x || p.box->lo.y > p.box->hi.y || p.box->lo.z > p.box->hi.z))
    throw Problem(member_path(path, "box"), "the first corner lies beyond the second; exchange their numbers");
}

void check_body(const std::string& path, const SceneBody& body) {
  check_source(path, body.source, "one of sample, file, tets_file and box");
  check_mesh(member_path(path, "mesh"), body.mesh);
  if (!body.source.tets_file.empty() && body.mesh != MeshOptions{})
    throw Problem(member_path(path, "mesh"), "a tets_file is a mesh already; leave this out");
  if (!body.instances.empty() && body.grid)
    throw Problem(member_path(path, "instances"), "there are both places and a grid; give only one of them");
  if (instance_count(body) > kMostInstances)
    throw Problem(member_path(path, "instances"),
                  number_words(static_cast<double>(instance_count(body))) + " are too many; give at most 100000");
  for (std::size_t i = 0; i < body.pins.size(); ++i) check_pin(item_path(member_path(path, "pins"), i), body.pins[i]);
}

void check_obstacle(const std::string& path, const SceneObstacle& o) {
  if (!o.plane) {
    check_source(path, o.source, "one of plane, sample, file and box");
    if (!o.source.tets_file.empty())
      throw Problem(member_path(path, "tets_file"), "an obstacle is made of triangles; give file");
    if (o.place.velocity != Vec3d{} || o.place.spin != Vec3d{})
      throw Problem(member_path(path, "place"), "an obstacle does not move; leave out velocity and spin");
    return;
  }
  if (o.source != SceneSource{} || o.place != ScenePlace{})
    throw Problem(path, "a plane has neither shape nor place; leave out what is not plane, name or friction");
  const double size = length(o.plane->normal);
  if (!(size > 0)) throw Problem(member_path(path, "plane.normal"), "its length is 0");
  if (!(std::abs(o.plane->offset) <= kFar * size))
    throw Problem(member_path(path, "plane.offset"), "the plane lies beyond 1e5 m from the origin");
}

}  // namespace

std::size_t instance_count(const SceneBody& body) {
  if (!body.grid) return std::max<std::size_t>(1, body.instances.size());
  std::size_t count = 1;
  for (const int n : body.grid->count) count *= static_cast<std::size_t>(n);
  return count;
}

void check(const Scene& scene) {
  RangeChecker ranges("");
  visit_fields(ranges, const_cast<Scene&>(scene));
  if (scene.bodies.empty()) throw Problem("bodies", "there is none; give at least one");
  if (scene.seconds * scene.fps > kMostFrames)
    throw Problem("seconds", "that makes more than 1e6 frames; give fewer seconds or fps");
  std::size_t instances = 0;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    check_body(item_path("bodies", i), scene.bodies[i]);
    instances += instance_count(scene.bodies[i]);
  }
  if (instances > kMostInstances) throw Problem("bodies", "there are more than 100000 with all instances; give fewer");
  for (std::size_t i = 0; i < scene.obstacles.size(); ++i)
    check_obstacle(item_path("obstacles", i), scene.obstacles[i]);
}

}  // namespace scene

void check_scene(const Scene& scene) {
  try {
    scene::check(scene);
  } catch (const scene::Problem& problem) {
    throw InvalidInput(problem.what());
  }
}

std::size_t frame_count(const Scene& scene) {
  return static_cast<std::size_t>(std::llround(scene.seconds * scene.fps));
}

}  // namespace tetsoup
