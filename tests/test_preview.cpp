// The preview picture: it is a PNG of the right size, shows what it is given, and survives anything.
#include <gtest/gtest.h>
#include <png.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <set>

#include "tetsoup/error.h"
#include "tetsoup/io.h"
#include "tetsoup/samples.h"
#include "vote_grids.h"

namespace tetsoup {
namespace {

constexpr int kWidth = 400;

/// A scene that owns what it shows: a sphere, its votes, and five tets.
struct SmallScene {
  TriangleSoup soup = make_sample("sphere");
  PseudoVolume volume;
  TetMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}},
               {{0, 3, 6, 5}, {1, 0, 3, 5}, {2, 3, 0, 6}, {4, 0, 5, 6}, {7, 3, 6, 5}}};
  PreviewScene scene;

  SmallScene() {
    constexpr int kSize = 20;
    GridFrame frame;
    frame.size = {kSize, kSize, kSize};
    frame.origin = {-1, -1, -1};
    frame.voxel_size = 0.1;
    const auto votes_at = [](int x, int y, int z) {
      return static_cast<int>(std::max(0.0, 26 - 13.0 / 7 * std::hypot(x - 9.5, y - 9.5, z - 9.5)));
    };
    volume.votes = test::make_votes(frame, votes_at);
    volume.inside.frame = frame;
    volume.inside.words_per_row = 1;
    volume.inside.words.assign(kSize * kSize, 0);
    for (int z = 0; z < kSize; ++z) {
      for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
          if (votes_at(x, y, z) >= 14) volume.inside.words[volume.inside.row(y, z)] |= std::uint64_t{1} << x;
        }
      }
    }
    scene = {&soup, &volume, &mesh, &mesh, "A sphere", {"soup", "votes", "lattice", "mesh"}};
  }
  SmallScene(const SmallScene&) = delete;
};

std::filesystem::path picture_path() {
  const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
  return std::filesystem::temp_directory_path() / (std::string("tetsoup_preview_") + test->name() + ".png");
}

/// Draws the scene and gives back the file's bytes.
std::string drawn(const PreviewScene& scene, int width = kWidth) {
  const auto path = picture_path();
  write_preview(path, scene, width);
  std::ifstream file(path, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(file), {}};
  file.close();
  std::filesystem::remove(path);
  return bytes;
}

struct Picture {
  int width = 0, height = 0;
  std::vector<png_byte> rgb;

  explicit Picture(const std::string& bytes) {
    png_image header{};
    header.version = PNG_IMAGE_VERSION;
    if (png_image_begin_read_from_memory(&header, bytes.data(), bytes.size()) == 0) return;
    header.format = PNG_FORMAT_RGB;
    rgb.resize(PNG_IMAGE_SIZE(header));
    png_image_finish_read(&header, nullptr, rgb.data(), 0, nullptr);
    width = static_cast<int>(header.width);
    height = static_cast<int>(header.height);
  }

  /// Distinct colours in the middle of one quarter of the picture.
  std::size_t colours(int column, int row) const {
    std::set<std::array<png_byte, 3>> found;
    for (int y = height * (2 * row + 1) / 4 - height / 12; y < height * (2 * row + 1) / 4 + height / 12; ++y) {
      for (int x = width * (2 * column + 1) / 4 - width / 12; x < width * (2 * column + 1) / 4 + width / 12; ++x) {
        const std::size_t at = 3 * static_cast<std::size_t>(y * width + x);
        found.insert({rgb[at], rgb[at + 1], rgb[at + 2]});
      }
    }
    return found.size();
  }
};

TEST(Preview, is_a_png_of_the_width_asked_for) {
  const SmallScene small;
  const std::string bytes = drawn(small.scene);
  EXPECT_EQ(bytes.substr(0, 8), "\x89PNG\r\n\x1a\n");
  const Picture picture(bytes);
  EXPECT_EQ(picture.width, kWidth);
  EXPECT_GT(picture.height, kWidth / 2);
}

