// NumPy files of models, and embeddings in both layouts: exact bytes, and damage.
#include "io/npz.h"

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>

#include "io/tet_readers.h"
#include "io/tet_writers.h"
#include "io/utf8.h"
#include "soup_files.h"

namespace tetsoup {
namespace {

using namespace test;
namespace fs = std::filesystem;
using Arrays = std::map<std::string, NpzArray>;

TEST(Utf8, characters_survive_and_what_is_none_is_marked) {
  const std::string text = "a\xC3\xA4\xE2\x82\xAC\xF0\x9F\x8D\x80";
  EXPECT_EQ(decode_utf8(text), U"a\u00E4\u20AC\U0001F340");
  EXPECT_EQ(encode_utf8(decode_utf8(text)), text);
  for (const char* bad : {"\x80", "\xC3", "\xC0", "\xFF"}) EXPECT_EQ(decode_utf8(bad), U"\uFFFD") << bad;
  EXPECT_EQ(decode_utf8("\xED\xA0\x80"), U"\uFFFD\uFFFD\uFFFD");  // Half of a pair.
  EXPECT_EQ(decode_utf8("\xE2\x82"
                        "b"),
            U"\uFFFD\uFFFDb");
}

TEST(Npz, an_array_has_the_bytes_that_numpy_expects) {
  NpzWriter npz;
  const std::vector<std::int32_t> numbers{1, -2, 3, 4, 5, 6};
  npz.add("a", {2, 3}, std::span<const std::int32_t>(numbers));
  std::string npy("\x93NUMPY\x01\x00\x76\x00", 10);
  npy += "{'descr': '<i4', 'fortran_order': False, 'shape': (2, 3), }";
  npy.resize(127, ' ');
  npy += '\n';
  for (const std::int32_t number : numbers) npy += raw(number);
  const auto u16 = [](int value) { return raw(static_cast<std::uint16_t>(value)); };
  const auto u32 = [](std::size_t value) { return raw(static_cast<std::uint32_t>(value)); };
  const std::string bytes = npz.take(), checksum = bytes.substr(14, 4);
  const std::string facts = u16(20) + u16(0x800) + u16(0) + u16(0) + u16(0x21) + checksum + u32(npy.size()) +
                            u32(npy.size()) + u16(5) + u16(0);
  const std::string member = "PK\x03\x04" + facts + "a.npy" + npy;
  const std::string entry = "PK\x01\x02" + u16(20) + facts + std::string(14, '\0') + "a.npy";
  EXPECT_EQ(bytes,
            member + entry + "PK\x05\x06" + u32(0) + u16(1) + u16(1) + u32(entry.size()) + u32(member.size()) + u16(0));
}

TEST(Npz, what_was_written_is_read) {
  NpzWriter npz;
  const std::vector<float> reals{1, 2, 3, 4};
  const std::vector<std::uint64_t> indices{0, 4294967295};
  const double one = 2.5;
  const std::vector<std::string> texts{"a",
                                       "\xE2\x82\xAC"
                                       "bc"};
  npz.add("reals", {2, 2}, std::span<const float>(reals));
  npz.add("indices", {2}, std::span<const std::uint64_t>(indices));
  npz.add("one", {}, std::span<const double>(&one, 1));
  npz.add("none", {0, 4}, std::span<const float>());
  npz.add_texts("texts", texts);
  const std::string bytes = npz.take();
  const Arrays arrays = read_npz(bytes, "f");
  EXPECT_EQ(arrays.size(), 4U);  // Texts are no numbers.
  EXPECT_EQ(npz_reals(arrays, "f", "reals", 2), std::vector<double>(reals.begin(), reals.end()));
  EXPECT_EQ(npz_indices(arrays, "f", "indices", 0), (std::vector<std::uint32_t>{0, 4294967295}));
  EXPECT_TRUE(arrays.at("one").shape.empty());
  EXPECT_TRUE(npz_reals(arrays, "f", "none", 4).empty());
  EXPECT_THROW(npz_reals(arrays, "f", "reals", 3), IoError);
  EXPECT_THROW(npz_reals(arrays, "f", "nobody", 0), IoError);
  EXPECT_THROW(npz_indices(arrays, "f", "one", 0), IoError);
}

TetModel small_model() {
  TetModel model;
  model.mesh = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}}, {{0, 1, 2, 3}, {1, 2, 3, 4}}};
  model.regions = {{"skin", {.density = 1000, .young = 1e5, .poisson = 0.25}},
                   {"core", {.density = 500, .young = 2e5, .poisson = 0.25}}};
  model.tet_regions = {0, 1};
  return model;
}

