#include "io/animation/vtu_series.h"

#include <charconv>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include "io/number_text.h"
#include "io/raw_numbers.h"
#include "io/soup_readers.h"
#include "io/xml_tags.h"

namespace tetsoup::animation {
namespace {

constexpr char kTetCell = 10;

/// Arrays behind each other, each behind the number of its bytes, as VTK appends them.
class AppendedArrays {
 public:
  explicit AppendedArrays(std::size_t begin) : begin_(begin) {}

  /// The tag of an array whose bytes follow, of that number.
  void declare(std::string& text, std::string_view attributes, std::size_t byte_count) {
    text += "        <DataArray ";
    text += attributes;
    text += " format=\"appended\" offset=\"";
    append_number(text, begin_);
    text += "\"/>\n";
    begin_ += sizeof(std::uint64_t) + byte_count;
  }

 private:
  std::size_t begin_;
};

void begin_block(std::string& bytes, std::size_t byte_count) {
  append_raw(bytes, static_cast<std::uint64_t>(byte_count));
}

void append_vectors(std::string& bytes, const std::vector<std::span<const Vec3>>& parts, std::size_t count) {
  begin_block(bytes, count * sizeof(Vec3));
  for (const std::span<const Vec3> part : parts)
    bytes.append(reinterpret_cast<const char*>(part.data()), part.size_bytes());
}

/// Connectivity, offsets, types, body and tet ids.
std::string cell_blocks(const AnimationScene& scene, std::size_t tet_count) {
  const auto for_each_tet = [&](const auto& use) {
    std::uint32_t body = 0, base = 0;
    for (const AnimationBody& b : scene.bodies) {
      for (std::size_t t = 0; t < b.mesh->tets.size(); ++t) use(b.mesh->tets[t], base, body, t);
      base += static_cast<std::uint32_t>(b.mesh->vertices.size());
      ++body;
    }
  };
  std::string bytes;
  bytes.reserve(tet_count * 29 + 40);
  begin_block(bytes, tet_count * 16);
  for_each_tet([&](const Tet& tet, std::uint32_t base, std::uint32_t, std::size_t) {
    for (const std::uint32_t v : tet) append_raw(bytes, base + v);
  });
  begin_block(bytes, tet_count * 4);
  for (std::size_t i = 1; i <= tet_count; ++i) append_raw(bytes, static_cast<std::uint32_t>(4 * i));
  begin_block(bytes, tet_count);
  bytes.append(tet_count, kTetCell);
  begin_block(bytes, tet_count * 4);
  for_each_tet([&](const Tet&, std::uint32_t, std::uint32_t body, std::size_t) { append_raw(bytes, body); });
  begin_block(bytes, tet_count * 4);
  for_each_tet([&](const Tet&, std::uint32_t, std::uint32_t, std::size_t tet) {
    append_raw(bytes, static_cast<std::uint32_t>(tet));
  });
  return bytes;
}

void declare_cells(std::string& text, AppendedArrays& arrays, std::size_t tet_count) {
  text += "      <Cells>\n";
  arrays.declare(text, "type=\"Int32\" Name=\"connectivity\"", tet_count * 16);
  arrays.declare(text, "type=\"Int32\" Name=\"offsets\"", tet_count * 4);
  arrays.declare(text, "type=\"UInt8\" Name=\"types\"", tet_count);
  text += "      </Cells>\n      <CellData Scalars=\"body\">\n";
  arrays.declare(text, "type=\"Int32\" Name=\"body\"", tet_count * 4);
  arrays.declare(text, "type=\"Int32\" Name=\"tet\"", tet_count * 4);
  text += "      </CellData>\n";
}

/// Time, and the hash in two halves, since the programs that read it count in 32 or 53 bits.
void append_field_data(std::string& text, const AnimationFrame& frame) {
  text +=
      "    <FieldData>\n      <DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">";
  append_number(text, frame.time);
  text += "</DataArray>\n      <DataArray type=\"UInt32\" Name=\"state_hash\" NumberOfTuples=\"2\" format=\"ascii\">";
  append_number(text, frame.state_hash >> 32);
  text += ' ';
  append_number(text, frame.state_hash & 0xFFFFFFFFU);
  text += "</DataArray>\n    </FieldData>\n";
}

/// The number in "stem_0012.vtu"; none for another's file.
std::optional<std::size_t> number_of(std::string_view file, const std::string& stem) {
  if (!file.starts_with(stem + '_') || !file.ends_with(".vtu")) return std::nullopt;
  const std::string_view digits = file.substr(stem.size() + 1, file.size() - stem.size() - 5);
  std::size_t number = 0;
  const auto result = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (result.ec != std::errc() || result.ptr != digits.data() + digits.size()) return std::nullopt;
  return number;
}

}  // namespace

VtuSeries::VtuSeries(const Cast& cast, std::filesystem::path path, std::string stem, std::size_t first_frame)
    : path_(std::move(path)), stem_(std::move(stem)) {
  for (const AnimationBody& body : cast.scene.bodies) {
    point_count_ += body.mesh->vertices.size();
    tet_count_ += body.mesh->tets.size();
  }
  cells_ = cell_blocks(cast.scene, tet_count_);
  if (first_frame > 0) read_entries(first_frame);
}

void VtuSeries::read_entries(std::size_t first_frame) {
  const std::vector<std::byte> bytes = readers::read_whole_file(path_);
  const std::string name = path_.string();
  TetScanner in({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, name);
  while (const auto tag = next_tag(in)) {
    if (tag->name != "DataSet") continue;
    const std::string_view file = tag->attribute("file");
    const auto number = number_of(file, escaped_xml(stem_));
    if (number && *number < first_frame)
      entries_.push_back({std::string(file), std::string(tag->attribute("timestep"))});
  }
}

void VtuSeries::add(FrameView& view, std::size_t number, FileLog& log) {
  const AnimationFrame& frame = view.frame();
  const bool has_velocities = !frame.velocities.empty();
  std::string text =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n"
      "  <UnstructuredGrid>\n";
  append_field_data(text, frame);
  text += "    <Piece NumberOfPoints=\"";
  append_number(text, point_count_);
  text += "\" NumberOfCells=\"";
  append_number(text, tet_count_);
  text += "\">\n";
  AppendedArrays arrays(0);
  declare_cells(text, arrays, tet_count_);
  text += "      <Points>\n";
  arrays.declare(text, "type=\"Float32\" Name=\"Points\" NumberOfComponents=\"3\"", point_count_ * sizeof(Vec3));
  text += "      </Points>\n";
  if (has_velocities) {
    text += "      <PointData Vectors=\"velocity\">\n";
    arrays.declare(text, "type=\"Float32\" Name=\"velocity\" NumberOfComponents=\"3\"", point_count_ * sizeof(Vec3));
    text += "      </PointData>\n";
  }
  text += "    </Piece>\n  </UnstructuredGrid>\n  <AppendedData encoding=\"raw\">\n_";
  text.reserve(text.size() + cells_.size() + 2 * point_count_ * sizeof(Vec3) + 100);
  text += cells_;
  append_vectors(text, frame.positions, point_count_);
  if (has_velocities) append_vectors(text, frame.velocities, point_count_);
  text += "\n  </AppendedData>\n</VTKFile>\n";

  const std::filesystem::path file = numbered(path_, stem_, number, ".vtu");
  log.write(file, text);
  Entry entry{escaped_xml(file.filename().string()), {}};
  append_number(entry.time, frame.time);
  entries_.push_back(std::move(entry));
  write_list(log);
}

void VtuSeries::write_list(FileLog& log) const {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
      "  <Collection>\n";
  for (const Entry& entry : entries_)
    text += "    <DataSet timestep=\"" + entry.time + "\" group=\"\" part=\"0\" file=\"" + entry.file + "\"/>\n";
  text += "  </Collection>\n</VTKFile>\n";
  log.write(path_, text);
}

}  // namespace tetsoup::animation
