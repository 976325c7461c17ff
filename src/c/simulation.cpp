// C: bodies that move, and scenes of them.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "c/guard.h"
#include "c/handles.h"
#include "tetsoup/report.h"

using namespace tetsoup;
using Json = nlohmann::ordered_json;

namespace {

void add_body(tetsoup_simulation& s, std::string name, std::shared_ptr<const c::Make> make, const char* material,
              const char* place, std::size_t& number) {
  number = s.simulation().add_body(make->mesh, parse_material(c::options_or_none(material)),
                                   parse_place(c::options_or_none(place)));
  s.bodies.push_back({std::move(name), std::move(make), {}, {}});
}

/// Bodies of one asset share it.
void add_bodies_of_scene(tetsoup_simulation& s) {
  std::vector<std::shared_ptr<const c::Make>> makes;
  for (SceneAsset& asset : s.scene->assets)
    makes.push_back(
        std::make_shared<const c::Make>(c::make_of(asset.mesh, asset.surface, std::move(asset.embedding), {})));
  for (const LoadedBody& body : s.scene->bodies) s.bodies.push_back({body.name, makes[body.asset], {}, {}});
}

Json bodies_json(const tetsoup_simulation& s) {
  std::vector<const c::Make*> makes;
  Json bodies = Json::array();
  for (const tetsoup_simulation::Body& body : s.bodies) {
    auto make = std::find(makes.begin(), makes.end(), body.make.get());
    if (make == makes.end()) make = makes.insert(makes.end(), body.make.get());
    bodies.push_back({{"name", body.name},
                      {"vertex_count", body.make->mesh.vertices.size()},
                      {"tet_count", body.make->mesh.tets.size()},
                      {"make", make - makes.begin()}});
  }
  return bodies;
}

LoadedScene& scene_of(tetsoup_simulation& s) {
  if (!s.scene) throw InvalidInput("the simulation is not of a scene");
  return *s.scene;
}

}  // namespace

const tetsoup_simulation::Body& tetsoup_simulation::body(std::size_t number) const {
  require(number < bodies.size(), "body", number, "below the number of bodies");
  return bodies[number];
}

tetsoup_status tetsoup_simulation_create(const char* options, tetsoup_simulation** simulation) {
  return c::guarded([&] {
    tetsoup_simulation*& out = c::given(simulation, "simulation");
    auto made = std::make_unique<tetsoup_simulation>();
    made->own.emplace(parse_simulation_options(c::options_or_none(options)));
    out = made.release();
  });
}

tetsoup_status tetsoup_simulation_add_model(tetsoup_simulation* simulation, const tetsoup_model* model,
                                            const char* material, const char* place, size_t* body) {
  return c::guarded([&] {
    const tetsoup_model& m = c::given(model, "model");
    add_body(c::given(simulation, "simulation"), m.settings.name, m.make, material, place, c::given(body, "body"));
  });
}

tetsoup_status tetsoup_simulation_add_mesh(tetsoup_simulation* simulation, const float* vertices, size_t vertex_count,
                                           const uint32_t* tets, size_t tet_count, const char* material,
                                           const char* place, size_t* body) {
  return c::guarded([&] {
    TetMesh mesh{c::points_from(vertices, vertex_count, "vertices"), c::items_from<4>(tets, tet_count, "tets")};
    auto make = std::make_shared<const c::Make>(c::make_of(std::move(mesh), {}, {}, {}));
    add_body(c::given(simulation, "simulation"), "mesh", std::move(make), material, place, c::given(body, "body"));
  });
}

tetsoup_status tetsoup_simulation_add_plane(tetsoup_simulation* simulation, const double normal[3], double offset,
                                            double friction) {
  return c::guarded([&] {
    c::given(simulation, "simulation").simulation().add_plane(c::vector_from(normal, "normal"), offset, friction);
  });
}

