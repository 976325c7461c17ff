// What a simulation is written as: every file, read again, shows the frames that were given.
#include "tetsoup/animation.h"

#include <png.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>
#include <string>
#include <vector>

#include "animation_fixtures.h"

namespace tetsoup {
namespace {

namespace fs = std::filesystem;

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

template <class Act>
void expect_io_error(const Act& act, const std::vector<std::string>& parts) {
  const std::string text = io_error_of(act);
  for (const std::string& part : parts) EXPECT_NE(text.find(part), text.npos) << text;
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
