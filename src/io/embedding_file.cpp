// Embeddings as NumPy arrays or in a layout that a graphics card takes as it is; docs/FORMATS.md describes both.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/require.h"
#include "io/atomic_file.h"
#include "io/file_names.h"
#include "io/npz.h"
#include "io/zip_reader.h"
#include "io/raw_numbers.h"
#include "io/soup_readers.h"
#include "tetsoup/error.h"
#include "tetsoup/io.h"

namespace tetsoup {

namespace {

constexpr std::string_view kMagic = "tetembed";
constexpr std::uint32_t kVersion = 1;
constexpr std::size_t kHeaderBytes = 24, kPointBytes = 24;

bool is_npz(const std::filesystem::path& path) {
  const std::string extension = lower_extension(path);
  if (extension == ".npz") return true;
  if (extension == ".embedding") return false;
  throw IoError("cannot tell the format of '" + path.string() +
                "' from its extension; embeddings are .npz or .embedding");
}

template <class Row>
void append_rows(std::string& bytes, const std::vector<Row>& rows) {
  bytes.append(reinterpret_cast<const char*>(rows.data()), rows.size() * sizeof(Row));
}

std::string compact_bytes(const Embedding& embedding) {
  std::string bytes(kMagic);
  bytes.reserve(kHeaderBytes + kPointBytes * embedding.tets.size());
  append_raw(bytes, kVersion);
  append_raw(bytes, std::uint32_t{0});
  append_raw(bytes, static_cast<std::uint64_t>(embedding.tets.size()));
  append_rows(bytes, embedding.tets);
  append_rows(bytes, embedding.weights);
  append_rows(bytes, embedding.distances);
  return bytes;
}

std::string npz_bytes(const Embedding& embedding) {
  const std::size_t count = embedding.tets.size();
  const std::vector<std::int32_t> tets(embedding.tets.begin(), embedding.tets.end());
  NpzWriter npz;
  npz.add("tets", {count}, std::span<const std::int32_t>(tets));
  const float* const weights = count > 0 ? embedding.weights.front().data() : nullptr;
  npz.add("weights", {count, 4}, std::span<const float>(weights, 4 * count));
  npz.add("distances", {count}, std::span<const float>(embedding.distances));
  return npz.take();
}

/// Rows from the front of `bytes`, which has enough, cut off it.
template <class Row>
void take_rows(std::string_view& bytes, std::size_t count, std::vector<Row>& rows) {
  rows.resize(count);
  if (count > 0) std::memcpy(rows.data(), bytes.data(), count * sizeof(Row));
  bytes.remove_prefix(count * sizeof(Row));
}

Embedding parse_compact(std::string_view bytes, const std::string& name) {
  if (!bytes.starts_with(kMagic)) fail_in_file(name, 0, "not an embedding: it does not begin with 'tetembed'");
  if (bytes.size() < kHeaderBytes) fail_in_file(name, bytes.size(), "the file ends within its header");
  const auto version = load_raw<std::uint32_t>(bytes.substr(8));
  if (version != kVersion) fail_in_file(name, 8, "version " + std::to_string(version) + " is not known");
  const auto count = load_raw<std::uint64_t>(bytes.substr(16));
  bytes.remove_prefix(kHeaderBytes);
  if (count != bytes.size() / kPointBytes || bytes.size() % kPointBytes != 0)
    fail_in_file(name, 16,
                 "the header promises " + std::to_string(count) + " points of 24 bytes, there are " +
                     std::to_string(bytes.size()) + " bytes");
  Embedding embedding;
  take_rows(bytes, static_cast<std::size_t>(count), embedding.tets);
  take_rows(bytes, static_cast<std::size_t>(count), embedding.weights);
  take_rows(bytes, static_cast<std::size_t>(count), embedding.distances);
  return embedding;
}

Embedding parse_npz_embedding(std::string_view bytes, const std::string& name) {
  const auto arrays = read_npz(bytes, name);
  Embedding embedding;
  embedding.tets = npz_indices(arrays, name, "tets", 0);
  const std::vector<double> weights = npz_reals(arrays, name, "weights", 4);
  for (const double distance : npz_reals(arrays, name, "distances", 0)) embedding.distances.push_back(narrow(distance));
  const std::size_t count = embedding.tets.size();
  if (weights.size() != 4 * count || embedding.distances.size() != count)
    fail_in_file(name, 0, "'tets', 'weights' and 'distances' are not of as many points");
  embedding.weights.resize(count);
  for (std::size_t i = 0; i < weights.size(); ++i) embedding.weights[i / 4][i % 4] = narrow(weights[i]);
  return embedding;
}

/// What the numbers themselves tell: points that were none are infinitely far, as embed_points() leaves them.
EmbedReport report_of(const Embedding& embedding) {
  EmbedReport report;
  for (const float distance : embedding.distances) {
    if (!std::isfinite(distance)) {
      ++report.non_finite;
      continue;
    }
    ++(distance > 0 ? report.outside : report.inside);
    report.max_distance = std::max(report.max_distance, static_cast<double>(distance));
  }
  return report;
}

}  // namespace

void write_embedding(const std::filesystem::path& path, const Embedding& embedding) {
  const std::size_t count = embedding.tets.size();
  require(embedding.weights.size() == count, "number of weights", embedding.weights.size(), "that of tets");
  require(embedding.distances.size() == count, "number of distances", embedding.distances.size(), "that of tets");
  const std::string bytes = is_npz(path) ? npz_bytes(embedding) : compact_bytes(embedding);
  AtomicFile file(path);
  file.write(bytes);
  file.commit();
}

Embedding parse_embedding(std::span<const std::byte> bytes, std::string_view name) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const std::string file(name);
  Embedding embedding = text.starts_with("PK") ? parse_npz_embedding(text, file) : parse_compact(text, file);
  embedding.report = report_of(embedding);
  return embedding;
}

Embedding read_embedding(const std::filesystem::path& path) {
  return parse_embedding(readers::read_whole_file(path), path.string());
}

}  // namespace tetsoup
