// From words to bodies: sources are read, meshed and hung with their surfaces once each, then placed.
#include <algorithm>
#include <limits>

#include "base/vec.h"
#include "scene/check.h"
#include "scene/pins.h"
#include "scene/problem.h"
#include "scene/source.h"
#include "tetsoup/error.h"
#include "tetsoup/io.h"
#include "tetsoup/regions.h"
#include "tetsoup/scene.h"
#include "tetsoup/tetsoup.h"

namespace tetsoup {

namespace scene {
namespace {

/// Adds the path to what the library has to say.
template <class Action>
auto at_path(const std::string& path, const Action& action) {
  try {
    return action();
  } catch (const InvalidInput& error) {
    throw InvalidInput(path + ": " + error.what());
  } catch (const IoError& error) {
    throw IoError(path + ": " + error.what());
  }
}

class Loader {
 public:
  Loader(const Scene& scene, const Progress& progress)
      : progress_(progress), loaded_{scene, {}, {}, {}, {}, Simulation(scene.simulation), {}, 0} {}

  LoadedScene load() {
    const Scene& scene = loaded_.scene;
    for (std::size_t i = 0; i < scene.obstacles.size(); ++i) {
      const std::string path = item_path("obstacles", i);
      at_path(path, [&] { add_obstacle(path, scene.obstacles[i]); });
    }
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
      const std::string path = item_path("bodies", i);
      at_path(path, [&] { add_body(path, i); });
    }
    loaded_.surfaces.resize(loaded_.bodies.size());
    deform_surfaces(loaded_);
    return std::move(loaded_);
  }

 private:
  void add_obstacle(const std::string& path, const SceneObstacle& obstacle) {
    if (obstacle.plane)
      return loaded_.simulation.add_plane(obstacle.plane->normal, obstacle.plane->offset, obstacle.friction);
    RenderMesh surface = make_surface(obstacle.source, loaded_.scene.folder);
    to_metres(unit_of(path, obstacle.source, surface.vertices, surface.origin), surface.vertices, surface.origin);
    TriangleSoup soup = clean_soup(triangles_of(surface), progress_).soup;
    check_number(path + ": its longest side as placed, m", longest_side(soup.vertices) * obstacle.place.scale,
                 kPlacedSizeRange);
    for (Vec3& p : soup.vertices) {
      const Vec3d at = placed(obstacle.place, tetsoup::placed(p, soup.origin));
      for (const double v : {at.x, at.y, at.z}) check_number(member_path(path, "place"), v, kPlaceRange);
      p = to_float(at);
    }
    soup.origin = {};
    loaded_.simulation.add_obstacle(soup, obstacle.voxels, obstacle.friction, progress_);
    loaded_.obstacles.push_back({obstacle.name.empty() ? name_of(obstacle.source) : obstacle.name, std::move(soup)});
  }

  void add_body(const std::string& path, std::size_t number) {
    const SceneBody& body = loaded_.scene.bodies[number];
    const std::size_t asset = find_asset(path, body);
    const std::vector<ScenePlace> places = places_of(body);
    const double longest = longest_side(loaded_.assets[asset].mesh.vertices);
    std::vector<Pose> poses;
    for (const ScenePlace& place : places) {
      check_number(path + ": its longest side as placed, m", longest * place.scale, kPlacedSizeRange);
      poses.push_back(pose_of(place));
    }
    const std::size_t first = loaded_.simulation.add_bodies(loaded_.assets[asset].mesh, body.material, poses);
    const std::string name = body.name.empty() ? name_of(body.source) : body.name;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const std::string suffix = places.size() > 1 ? "_" + std::to_string(i) : "";
      loaded_.bodies.push_back({name + suffix, number, i, asset});
      for (std::size_t p = 0; p < body.pins.size(); ++p)
        add_pin(item_path(member_path(path, "pins"), p), body.pins[p], first + i, places[i]);
      for (std::size_t s = 0; s < body.springs.size(); ++s) add_spring(body.springs[s], first + i);
    }
  }

  /// Bodies that only differ in material or place share it.
  std::size_t find_asset(const std::string& path, const SceneBody& body) {
    for (std::size_t i = 0; i < makers_.size(); ++i) {
      const SceneBody& other = *makers_[i];
      if (other.source == body.source && other.mesh == body.mesh && other.surface == body.surface &&
          other.surface_file == body.surface_file)
        return i;
    }
    loaded_.assets.push_back(make_asset(path, body));
    makers_.push_back(&body);
    return makers_.size() - 1;
  }

