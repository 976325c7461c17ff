// What a simulation is written as: every file, read again, shows the frames that were given.
#include "tetsoup/animation.h"

#include <png.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "tet_file_fixtures.h"
#include "tetsoup/io.h"

namespace tetsoup {
namespace {

namespace fs = std::filesystem;
using json = nlohmann::json;

/// A bar of eight cubes along x, bent to a circle that grows tighter with time, and moved aside.
std::vector<Vec3> bent(const std::vector<Vec3>& points, double time, double aside = 0) {
  const double curvature = 0.02 + 0.25 * time;
  std::vector<Vec3> moved;
  for (const Vec3& p : points) {
    const double angle = curvature * p.x, radius = 1 / curvature - p.z;
    moved.push_back({static_cast<float>(radius * std::sin(angle) + aside), p.y,
                     static_cast<float>(1 / curvature - radius * std::cos(angle) + 2 * time)});
  }
  return moved;
}

std::vector<Vec3> turned(const std::vector<Vec3>& points, double angle) {
  std::vector<Vec3> moved;
  for (const Vec3& p : points)
    moved.push_back({static_cast<float>(std::cos(angle) * p.x - std::sin(angle) * p.y),
                     static_cast<float>(std::sin(angle) * p.x + std::cos(angle) * p.y + angle),
                     static_cast<float>(p.z + 0.3 * angle)});
  return moved;
}

/// Two bars of one make, one of which shows its quads' surface, and `count` frames of them.
class AnimationTest : public FolderTest {
 protected:
  AnimationTest() {
    for (int x = 0; x <= 8; ++x)
      for (const auto& [y, z] : {std::pair{0, 0}, {1, 0}, {0, 1}, {1, 1}})
        bar_.vertices.push_back({static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)});
    for (std::uint32_t x = 0; x < 8; ++x) {
      const std::uint32_t c = 4 * x;  // Six tets about the cube's diagonal from c to c + 7.
      for (const auto& [a, b] : {std::pair{1U, 3U}, {3U, 2U}, {2U, 6U}, {6U, 4U}, {4U, 5U}, {5U, 1U}}) {
        Tet tet{c, c + a, c + b, c + 7};
        if (volume(tet) < 0) std::swap(tet[1], tet[2]);
        bar_.tets.push_back(tet);
      }
    }
    for (int x = 0; x < 9; ++x)
      for (int y = 0; y < 2; ++y) {
        quads_.vertices.push_back(
            {x == 0 ? 0.1F : static_cast<float>(x) - 0.1F, 0.1F + 0.8F * static_cast<float>(y), 0.9F});
        quads_.texcoords.push_back({static_cast<float>(x) / 8, static_cast<float>(y)});
      }
    for (std::uint32_t x = 0; x < 8; ++x) {
      quads_.face_sizes.push_back(4);
      for (const std::uint32_t v : {2 * x, 2 * x + 2, 2 * x + 3, 2 * x + 1}) {
        quads_.corners.push_back(v);
        quads_.corner_texcoords.push_back(v);
      }
    }
    embedding_ = embed_points(bar_, triangles_of(quads_));
    scene_.bodies = {{"plain", &bar_, nullptr, nullptr}, {"dressed", &bar_, &quads_, &embedding_}};
    scene_.planes = {{{0, 0, 1}, -0.5}};
  }

  double volume(const Tet& t) const {
    const auto edge = [&](std::size_t i) {
      const Vec3 &a = bar_.vertices[t[0]], &b = bar_.vertices[t[i]];
      return std::array<double, 3>{double{b.x} - double{a.x}, double{b.y} - double{a.y}, double{b.z} - double{a.z}};
    };
    const auto a = edge(1), b = edge(2), c = edge(3);
    return (a[1] * b[2] - a[2] * b[1]) * c[0] + (a[2] * b[0] - a[0] * b[2]) * c[1] + (a[0] * b[1] - a[1] * b[0]) * c[2];
  }

  static double time_of(std::size_t number) { return static_cast<double>(number) / 60; }
  std::vector<std::vector<Vec3>> positions_at(std::size_t number) const {
    const double time = 0.2 * static_cast<double>(number);
    return {bent(bar_.vertices, time), turned(bent(bar_.vertices, time, 10), 0.1 * static_cast<double>(number))};
  }

  AnimationReport write(const std::vector<fs::path>& paths, std::size_t count, AnimationOptions options = small(),
                        std::size_t first = 0) const {
    options.first_frame = first;
    AnimationWriter writer(paths, scene_, options);
    for (std::size_t number = first; number < first + count; ++number) {
      const auto positions = positions_at(number);
      writer.add_frame({time_of(number), 0x123456789ABCDEF0U + number, {positions[0], positions[1]}, {}, {}});
    }
    writer.finish();
    return writer.report();
  }