TEST(Preview, shows_something_in_each_of_its_four_panels) {
  const SmallScene small;
  const Picture full(drawn(small.scene));
  const TriangleSoup no_soup;
  const PseudoVolume no_volume;
  const TetMesh no_mesh;
  const Picture blank(drawn({&no_soup, &no_volume, &no_mesh, &no_mesh, "", {}}));
  for (const int row : {0, 1}) {
    for (const int column : {0, 1}) {
      EXPECT_LT(blank.colours(column, row), 25U) << "only the backdrop's gradient";
      EXPECT_GT(full.colours(column, row), 2 * blank.colours(column, row)) << column << ' ' << row;
    }
  }
}

TEST(Preview, has_the_same_bytes_for_the_same_scene) {
  const SmallScene first, second;
  EXPECT_EQ(drawn(first.scene), drawn(second.scene));
}

TEST(Preview, stands_as_it_is_told_or_as_the_shape_does) {
  SmallScene small;  // A ball stands on any side, which counts as y up.
  const std::string guessed = drawn(small.scene);
  small.scene.up = UpAxis::Y;
  EXPECT_EQ(drawn(small.scene), guessed);
  small.scene.up = UpAxis::Z;
  EXPECT_NE(drawn(small.scene), guessed);
}

TEST(Preview, leaves_out_the_panels_that_have_no_input) {
  SmallScene small;
  const int four = Picture(drawn(small.scene)).height;
  small.scene.lattice = small.scene.mesh = nullptr;
  const int two = Picture(drawn(small.scene)).height;
  EXPECT_LT(two, four);
  EXPECT_EQ(Picture(drawn({})).width, kWidth);
}

TEST(Preview, skips_garbage_and_draws_the_rest) {
  SmallScene small;
  const std::string clean = drawn(small.scene);
  const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
  const auto first = static_cast<std::uint32_t>(small.soup.vertices.size());
  small.soup.vertices.insert(small.soup.vertices.end(), {{nan, 0, 0}, {0, infinity, 0}, {0, 0, 3e38F}});
  small.soup.triangles.insert(
      small.soup.triangles.end(),
      {{first, 0, 1}, {0, first + 1, 2}, {0, 1, first + 2}, {0, 1, ~0U}, {first + 1, first + 1, first + 1}});
  EXPECT_EQ(drawn(small.scene), clean);
  small.mesh.tets.push_back({0, 1, 2, 99});
  EXPECT_EQ(drawn(small.scene), clean);
}

TEST(Preview, draws_points_needles_and_huge_numbers) {
  const std::vector<TriangleSoup> soups{
      {{{1, 2, 3}}, {{0, 0, 0}}},
      {{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}},
      {{{1e30F, 0, 0}, {-1e30F, 1e30F, 0}, {0, 0, -1e30F}}, {{0, 1, 2}}},
      {{{1e-38F, 0, 0}, {0, 1e-38F, 0}, {0, 0, 1e-38F}}, {{0, 1, 2}}},
      {{{1e7F, 1e7F, 1e7F}, {1e7F + 1, 1e7F, 1e7F}, {1e7F, 1e7F + 1, 1e7F}}, {{0, 1, 2}}},
  };
  for (const TriangleSoup& soup : soups) {
    PreviewScene scene;
    scene.soup = &soup;
    EXPECT_EQ(Picture(drawn(scene)).width, kWidth);
  }
}

TEST(Preview, takes_any_text_however_long) {
  PreviewScene scene;
  scene.title = std::string(3000, 'W') + "\xc3\xa9\xff\x01";
  scene.captions.fill("\xf0\x9f\x8c\xb4 100 % {\"~|\"} \\ `^` \xc3");
  const TriangleSoup soup = make_sample("torus");
  scene.soup = &soup;
  EXPECT_EQ(Picture(drawn(scene)).width, kWidth);
}

TEST(Preview, refuses_a_width_out_of_range) {
  EXPECT_THROW(write_preview(picture_path(), {}, 0), InvalidInput);
  EXPECT_THROW(write_preview(picture_path(), {}, 100000), InvalidInput);
}

}  // namespace
}  // namespace tetsoup