TEST(NpzModel, a_plain_mesh_has_newtons_arrays_and_no_others) {
  TetModel model = small_model();
  model.regions.resize(1);
  model.tet_regions.clear();
  const std::string bytes = npz_text(model);
  const Arrays arrays = read_npz(bytes, "f");
  std::string names;
  for (const auto& [name, array] : arrays) names += name + array.type + ' ';
  EXPECT_EQ(names, "density<f8 k_lambda<f4 k_mu<f4 tet_indices<i4 vertices<f4 ");
  EXPECT_EQ(npz_reals(arrays, "f", "k_mu", 0), (std::vector<double>{4e4F, 4e4F}));
  EXPECT_EQ(npz_reals(arrays, "f", "k_lambda", 0), (std::vector<double>{4e4F, 4e4F}));
  const TetMesh mesh = parse_npz(bytes, "f");
  EXPECT_EQ(mesh.vertices, model.mesh.vertices);
  EXPECT_EQ(mesh.tets, model.mesh.tets);
}

TEST(NpzModel, the_rest_is_there_if_the_model_has_it) {
  TetModel model = small_model();
  model.pins = {{"left foot", {0, 2}}, {"left foot", {}}};
  model.render.vertices = {{0, 0, 0}, {2, 2, 2}};
  model.embedding.tets = {0, 1};
  model.embedding.weights = {{1, 0, 0, 0}, {-1, 0, 1, 1}};
  model.embedding.distances = {0, 1};
  const std::string bytes = npz_text(model);
  const Arrays arrays = read_npz(bytes, "f");
  EXPECT_EQ(npz_indices(arrays, "f", "tet_regions", 0), (std::vector<std::uint32_t>{0, 1}));
  EXPECT_EQ(npz_reals(arrays, "f", "tet_densities", 0), (std::vector<double>{1000, 500}));
  EXPECT_EQ(npz_indices(arrays, "f", "pin_left_foot", 0), (std::vector<std::uint32_t>{0, 2}));
  EXPECT_TRUE(npz_indices(arrays, "f", "pin_left_foot_2", 0).empty());
  EXPECT_EQ(npz_indices(arrays, "f", "embedding_tets", 0), model.embedding.tets);
  EXPECT_EQ(npz_reals(arrays, "f", "embedding_weights", 4), (std::vector<double>{1, 0, 0, 0, -1, 0, 1, 1}));
  EXPECT_EQ(npz_reals(arrays, "f", "render_vertices", 3), (std::vector<double>{0, 0, 0, 2, 2, 2}));
  // Once for all but what is of the tets, as Newton numbers it.
  EXPECT_EQ(npz_indices(arrays, "f", "__custom_freqs__", 0), (std::vector<std::uint32_t>{12, 12, 0, 0, 0, 0, 0, 0}));
  // One density gives the mesh its mass: volumes are 1/6 and 1/3.
  double density = 0;
  std::memcpy(&density, arrays.at("density").bytes.data(), sizeof density);
  EXPECT_NEAR(density, (1000.0 + 2 * 500.0) / 3, 1e-9);
}

Embedding small_embedding(std::size_t count) {
  Embedding embedding;
  for (std::size_t i = 0; i < count; ++i) {
    const auto x = static_cast<float>(i);
    embedding.tets.push_back(static_cast<std::uint32_t>(3 * i));
    embedding.weights.push_back({x, 0.5F - x, 0.25F, 0.25F});
    embedding.distances.push_back(i % 2 == 0 ? 0 : x);
  }
  return embedding;
}