  static AnimationOptions small() {
    AnimationOptions options;
    options.width = 160;
    options.height = 90;
    return options;
  }

  TetMesh bar_;
  RenderMesh quads_;
  Embedding embedding_;
  AnimationScene scene_;
};

std::size_t count_of(const std::string& text, const std::string& what) {
  std::size_t count = 0;
  for (std::size_t at = text.find(what); at != text.npos; at = text.find(what, at + 1)) ++count;
  return count;
}

/// Colours of a PNG, three bytes a pixel.
std::vector<std::uint8_t> pixels_of(const fs::path& path, unsigned width, unsigned height) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  const std::string bytes = bytes_of(path);
  EXPECT_NE(png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()), 0);
  EXPECT_EQ(image.width, width);
  EXPECT_EQ(image.height, height);
  image.format = PNG_FORMAT_RGB;
  std::vector<std::uint8_t> pixels(PNG_IMAGE_SIZE(image));
  png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr);
  return pixels;
}

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

template <class Act>
void expect_io_error(const Act& act, const std::vector<std::string>& parts) {
  const std::string text = io_error_of(act);
  for (const std::string& part : parts) EXPECT_NE(text.find(part), text.npos) << text;
}

double distance_to_nearest(const Vec3& p, const std::vector<Vec3>& points) {
  double nearest = INFINITY;
  for (const Vec3& q : points)
    nearest =
        std::min(nearest, std::hypot(double{p.x} - double{q.x}, double{p.y} - double{q.y}, double{p.z} - double{q.z}));
  return nearest;
}

}  // namespace

TEST_F(AnimationTest, a_folder_gets_all_bodies_of_every_frame_bit_for_bit) {
  const AnimationReport report = write({folder_ / "new" / "run"}, 3);
  EXPECT_EQ(report.frame_count, 3U);
  for (std::size_t number = 0; number < 3; ++number) {
    const TetMesh read = read_tets(folder_ / "new" / "run" / ("frame_000" + std::to_string(number) + ".vtu"));
    std::vector<Vec3> all;
    for (const auto& body : positions_at(number)) all.insert(all.end(), body.begin(), body.end());
    EXPECT_EQ(read.vertices, all);
    ASSERT_EQ(read.tets.size(), 2 * bar_.tets.size());
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_EQ(read.tets[bar_.tets.size()][i], bar_.tets[0][i] + bar_.vertices.size());
  }
  EXPECT_EQ(report.files.size(), 4U);
  std::uintmax_t bytes = 0;
  for (const fs::path& file : report.files) bytes += fs::file_size(file);
  EXPECT_EQ(report.bytes, bytes);
}

TEST_F(AnimationTest, velocities_and_the_state_hash_stand_in_vtu_files) {
  const auto positions = positions_at(0);
  AnimationWriter writer({folder_ / "x.pvd"}, scene_);
  writer.add_frame({0.5, 0x0000000200000003U, {positions[0], positions[1]}, {positions[1], positions[0]}, {}});
  const std::string text = bytes_of(folder_ / "x_0000.vtu");
  EXPECT_NE(text.find("Name=\"velocity\""), text.npos);
  EXPECT_NE(text.find(">2 3</DataArray>"), text.npos);
  EXPECT_NE(text.find(">0.5</DataArray>"), text.npos);
  const std::string expected(reinterpret_cast<const char*>(positions[1].data()), positions[1].size() * sizeof(Vec3));
  EXPECT_EQ(count_of(text, expected), 2U);
}

TEST_F(AnimationTest, a_continued_series_lists_the_old_frames_too) {
  const fs::path path = folder_ / "a & b.pvd";
  write({path}, 5);
  write({path}, 4, small(), 3);  // The last two are done again.
  const std::string list = bytes_of(path);
  EXPECT_EQ(count_of(list, "<DataSet "), 7U);
  std::size_t at = 0;
  for (std::size_t number = 0; number < 7; ++number) {
    const std::size_t next = list.find("a &amp; b_000" + std::to_string(number) + ".vtu", at);
    ASSERT_NE(next, list.npos) << number;
    at = next;
  }
  expect_io_error([&] { write({folder_ / "other.pvd"}, 1, small(), 3); }, {"other.pvd"});
}