tetsoup_status tetsoup_simulation_add_obstacle(tetsoup_simulation* simulation, const tetsoup_soup* soup, int32_t voxels,
                                               double friction, tetsoup_progress progress, void* context) {
  return c::guarded([&] {
    Simulation& s = c::given(simulation, "simulation").simulation();
    s.add_obstacle(c::given(soup, "soup").input->soup, voxels, friction, c::progress_of(progress, context));
  });
}

tetsoup_status tetsoup_simulation_pin(tetsoup_simulation* simulation, size_t body, uint32_t vertex) {
  return c::guarded([&] { c::given(simulation, "simulation").simulation().pin({body, vertex}); });
}

tetsoup_status tetsoup_simulation_unpin(tetsoup_simulation* simulation, size_t body, uint32_t vertex) {
  return c::guarded([&] { c::given(simulation, "simulation").simulation().unpin({body, vertex}); });
}

tetsoup_status tetsoup_simulation_add_spring(tetsoup_simulation* simulation, size_t body, uint32_t vertex,
                                             const double target[3], double stiffness, size_t* spring) {
  return c::guarded([&] {
    Simulation& s = c::given(simulation, "simulation").simulation();
    c::given(spring, "spring") = s.add_spring({body, vertex}, c::vector_from(target, "target"), stiffness);
  });
}

tetsoup_status tetsoup_simulation_move_spring(tetsoup_simulation* simulation, size_t spring, const double target[3]) {
  return c::guarded(
      [&] { c::given(simulation, "simulation").simulation().move_spring(spring, c::vector_from(target, "target")); });
}

tetsoup_status tetsoup_simulation_remove_spring(tetsoup_simulation* simulation, size_t spring) {
  return c::guarded([&] { c::given(simulation, "simulation").simulation().remove_spring(spring); });
}

tetsoup_status tetsoup_simulation_step(tetsoup_simulation* simulation, double seconds) {
  return c::guarded([&] { c::given(simulation, "simulation").simulation().step(seconds); });
}

tetsoup_status tetsoup_simulation_body_count(const tetsoup_simulation* simulation, size_t* count) {
  return c::guarded([&] { c::given(count, "count") = c::given(simulation, "simulation").bodies.size(); });
}

tetsoup_status tetsoup_simulation_positions(const tetsoup_simulation* simulation, size_t body,
                                            tetsoup_floats* positions) {
  return c::guarded([&] {
    c::given(positions, "positions") = c::view_of(c::given(simulation, "simulation").simulation().positions(body));
  });
}

tetsoup_status tetsoup_simulation_velocities(const tetsoup_simulation* simulation, size_t body,
                                             tetsoup_floats* velocities) {
  return c::guarded([&] {
    c::given(velocities, "velocities") = c::view_of(c::given(simulation, "simulation").simulation().velocities(body));
  });
}

tetsoup_status tetsoup_simulation_set_positions(tetsoup_simulation* simulation, size_t body, const float* positions,
                                                size_t vertex_count) {
  return c::guarded([&] {
    const std::vector<Vec3> points = c::points_from(positions, vertex_count, "positions");
    c::given(simulation, "simulation").simulation().set_positions(body, points);
  });
}

tetsoup_status tetsoup_simulation_set_velocities(tetsoup_simulation* simulation, size_t body, const float* velocities,
                                                 size_t vertex_count) {
  return c::guarded([&] {
    const std::vector<Vec3> vectors = c::points_from(velocities, vertex_count, "velocities");
    c::given(simulation, "simulation").simulation().set_velocities(body, vectors);
  });
}

tetsoup_status tetsoup_simulation_tets(tetsoup_simulation* simulation, size_t body, tetsoup_indices* tets) {
  return c::guarded(
      [&] { c::given(tets, "tets") = c::view_of(c::given(simulation, "simulation").body(body).make->mesh.tets); });
}

