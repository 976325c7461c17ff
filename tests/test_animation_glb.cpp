// Animated glTF: what its nodes and morph targets say in a frame is what was given.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "animation_fixtures.h"

namespace tetsoup {
namespace {

namespace fs = std::filesystem;
using json = nlohmann::json;
using GlbFilmTest = AnimationTest;

/// A .glb, as somebody sees it who knows the format alone.
struct Glb {
  json root;
  std::string binary;

  explicit Glb(const fs::path& path) {
    const std::string bytes = bytes_of(path);
    std::uint32_t total = 0, text = 0;
    std::memcpy(&total, bytes.data() + 8, 4);
    std::memcpy(&text, bytes.data() + 12, 4);
    EXPECT_EQ(bytes.substr(0, 4), "glTF");
    EXPECT_EQ(total, bytes.size());
    EXPECT_EQ(text % 4, 0U);
    root = json::parse(bytes.substr(20, text));
    binary = bytes.substr(28 + text);
  }

  std::vector<float> floats(const json& accessor) const {
    const json& a = root["accessors"][accessor.get<std::size_t>()];
    const json& view = root["bufferViews"][a["bufferView"].get<std::size_t>()];
    std::vector<float> values(view["byteLength"].get<std::size_t>() / 4);
    std::memcpy(values.data(), binary.data() + view["byteOffset"].get<std::size_t>(), 4 * values.size());
    return values;
  }

  /// Values of a node's channel at a frame of so many.
  std::vector<float> sample(std::size_t node, const std::string& path, std::size_t frame, std::size_t frames) const {
    const json& animation = root["animations"][0];
    for (const json& channel : animation["channels"]) {
      if (channel["target"]["node"] != node || channel["target"]["path"] != path) continue;
      const auto values = floats(animation["samplers"][channel["sampler"].get<std::size_t>()]["output"]);
      const auto width = static_cast<std::ptrdiff_t>(values.size() / frames);
      const auto begin = values.begin() + static_cast<std::ptrdiff_t>(frame) * width;
      return {begin, begin + width};
    }
    return {};
  }