TEST_F(AnimationTest, surfaces_keep_polygons_and_texture_coordinates_as_obj) {
  scene_.bodies.erase(scene_.bodies.begin());
  const auto positions = positions_at(1)[1];
  AnimationWriter writer({folder_ / "s.obj", folder_ / "s.ply"}, scene_, {.first_frame = 1});
  writer.add_frame({0, 0, {positions}, {}, {}});
  const RenderMesh obj = read_render_mesh(folder_ / "s_0001.obj");
  const std::vector<Vec3> surface = deform_points(embedding_, bar_.tets, positions);
  EXPECT_EQ(obj.vertices, surface);
  EXPECT_EQ(obj.corners, quads_.corners);
  EXPECT_EQ(obj.face_sizes, quads_.face_sizes);
  EXPECT_EQ(obj.texcoords, quads_.texcoords);
  EXPECT_EQ(obj.corner_texcoords, quads_.corner_texcoords);
  EXPECT_EQ(part_names(obj)[0].name, "dressed");
  const TriangleSoup ply = read_soup(folder_ / "s_0001.ply");
  EXPECT_EQ(ply.vertices, surface);
  EXPECT_EQ(ply.triangles, triangles_of(quads_).triangles);
}

TEST_F(AnimationTest, several_bodies_in_one_obj_keep_their_own_vertices) {
  write({folder_ / "s.obj"}, 1);
  const RenderMesh obj = read_render_mesh(folder_ / "s_0000.obj");
  const auto positions = positions_at(0);
  const std::size_t plain = bar_.vertices.size();  // All of the bar's vertices lie on its boundary.
  ASSERT_EQ(obj.vertices.size(), plain + quads_.vertices.size());
  EXPECT_TRUE(std::equal(positions[0].begin(), positions[0].end(), obj.vertices.begin()));
  EXPECT_EQ(obj.corners.back(), plain + quads_.corners.back());
  EXPECT_EQ(obj.corner_texcoords.back(), quads_.corner_texcoords.back());
  EXPECT_EQ(part_names(obj).size(), 2U);
}

TEST_F(AnimationTest, obstacles_lie_once_beside_a_series) {
  const TriangleSoup wall{{{0, 9, 0}, {9, 9, 0}, {0, 9, 9}}, {{0, 1, 2}, {0, 1, 7}}};
  scene_.obstacles = {{"wall", &wall}};
  write({folder_ / "run", folder_ / "s.obj"}, 2);
  for (const fs::path& path : {folder_ / "run" / "obstacles.obj", folder_ / "s_obstacles.obj"}) {
    const RenderMesh read = read_render_mesh(path);
    EXPECT_EQ(read.vertices, wall.vertices);
    EXPECT_EQ(read.corners.size(), 3U);  // A triangle of vertices that are not there is left out.
  }
}

TEST_F(AnimationTest, a_picture_shows_bodies_and_their_shadows_on_the_ground) {
  write({folder_ / "p.png"}, 2);
  const auto picture = pixels_of(folder_ / "p_0001.png", 160, 90);
  const auto count = [&](const auto& wanted) {
    int pixels = 0;
    for (std::size_t i = 0; i < picture.size(); i += 3)
      pixels += wanted(int{picture[i]}, int{picture[i + 1]}, int{picture[i + 2]});
    return pixels;
  };
  EXPECT_GT(count([](int r, int, int b) { return b > r + 50; }), 100) << "blue";
  EXPECT_GT(count([](int r, int, int b) { return r > b + 50; }), 100) << "orange";
  EXPECT_GT(count([](int r, int g, int b) { return r < 190 && std::abs(r - b) < 25 && std::abs(r - g) < 25; }), 50);
}

TEST_F(AnimationTest, pictures_are_the_same_on_one_thread_and_many) {
  const int before = thread_count();
  set_thread_count(1);
  write({folder_ / "one.png"}, 1);
  set_thread_count(0);
  write({folder_ / "many.png"}, 1);
  set_thread_count(before);
  EXPECT_EQ(bytes_of(folder_ / "one_0000.png"), bytes_of(folder_ / "many_0000.png"));
}

TEST_F(AnimationTest, a_continued_series_of_pictures_keeps_its_point_of_view) {
  AnimationOptions options = small();
  write({folder_ / "all.png"}, 3, options);
  AnimationWriter first({folder_ / "parts.png"}, scene_, options);
  const auto positions = positions_at(0);
  first.add_frame({0, 0, {positions[0], positions[1]}, {}, {}});
  options.view = first.view();
  write({folder_ / "parts.png"}, 2, options, 1);
  EXPECT_EQ(bytes_of(folder_ / "all_0002.png"), bytes_of(folder_ / "parts_0002.png"));
}