class EmbeddingFile : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder); }
  void TearDown() override { fs::remove_all(folder); }
  std::string bytes_of(const char* name, const Embedding& embedding) const {
    write_embedding(folder / name, embedding);
    std::ifstream file(folder / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  const fs::path folder = fs::temp_directory_path() / ("tetsoup-embedding-" + std::to_string(std::random_device()()));
};

TEST_F(EmbeddingFile, a_point_that_is_none_is_still_none_when_read_back) {
  TetMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.tets = {{0, 1, 2, 3}};
  TriangleSoup soup;
  soup.vertices = {{0.1F, 0.1F, 0.1F}, {-0.5F, 0.2F, 0.2F}, {std::nanf(""), 0, 0}};
  const Embedding embedding = embed_points(mesh, soup);
  ASSERT_EQ(embedding.report.non_finite, 1U);
  for (const char* name : {"e.npz", "e.embedding"}) {
    bytes_of(name, embedding);
    const EmbedReport read = read_embedding(folder / name).report;
    EXPECT_EQ(read.non_finite, 1U) << name;
    EXPECT_EQ(read.inside, embedding.report.inside) << name;
    EXPECT_EQ(read.outside, embedding.report.outside) << name;
    EXPECT_EQ(static_cast<float>(read.max_distance), static_cast<float>(embedding.report.max_distance)) << name;
  }
}

TEST_F(EmbeddingFile, both_layouts_give_back_what_was_written) {
  for (const char* name : {"e.npz", "e.embedding"})
    for (const std::size_t count : {0U, 1U, 5U}) {
      const Embedding embedding = small_embedding(count);
      bytes_of(name, embedding);
      const Embedding again = read_embedding(folder / name);
      EXPECT_EQ(again.tets, embedding.tets);
      EXPECT_EQ(again.weights, embedding.weights);
      EXPECT_EQ(again.distances, embedding.distances);
      EXPECT_EQ(again.report.inside, (count + 1) / 2);
      EXPECT_EQ(again.report.outside, count / 2);
      EXPECT_EQ(again.report.max_distance, count == 5 ? 3 : 0);
    }
}

TEST_F(EmbeddingFile, the_compact_layout_is_as_documented) {
  const Embedding e = small_embedding(2);
  std::string expected = "tetembed" + raw(std::uint32_t{1}) + raw(std::uint32_t{0}) + raw(std::uint64_t{2}) +
                         raw(std::uint32_t{0}) + raw(std::uint32_t{3});
  for (const float weight : {0.0F, 0.5F, 0.25F, 0.25F, 1.0F, -0.5F, 0.25F, 0.25F}) expected += raw(weight);
  EXPECT_EQ(bytes_of("e.embedding", e), expected + raw(0.0F) + raw(1.0F));
}

TEST_F(EmbeddingFile, arrays_that_do_not_fit_and_other_extensions_are_refused) {
  Embedding embedding = small_embedding(2);
  EXPECT_THROW(write_embedding(folder / "e.bin", embedding), IoError);
  embedding.weights.pop_back();
  EXPECT_THROW(write_embedding(folder / "e.npz", embedding), InvalidInput);
  EXPECT_THROW(read_embedding(folder / "none.npz"), IoError);
}

/// Parsed within memory that the bytes can justify, or refused by name and byte.
bool parses_embedding(std::string_view bytes) {
  constexpr std::size_t kMemoryPerByte = 8, kMemoryAlways = 4096;
  largest_allocation = 0;
  bool parsed = false;
  try {
    const Embedding embedding = parse_embedding(std::as_bytes(std::span(bytes)), "sample");
    EXPECT_EQ(embedding.weights.size(), embedding.tets.size());
    EXPECT_EQ(embedding.distances.size(), embedding.tets.size());
    parsed = true;
  } catch (const IoError& error) {
    EXPECT_TRUE(std::string_view(error.what()).starts_with("sample: byte ")) << error.what();
  }
  EXPECT_LE(largest_allocation, kMemoryPerByte * bytes.size() + kMemoryAlways);
  return parsed;
}

TEST_F(EmbeddingFile, every_truncation_is_refused) {
  for (const char* name : {"e.npz", "e.embedding"}) {
    const std::string bytes = bytes_of(name, small_embedding(3));
    EXPECT_TRUE(parses_embedding(bytes));
    for (std::size_t length = 0; length < bytes.size() && !HasFailure(); ++length) {
      const std::vector<char> prefix(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length));
      EXPECT_FALSE(parses_embedding({prefix.data(), prefix.size()})) << length;
    }
  }
}

TEST_F(EmbeddingFile, a_hundred_thousand_flipped_bytes_are_survived) {
  std::mt19937 random(5);
  for (const char* name : {"e.npz", "e.embedding"}) {
    const std::string bytes = bytes_of(name, small_embedding(3));
    for (int flips = 0; flips < 50'000 && !HasFailure(); ++flips) {
      std::vector<char> damaged(bytes.begin(), bytes.end());
      for (unsigned i = 0; i <= random() % 3; ++i, ++flips)
        damaged[random() % damaged.size()] = static_cast<char>(random());
      parses_embedding({damaged.data(), damaged.size()});
    }
  }
}

/// Flips within an array's header, with the checksum set right again, so that what lies behind it is reached.
TEST_F(EmbeddingFile, lying_headers_of_arrays_are_survived) {
  const std::string bytes = bytes_of("e.npz", small_embedding(3));
  const std::size_t begin = bytes.find("\x93NUMPY"), size = 128 + 3 * sizeof(std::int32_t);
  const std::size_t entry = bytes.find("PK\x01\x02");
  const auto checksum_of = [](std::string_view text) {
    std::uint32_t sum = ~0U;
    for (const char c : text) {
      sum ^= static_cast<unsigned char>(c);
      for (int bit = 0; bit < 8; ++bit) sum = sum >> 1 ^ (0xEDB88320U & (~(sum & 1U) + 1U));
    }
    return ~sum;
  };
  constexpr std::string_view kSpecial = "0123456789<>|fiuO'(),:. LF";
  std::mt19937 random(6);
  int parsed = 0;
  for (int round = 0; round < 20'000 && !HasFailure(); ++round) {
    std::string damaged = bytes;
    for (unsigned i = 0; i <= random() % 3; ++i) damaged[begin + random() % 70] = kSpecial[random() % kSpecial.size()];
    damaged.replace(entry + 16, 4, raw(checksum_of(std::string_view(damaged).substr(begin, size))));
    parsed += parses_embedding(damaged) ? 1 : 0;
  }
  EXPECT_GT(parsed, 0);
  EXPECT_LT(parsed, 20'000);
}

}  // namespace
}  // namespace tetsoup