  /// The vertices of a body's node in a frame.
  std::vector<Vec3> positions(std::size_t node, std::size_t frame, std::size_t frames) const {
    const json& n = root["nodes"][node];
    const json& primitive = root["meshes"][n["mesh"].get<std::size_t>()]["primitives"][0];
    std::vector<float> local = floats(primitive["attributes"]["POSITION"]);
    const auto weights = sample(node, "weights", frame, frames);
    for (std::size_t k = 0; k < weights.size(); ++k) {
      const auto target = floats(primitive["targets"][k]["POSITION"]);
      for (std::size_t i = 0; i < local.size(); ++i) local[i] += weights[k] * target[i];
    }
    const auto shift = sample(node, "translation", frame, frames), q = sample(node, "rotation", frame, frames);
    const float scale = n["scale"][0].get<float>();
    std::vector<Vec3> world;
    for (std::size_t i = 0; i < local.size(); i += 3) {
      const float x = scale * local[i], y = scale * local[i + 1], z = scale * local[i + 2];
      const float tx = 2 * (q[1] * z - q[2] * y), ty = 2 * (q[2] * x - q[0] * z), tz = 2 * (q[0] * y - q[1] * x);
      world.push_back({x + q[3] * tx + q[1] * tz - q[2] * ty + shift[0],
                       y + q[3] * ty + q[2] * tx - q[0] * tz + shift[1],
                       z + q[3] * tz + q[0] * ty - q[1] * tx + shift[2]});
    }
    return world;
  }
};

double distance_to_nearest(const Vec3& p, const std::vector<Vec3>& points) {
  double nearest = INFINITY;
  for (const Vec3& q : points)
    nearest =
        std::min(nearest, std::hypot(double{p.x} - double{q.x}, double{p.y} - double{q.y}, double{p.z} - double{q.z}));
  return nearest;
}

}  // namespace

TEST_F(GlbFilmTest, the_morph_targets_of_a_glb_tell_every_frame) {
  constexpr std::size_t kFrames = 8;
  const AnimationReport report = write({folder_ / "a.glb"}, kFrames);
  const Glb glb(folder_ / "a.glb");
  EXPECT_GT(report.glb_targets, 0U);
  EXPECT_LT(report.glb_error, 0.005);
  for (std::size_t frame = 0; frame < kFrames; ++frame) {
    const auto positions = positions_at(frame);
    const std::vector<Vec3> surface = deform_points(embedding_, bar_.tets, positions[1]);
    for (const Vec3& p : glb.positions(0, frame, kFrames)) EXPECT_LT(distance_to_nearest(p, positions[0]), 0.02);
    for (const Vec3& p : glb.positions(1, frame, kFrames)) EXPECT_LT(distance_to_nearest(p, surface), 0.02);
  }
  const auto times = glb.floats(glb.root["animations"][0]["samplers"][0]["input"]);
  EXPECT_FLOAT_EQ(times.back(), static_cast<float>(time_of(kFrames - 1)));
}

TEST_F(GlbFilmTest, a_glb_is_read_as_the_first_frame_with_y_up) {
  scene_.bodies.erase(scene_.bodies.begin());
  scene_.planes.clear();
  const auto positions = turned(bar_.vertices, 0.5);
  AnimationWriter writer({folder_ / "a.glb"}, scene_);
  writer.add_frame({0, 0, {positions}, {}, {}});
  writer.finish();
  const RenderMesh read = read_render_mesh(folder_ / "a.glb");
  std::vector<Vec3> y_up;
  for (const Vec3& p : deform_points(embedding_, bar_.tets, positions)) y_up.push_back({p.x, p.z, -p.y});
  for (const Vec3& p : read.vertices) EXPECT_LT(distance_to_nearest(p, y_up), 1e-4);
  for (const Vec2& t : read.texcoords)
    EXPECT_NE(std::find(quads_.texcoords.begin(), quads_.texcoords.end(), t), quads_.texcoords.end());
  EXPECT_EQ(read.corners.size(), 3 * 16U);
}

TEST_F(GlbFilmTest, what_moves_rigidly_has_no_morph_targets_in_a_glb) {
  scene_.bodies.erase(scene_.bodies.begin() + 1);
  AnimationWriter writer({folder_ / "a.glb"}, scene_);
  std::vector<std::vector<Vec3>> frames;
  for (int i = 0; i < 50; ++i) {
    frames.push_back(turned(bar_.vertices, 0.25 * i));
    writer.add_frame({0.1 * i, 0, {frames.back()}, {}, {}});
  }
  writer.finish();
  EXPECT_EQ(writer.report().glb_targets, 0U);
  const Glb glb(folder_ / "a.glb");
  double alike = 1;
  for (std::size_t i = 0; i < 50; ++i) {
    for (const Vec3& p : glb.positions(0, i, 50)) EXPECT_LT(distance_to_nearest(p, frames[i]), 1e-4);
    if (i == 0) continue;
    const auto a = glb.sample(0, "rotation", i - 1, 50), b = glb.sample(0, "rotation", i, 50);
    alike = std::min(alike, double{a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3]});
  }
  EXPECT_GT(alike, 0.99) << "between two frames it turns the short way";
}

TEST_F(GlbFilmTest, bodies_of_one_make_share_what_they_are_made_of_in_a_glb) {
  const AnimationBody body = scene_.bodies[1];
  const auto size_with = [&](std::size_t count) {
    scene_.bodies.assign(count, body);
    AnimationWriter writer({folder_ / "a.glb"}, scene_);
    const auto positions = positions_at(3)[1];
    writer.add_frame({0, 0, std::vector<std::span<const Vec3>>(count, positions), {}, {}});
    writer.finish();
    return Glb(folder_ / "a.glb").binary.size();
  };
  const std::size_t one = size_with(1), many = size_with(50);
  EXPECT_LT(many - one, 50 * 64U) << "a key of one body is all that is its own";
}

}  // namespace tetsoup
