// The field as VTK ImageData.
#include <cmath>
#include <cstring>
#include <limits>
#include <string>

#include "base/block_grid.h"
#include "tet_file_fixtures.h"
#include "tetsoup/io.h"
#include "vote_grids.h"

namespace tetsoup {

namespace {

using WriteFieldTest = FolderTest;

struct Field {
  DistanceField field;
  PseudoVolume volume;
};

// A ball of radius 2 about the middle of a grid wider than one word of bits.
Field ball_field(double band) {
  Field made;
  GridFrame frame;
  frame.size = {70, 7, 5};
  frame.origin = {-1.5, 0.1, 1e-3};
  frame.voxel_size = 0.25;
  made.field.distance = make_block_grid(frame);
  made.volume.inside.frame = frame;
  std::vector<float> slab(slab_values(made.field.distance, 0), std::numeric_limits<float>::infinity());
  made.field.band = band;
  made.field.d_max = 33;
  made.volume.inside.words_per_row = 2;
  made.volume.inside.words.resize(2 * 7 * 5);
  for (int z = 0; z < 5; ++z)
    for (int y = 0; y < 7; ++y)
      for (int x = 0; x < 70; ++x) {
        const float r = std::hypot(static_cast<float>(x - 65), static_cast<float>(y - 3), static_cast<float>(z - 2));
        const float d = std::abs(r - 2);
        if (d < band) slab[static_cast<std::size_t>((z * 7 + y) * 128 + x)] = d;
        if (r < 2)
          made.volume.inside.words[made.volume.inside.row(y, z) + static_cast<std::size_t>(x / 64)] |= 1ULL << (x % 64);
      }
  store_slab(made.field.distance, 0, slab);
  made.volume.votes =
      test::make_votes(frame, [&](int x, int y, int z) { return made.volume.inside.test(x, y, z) ? 26 : x % 13; });
  return made;
}

// The bytes of the array whose appended data begins at `offset`, after its length.
std::string array_at(const std::string& file, std::size_t offset) {
  const std::size_t at = file.find("<AppendedData encoding=\"raw\">") + 29;
  const std::size_t begin = file.find('_', at) + 1 + offset;
  std::uint64_t length = 0;
  std::memcpy(&length, file.data() + begin, sizeof length);
  return file.substr(begin + sizeof length, length);
}

float float_at(const std::string& bytes, std::size_t index) {
  float value = 0;
  std::memcpy(&value, bytes.data() + sizeof value * index, sizeof value);
  return value;
}

}  // namespace

TEST_F(WriteFieldTest, holds_all_four_arrays_with_the_values_given) {
  const Field made = ball_field(std::numeric_limits<double>::infinity());
  write_field(folder_ / "f.vti", made.field, made.volume);
  const std::string file = bytes_of(folder_ / "f.vti");
  const std::size_t count = 70 * 7 * 5;
  const std::string distance = array_at(file, 0), with_sign = array_at(file, 8 + 4 * count);
  const std::string votes = array_at(file, 16 + 8 * count), inside = array_at(file, 24 + 9 * count);
  ASSERT_EQ(distance.size(), 4 * count);
  ASSERT_EQ(with_sign.size(), 4 * count);
  ASSERT_EQ(votes.size(), count);
  ASSERT_EQ(inside.size(), count);
  const std::vector<float> given = dense(made.field.distance).values;
  for (std::size_t i = 0; i < count; ++i) {
    const float d = given[i];
    const int x = static_cast<int>(i % 70), y = static_cast<int>(i / 70 % 7), z = static_cast<int>(i / 70 / 7);
    const bool is_inside = made.volume.inside.test(x, y, z);
    ASSERT_EQ(float_at(distance, i), d);
    ASSERT_EQ(float_at(with_sign, i), is_inside ? -d : d);
    ASSERT_EQ(static_cast<int>(votes[i]), is_inside ? 26 : x % 13);
    ASSERT_EQ(inside[i], is_inside ? 1 : 0);
  }
  EXPECT_TRUE(file.ends_with("</VTKFile>\n"));
  EXPECT_EQ(file.find("\"known_up_to\""), file.npos);
}

TEST_F(WriteFieldTest, says_where_the_voxel_centres_are) {
  const Field made = ball_field(4);
  write_field(folder_ / "f.vti", made.field, made.volume);
  const std::string file = bytes_of(folder_ / "f.vti");
  for (const char* part : {"WholeExtent=\"0 69 0 6 0 4\"", "Extent=\"0 69 0 6 0 4\"", "Origin=\"-1.5 0.1 0.001\"",
                           "Spacing=\"0.25 0.25 0.25\"", "type=\"UInt8\" Name=\"votes\"", "Name=\"inside\""})
    EXPECT_NE(file.find(part), file.npos) << part;
}

TEST_F(WriteFieldTest, unknown_distances_stand_as_the_band_and_the_file_says_so) {
  const Field made = ball_field(1.5);
  write_field(folder_ / "f.vti", made.field, made.volume);
  const std::string file = bytes_of(folder_ / "f.vti");
  const std::string distance = array_at(file, 0);
  EXPECT_EQ(float_at(distance, 0), 1.5F);
  for (std::size_t i = 0; i < distance.size() / 4; ++i) ASSERT_LE(float_at(distance, i), 1.5F);
  EXPECT_NE(file.find("Name=\"known_up_to\" NumberOfTuples=\"1\" format=\"ascii\">1.5<"), file.npos);
}

TEST_F(WriteFieldTest, a_volume_of_another_grid_is_refused) {
  Field made = ball_field(4);
  made.volume.votes.frame.size[0] = 69;
  EXPECT_THROW(write_field(folder_ / "f.vti", made.field, made.volume), InvalidInput);
  EXPECT_TRUE(files().empty());
}

TEST_F(WriteFieldTest, a_failed_write_leaves_the_old_file) {
  const Field made = ball_field(4);
  put_file(folder_ / "f.vti", "old");
  EXPECT_THROW(write_field(folder_ / "none" / "f.vti", made.field, made.volume), IoError);
  if (std::filesystem::exists("/dev/full")) {
    EXPECT_THROW(write_field("/dev/full", made.field, made.volume), IoError);
  }
  EXPECT_EQ(bytes_of(folder_ / "f.vti"), "old");
  EXPECT_EQ(files().size(), 1U);
}

}  // namespace tetsoup
