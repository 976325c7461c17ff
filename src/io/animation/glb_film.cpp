#include "io/animation/glb_film.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "base/vec.h"
#include "io/animation/glb_mesh.h"
#include "io/animation/tones.h"

namespace tetsoup::animation {
namespace {

using json = nlohmann::json;

constexpr std::size_t kMaxTargets = 96;  // Of a make. Programs that draw by WebGL 2 or Vulkan bear hundreds.
// Of a make's targets. A fine surface has fewer of them, yet enough for what bends softly.
constexpr std::size_t kTargetBytes = std::size_t{48} << 20;
constexpr std::size_t kFewTargets = 12;

/// Factors of a material are linear, colours as we state them are sRGB.
double linear(float value) {
  return value <= 0.04045F ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

std::size_t add_material(GlbBuilder& glb, const std::string& name, const Rgb& colour) {
  return glb.add("materials", {{"name", name},
                               {"doubleSided", true},
                               {"pbrMetallicRoughness",
                                {{"baseColorFactor", {linear(colour.r), linear(colour.g), linear(colour.b), 1.0}},
                                 {"metallicFactor", 0.0},
                                 {"roughnessFactor", 0.65}}}});
}

/// glTF's scenes are y up.
std::array<double, 4> turn_to_y_up(UpAxis up) {
  const double half = std::sqrt(0.5);
  if (up == UpAxis::Z) return {-half, 0, 0, half};
  if (up == UpAxis::X) return {0, 0, half, half};
  return {0, 0, 0, 1};
}

/// A square of a plane below the box, with room around.
TriangleSoup patch_of(const AnimationPlane& plane, const Box3& box) {
  const auto [normal, u, v, offset] = axes_of(plane);
  const Vec3d middle = (box.lo + box.hi) * 0.5;
  const Vec3d foot = middle - normal * (dot(normal, middle) - offset);
  const double reach = 1.5 * std::max(length(box.hi - box.lo), 1e-6);
  TriangleSoup patch;
  for (const auto& [a, b] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
    patch.vertices.push_back(to_float(foot + u * (a * reach) + v * (b * reach)));
  patch.triangles = {{0, 1, 2}, {0, 2, 3}};
  return patch;
}

std::size_t add_still_node(GlbBuilder& glb, const std::string& name, const TriangleSoup& soup, std::size_t material) {
  const TetMesh rest{soup.vertices, {}};
  Make make{&rest, nullptr, nullptr, soup.triangles, soup.vertices.size(), {}};
  for (std::uint32_t v = 0; v < soup.vertices.size(); ++v) make.shown.push_back(v);
  const GlbMesh mesh(make);
  const json primitive{
      {"attributes", {{"POSITION", glb.add_positions(mesh.positions())}, {"NORMAL", glb.add_vectors(mesh.normals())}}},
      {"indices", glb.add_indices(mesh.indices())},
      {"material", material}};
  return glb.add("nodes", {{"name", name},
                           {"mesh", glb.add("meshes", {{"name", name}, {"primitives", json::array({primitive})}})}});
}

}  // namespace

GlbFilm::GlbFilm(const Cast& cast, UpAxis up) : cast_(cast), up_(up) {
  std::vector<std::size_t> counts(cast.makes.size());
  for (const std::size_t make : cast.make_of) place_in_make_.push_back(counts[make]++);
  for (std::size_t m = 0; m < cast.makes.size(); ++m) motions_.emplace_back(*cast.makes[m].mesh, counts[m]);
}

void GlbFilm::add(FrameView& view) {
  times_.push_back(static_cast<float>(view.frame().time));
  for (std::size_t b = 0; b < view.body_count(); ++b) {
    motions_[cast_.make_of[b]].add(place_in_make_[b], view.frame().positions[b]);
    for (const Vec3& p : view.frame().positions[b]) {
      if (!box_) box_ = Box3{to_double(p), to_double(p)};
      extend(*box_, to_double(p));
    }
  }
}

GlbFilm::SharedMesh GlbFilm::add_mesh(GlbBuilder& glb, std::size_t make, const ReducedMotion& motion) const {
  const GlbMesh mesh(cast_.makes[make]);
  SharedMesh shared;
  shared.targets = motion.shapes.size();
  if (mesh.indices().empty()) return shared;
  json attributes{{"POSITION", glb.add_positions(mesh.positions())}, {"NORMAL", glb.add_vectors(mesh.normals())}};
  if (!mesh.texcoords().empty()) attributes["TEXCOORD_0"] = glb.add_texcoords(mesh.texcoords());
  shared.primitive = {{"attributes", std::move(attributes)}, {"indices", glb.add_indices(mesh.indices())}};
  for (const std::vector<Vec3>& shape : motion.shapes) {
    const GlbMesh::Target target = mesh.target(shape);
    shared.primitive["targets"].push_back(
        {{"POSITION", glb.add_positions(target.positions)}, {"NORMAL", glb.add_vectors(target.normals)}});
  }
  return shared;
}

std::size_t GlbFilm::mesh_in_tone(GlbBuilder& glb, std::size_t body, const SharedMesh& mesh) {
  const std::size_t make = cast_.make_of[body], tone = body % tones::kBodies.size();
  const auto [place, is_new] = toned_.try_emplace({make, tone}, 0);
  if (is_new) {
    json primitive = mesh.primitive;
    primitive["material"] = tone;
    json object{{"name", cast_.scene.bodies[body].name}, {"primitives", json::array({std::move(primitive)})}};
    if (mesh.targets > 0) {
      json names = json::array();
      for (std::size_t k = 0; k < mesh.targets; ++k) names.push_back("shape " + std::to_string(k + 1));
      object["extras"] = {{"targetNames", std::move(names)}};
    }
    place->second = glb.add("meshes", std::move(object));
  }
  return place->second;
}

std::size_t GlbFilm::add_body(GlbBuilder& glb, std::size_t body, const SharedMesh& mesh, const BodyTrack& track,
                              std::size_t times, json& animation) {
  std::vector<float> translations, rotations, weights;
  for (const MotionKey& key : track.keys) {
    for (const double part : {key.translation.x, key.translation.y, key.translation.z})
      translations.push_back(static_cast<float>(part));
    for (const double part : key.rotation) rotations.push_back(static_cast<float>(part));
    weights.insert(weights.end(), key.weights.begin(), key.weights.end());
  }
  const MotionKey& first = track.keys.front();
  json node{{"name", cast_.scene.bodies[body].name},
            {"translation", {first.translation.x, first.translation.y, first.translation.z}},
            {"rotation", first.rotation},
            {"scale", {track.scale, track.scale, track.scale}}};
  if (!mesh.primitive.is_null()) {
    node["mesh"] = mesh_in_tone(glb, body, mesh);
    if (mesh.targets > 0) node["weights"] = first.weights;
  }
  const std::size_t index = glb.add("nodes", std::move(node));
  const auto add_channel = [&](const char* path, std::size_t samples) {
    json& samplers = animation["samplers"];
    samplers.push_back({{"input", times}, {"output", samples}, {"interpolation", "LINEAR"}});
    animation["channels"].push_back({{"sampler", samplers.size() - 1}, {"target", {{"node", index}, {"path", path}}}});
  };
  add_channel("translation", glb.add_samples(translations, 3));
  add_channel("rotation", glb.add_samples(rotations, 4));
  if (mesh.targets > 0 && !mesh.primitive.is_null()) add_channel("weights", glb.add_samples(weights, 1));
  return index;
}

void GlbFilm::add_still(GlbBuilder& glb, json& children) {
  if (!cast_.obstacles.empty()) {
    const std::size_t material = add_material(glb, "obstacle", tones::kObstacle);
    for (std::size_t i = 0; i < cast_.obstacles.size(); ++i) {
      const TriangleSoup& soup = cast_.obstacles[i];
      if (soup.triangles.empty()) continue;
      children.push_back(add_still_node(glb, cast_.scene.obstacles[i].name, soup, material));
      for (const Triangle& t : soup.triangles)
        for (const std::uint32_t v : t) extend(*box_, to_double(soup.vertices[v]));
    }
  }
  if (cast_.scene.planes.empty()) return;
  const std::size_t material = add_material(glb, "ground", tones::kGround);
  for (const AnimationPlane& plane : cast_.scene.planes)
    children.push_back(add_still_node(glb, "ground", patch_of(plane, *box_), material));
}

void GlbFilm::write(const std::filesystem::path& path, FileLog& log) {
  if (times_.empty()) return;
  if (!box_) box_ = Box3{};
  GlbBuilder glb;
  const std::size_t tone_count = std::min(tones::kBodies.size(), cast_.make_of.size());
  for (std::size_t tone = 0; tone < tone_count; ++tone)
    add_material(glb, "tone " + std::to_string(tone + 1), tones::kBodies[tone]);
  json animation{{"name", "simulation"}}, children = json::array();
  const std::size_t times = glb.add_times(times_);
  std::vector<SharedMesh> meshes;
  std::vector<ReducedMotion> motions;
  for (std::size_t m = 0; m < cast_.makes.size(); ++m) {
    const std::size_t bytes = std::max<std::size_t>(1, cast_.makes[m].point_count) * 2 * sizeof(Vec3);
    motions.push_back(motions_[m].reduce(std::clamp(kTargetBytes / bytes, kFewTargets, kMaxTargets)));
    meshes.push_back(add_mesh(glb, m, motions.back()));
    log.report.glb_targets += motions.back().shapes.size();
    log.report.glb_error = std::max(log.report.glb_error, motions.back().error);
  }
  for (std::size_t b = 0; b < cast_.make_of.size(); ++b) {
    const std::size_t m = cast_.make_of[b];
    children.push_back(add_body(glb, b, meshes[m], motions[m].tracks[place_in_make_[b]], times, animation));
  }
  add_still(glb, children);
  const std::size_t top =
      glb.add("nodes", {{"name", "scene"}, {"rotation", turn_to_y_up(up_)}, {"children", std::move(children)}});
  if (animation.contains("channels")) glb.root["animations"] = json::array({std::move(animation)});
  glb.root["scenes"] = {{{"nodes", {top}}}};
  glb.root["scene"] = 0;
  glb.write(path);
  log.note(path);
}

}  // namespace tetsoup::animation