  SceneAsset make_asset(const std::string& path, const SceneBody& body) {
    SceneAsset asset;
    asset.name = name_of(body.source);
    Unit unit;
    if (!body.source.tets_file.empty()) {
      asset.mesh = read_tets(loaded_.scene.folder / body.source.tets_file);
      unit = unit_of(path, body.source, asset.mesh.vertices, asset.mesh.origin);
      to_metres(unit, asset.mesh.vertices, asset.mesh.origin);
    } else {
      asset.surface = make_surface(body.source, loaded_.scene.folder);
      unit = unit_of(path, body.source, asset.surface.vertices, asset.surface.origin);
      to_metres(unit, asset.surface.vertices, asset.surface.origin);
      MeshOptions options = body.mesh;
      options.memory_limit = usable_memory();
      asset.mesh = mesh_soup(triangles_of(asset.surface), options, progress_);
    }
    if (asset.mesh.tets.empty()) throw Problem(path, "there is no tet in it");
    if (!body.surface) asset.surface = {};
    if (body.surface && !body.surface_file.empty()) {
      asset.surface = read_render_mesh(loaded_.scene.folder / body.surface_file);
      to_metres(unit, asset.surface.vertices, asset.surface.origin);
    }
    if (asset.has_surface()) asset.embedding = embed_points(asset.mesh, triangles_of(asset.surface), {}, progress_);
    return asset;
  }

  const TetMesh& mesh_of(std::size_t body) const { return loaded_.assets[loaded_.bodies[body].asset].mesh; }

  void add_pin(const std::string& path, const ScenePin& pin, std::size_t body, const ScenePlace& place) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    Box3 box = pin.box.value_or(Box3{{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}});
    if (pin.axis) {
      const auto side = [&](Vec3d& corner) -> double& {
        return *pin.axis == 0 ? corner.x : *pin.axis == 1 ? corner.y : corner.z;
      };
      side(box.lo) = pin.above.value_or(-kInfinity);
      side(box.hi) = pin.below.value_or(kInfinity);
    }
    std::vector<std::uint32_t> vertices = vertices_in_box(mesh_of(body), box);
    if (vertices.empty()) throw Problem(path, "no vertex lies there; " + extent_words(mesh_of(body)));
    for (const std::uint32_t v : vertices) loaded_.simulation.pin({body, v});
    if (is_driven(pin) || pin.release) add_moved(path, pin, body, place, std::move(vertices));
  }

  static std::string extent_words(const TetMesh& mesh) {
    const Box3 around = box_of(mesh.vertices), box{around.lo + mesh.origin, around.hi + mesh.origin};
    const auto words = [](const Vec3d& p) {
      return "[" + number_words(std::round(p.x * 1e4) / 1e4) + ", " + number_words(std::round(p.y * 1e4) / 1e4) + ", " +
             number_words(std::round(p.z * 1e4) / 1e4) + "]";
    };
    return "the body reaches from " + words(box.lo) + " to " + words(box.hi) + " m";
  }

  void add_moved(const std::string& path, const ScenePin& pin, std::size_t body, const ScenePlace& place,
                 std::vector<std::uint32_t> vertices) {
    MovedPin moved{body, std::move(vertices), {}, {}, turned(place, pin.velocity), {}, pin.until, pin.release, false};
    moved.spin = turned(place, pin.spin) * kDegree;
    const std::span<const Vec3> positions = loaded_.simulation.positions(body);
    Vec3d sum;
    for (const std::uint32_t v : moved.vertices) {
      moved.starts.push_back(positions[v]);
      sum += to_double(positions[v]);
    }
    moved.centre = pin.about ? placed(place, *pin.about) : sum * (1 / static_cast<double>(moved.vertices.size()));
    const double end = std::min({loaded_.scene.seconds, pin.until.value_or(kFar), pin.release.value_or(kFar)});
    double reach = 0;
    for (const Vec3& p : moved.starts) reach = std::max(reach, length(to_double(p) - moved.centre));
    check_number(path + ": farthest way, m", length(moved.centre) + reach + length(moved.velocity) * end, kPlaceRange);
    check_number(path + ": speed, m/s", length(moved.velocity) + length(moved.spin) * reach, kSpeedRange);
    loaded_.moved.push_back(std::move(moved));
  }

  void add_spring(const SceneSpring& spring, std::size_t body) {
    const TetMesh& mesh = mesh_of(body);
    std::uint32_t nearest = mesh.tets.front()[0];
    for (const Tet& tet : mesh.tets)
      for (const std::uint32_t v : tet)
        if (squared_length(tetsoup::placed(mesh.vertices[v], mesh.origin) - spring.at) <
            squared_length(tetsoup::placed(mesh.vertices[nearest], mesh.origin) - spring.at))
          nearest = v;
    loaded_.simulation.add_spring({body, nearest}, spring.to, spring.stiffness);
  }

  const Progress& progress_;
  LoadedScene loaded_;
  std::vector<const SceneBody*> makers_;  ///< Of the assets.
};

}  // namespace
}  // namespace scene

LoadedScene load_scene(const Scene& scene, const Progress& progress) {
  check_scene(scene);
  try {
    return scene::Loader(scene, progress).load();
  } catch (const scene::Problem& problem) {
    throw InvalidInput(problem.what());
  }
}

}  // namespace tetsoup