TEST_F(AnimationTest, every_axis_can_point_up) {
  std::set<std::string> pictures;
  for (const UpAxis up : {UpAxis::X, UpAxis::Y, UpAxis::Z}) {
    AnimationOptions options = small();
    options.up = up;
    scene_.planes[0] = {{up == UpAxis::X ? 2.0 : 0, up == UpAxis::Y ? 2.0 : 0, up == UpAxis::Z ? 2.0 : 0}, -1};
    write({folder_ / "up.png"}, 1, options);
    pictures.insert(bytes_of(folder_ / "up_0000.png"));
  }
  EXPECT_EQ(pictures.size(), 3U);
}

TEST_F(AnimationTest, a_film_has_every_picture_for_as_long_as_fps_says) {
  AnimationOptions options = small();
  options.fps = 20;
  write({folder_ / "film.webp"}, 6, options);
  const std::string bytes = bytes_of(folder_ / "film.webp");
  EXPECT_EQ(bytes.substr(0, 4), "RIFF");
  EXPECT_EQ(bytes.substr(8, 8), "WEBPVP8X");
  int milliseconds = 0;
  for (std::size_t at = bytes.find("ANMF"); at != bytes.npos; at = bytes.find("ANMF", at + 4)) {
    std::uint32_t duration = 0;
    std::memcpy(&duration, bytes.data() + at + 20, 3);
    milliseconds += static_cast<int>(duration);
  }
  EXPECT_EQ(milliseconds, 300);
  EXPECT_EQ(count_of(bytes, "ANMF"), 6U);
}

TEST_F(AnimationTest, the_morph_targets_of_a_glb_tell_every_frame) {
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

TEST_F(AnimationTest, a_glb_is_read_as_the_first_frame_with_y_up) {
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

TEST_F(AnimationTest, what_moves_rigidly_has_no_morph_targets_in_a_glb) {
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

TEST_F(AnimationTest, bodies_of_one_make_share_what_they_are_made_of_in_a_glb) {
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

TEST_F(AnimationTest, a_film_appears_when_it_is_finished_and_not_before) {
  const auto positions = positions_at(0);
  {
    AnimationWriter writer({folder_ / "a.glb", folder_ / "a.webp"}, scene_, small());
    writer.add_frame({0, 0, {positions[0], positions[1]}, {}, {}});
  }
  EXPECT_TRUE(fs::is_empty(folder_));
  EXPECT_TRUE(write({folder_ / "a.glb", folder_ / "a.webp"}, 0).files.empty());
  EXPECT_EQ(write({folder_ / "a.glb", folder_ / "a.webp"}, 1).files.size(), 2U);
}

TEST_F(AnimationTest, what_a_simulation_holds_is_a_frame_of_it) {
  Simulation simulation;
  simulation.add_body(bar_);
  simulation.step(0.125);
  const AnimationFrame frame = animation_frame(simulation);
  EXPECT_EQ(frame.time, 0.125);
  EXPECT_EQ(frame.state_hash, simulation.state_hash());
  ASSERT_EQ(frame.positions.size(), 1U);
  EXPECT_EQ(frame.positions[0].data(), simulation.positions(0).data());
  EXPECT_EQ(frame.velocities[0].data(), simulation.velocities(0).data());
}

TEST_F(AnimationTest, what_does_not_fit_is_refused_by_name) {
  expect_io_error([&] { write({folder_ / "a.avi"}, 0); }, {"a.avi", ".webp"});
  expect_io_error([&] { write({folder_ / "a.glb"}, 1, small(), 4); }, {"a.glb", "frame 0"});
  AnimationOptions options;
  options.fps = 0;
  EXPECT_THROW(write({}, 0, options), InvalidInput);
  options = {};
  options.width = 20;
  EXPECT_THROW(write({}, 0, options), InvalidInput);
  AnimationScene without = scene_;
  without.bodies[1].embedding = nullptr;
  EXPECT_THROW(AnimationWriter({}, without), InvalidInput);
  without.bodies[1] = {"none", nullptr, nullptr, nullptr};
  EXPECT_THROW(AnimationWriter({}, without), InvalidInput);

  AnimationWriter writer({folder_ / "run"}, scene_);
  auto positions = positions_at(0);
  EXPECT_THROW(writer.add_frame({0, 0, {positions[0]}, {}, {}}), InvalidInput);
  EXPECT_THROW(writer.add_frame({0, 0, {positions[0], std::span(positions[1]).first(3)}, {}, {}}), InvalidInput);
  writer.add_frame({0, 0, {positions[0], positions[1]}, {}, {}});
  EXPECT_THROW(writer.add_frame({0, 0, {positions[0], positions[1]}, {}, {}}), InvalidInput);
  positions[0][5].y = NAN;
  EXPECT_THROW(writer.add_frame({1, 0, {positions[0], positions[1]}, {}, {}}), InvalidInput);
}

}  // namespace tetsoup