tetsoup_status tetsoup_simulation_triangles(tetsoup_simulation* simulation, size_t body, tetsoup_indices* triangles) {
  return c::guarded([&] {
    c::given(triangles, "triangles") = c::view_of(c::given(simulation, "simulation").body(body).make->triangles);
  });
}

tetsoup_status tetsoup_simulation_surface(tetsoup_simulation* simulation, size_t body, tetsoup_floats* vertices,
                                          tetsoup_floats* normals) {
  return c::guarded([&] {
    tetsoup_simulation& s = c::given(simulation, "simulation");
    tetsoup_simulation::Body& b = s.body(body);
    const std::span<const Vec3> positions = s.simulation().positions(body);
    const bool has_surface = !b.make->render.vertices.empty();
    if (has_surface)
      c::deform(*b.make, positions, vertices == nullptr ? nullptr : &b.surface,
                normals == nullptr ? nullptr : &b.normals);
    if (vertices != nullptr) *vertices = c::view_of(has_surface ? std::span<const Vec3>(b.surface) : positions);
    if (normals != nullptr) *normals = c::view_of(b.normals);
  });
}

tetsoup_status tetsoup_simulation_state_hash(const tetsoup_simulation* simulation, uint64_t* hash) {
  return c::guarded([&] { c::given(hash, "hash") = c::given(simulation, "simulation").simulation().state_hash(); });
}

tetsoup_status tetsoup_simulation_report(const tetsoup_simulation* simulation, const char** json) {
  return c::guarded([&] {
    const char*& out = c::given(json, "json");
    const tetsoup_simulation& s = c::given(simulation, "simulation");
    Json report{{"time", s.simulation().time()}};
    report.update(Json::parse(to_json(s.simulation().report())));
    report["energy"] = Json::parse(to_json(s.simulation().energy()));
    report["bodies"] = bodies_json(s);
    out = c::keep_text(report.dump(-1, ' ', false, Json::error_handler_t::replace));
  });
}

void tetsoup_simulation_destroy(tetsoup_simulation* simulation) {
  delete simulation;
}

tetsoup_status tetsoup_scene_load(const char* text, const char* folder, tetsoup_progress progress, void* context,
                                  tetsoup_simulation** simulation) {
  return c::guarded([&] {
    tetsoup_simulation*& out = c::given(simulation, "simulation");
    const Scene scene = parse_scene(&c::given(text, "text"), folder == nullptr ? "" : folder);
    auto made = std::make_unique<tetsoup_simulation>();
    made->scene.emplace(load_scene(scene, c::progress_of(progress, context)));
    add_bodies_of_scene(*made);
    out = made.release();
  });
}

tetsoup_status tetsoup_scene_advance(tetsoup_simulation* simulation) {
  return c::guarded([&] { advance_frame(scene_of(c::given(simulation, "simulation"))); });
}

tetsoup_status tetsoup_scene_seek(tetsoup_simulation* simulation, size_t frame) {
  return c::guarded([&] { seek_frame(scene_of(c::given(simulation, "simulation")), frame); });
}

tetsoup_status tetsoup_scene_obstacle_count(const tetsoup_simulation* simulation, size_t* count) {
  return c::guarded([&] {
    const tetsoup_simulation& s = c::given(simulation, "simulation");
    c::given(count, "count") = s.scene ? s.scene->obstacles.size() : 0;
  });
}

tetsoup_status tetsoup_scene_obstacle(const tetsoup_simulation* simulation, size_t obstacle, tetsoup_floats* vertices,
                                      tetsoup_indices* triangles) {
  return c::guarded([&] {
    const tetsoup_simulation& s = c::given(simulation, "simulation");
    const std::size_t known = s.scene ? s.scene->obstacles.size() : 0;
    require(obstacle < known, "obstacle", obstacle, "below the number of obstacles");
    const TriangleSoup& soup = s.scene->obstacles[obstacle].soup;
    c::given(vertices, "vertices") = c::view_of(soup.vertices);
    c::given(triangles, "triangles") = c::view_of(soup.triangles);
  });
}
