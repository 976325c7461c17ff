// NRRD [teem]: a header of lines, a blank line, and numbers.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <fstream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/file_names.h"
#include "io/inflate.h"
#include "io/load_bytes.h"
#include "io/soup_readers.h"
#include "io/text_scanner.h"
#include "tetsoup/label_volume.h"

namespace tetsoup {
namespace readers {
namespace {

constexpr std::size_t kMostVoxels = std::size_t{1} << 30;
constexpr std::size_t kMostAlong = std::size_t{1} << 20;

enum class Kind { Int8, UInt8, Int16, UInt16, Int32, UInt32, Int64, UInt64, Float, Double };

std::optional<Kind> kind_named(std::string_view name) {
  struct Names {
    Kind kind;
    std::vector<std::string_view> names;
  };
  static const std::vector<Names> known{
      {Kind::Int8, {"signed char", "int8", "int8_t"}},
      {Kind::UInt8, {"uchar", "unsigned char", "uint8", "uint8_t"}},
      {Kind::Int16, {"short", "short int", "signed short", "signed short int", "int16", "int16_t"}},
      {Kind::UInt16, {"ushort", "unsigned short", "unsigned short int", "uint16", "uint16_t"}},
      {Kind::Int32, {"int", "signed int", "int32", "int32_t"}},
      {Kind::UInt32, {"uint", "unsigned int", "uint32", "uint32_t"}},
      {Kind::Int64, {"longlong", "long long", "long long int", "signed long long", "int64", "int64_t"}},
      {Kind::UInt64, {"ulonglong", "unsigned long long", "unsigned long long int", "uint64", "uint64_t"}},
      {Kind::Float, {"float"}},
      {Kind::Double, {"double"}}};
  for (const Names& entry : known)
    if (std::find(entry.names.begin(), entry.names.end(), name) != entry.names.end()) return entry.kind;
  return {};
}

std::size_t size_of(Kind kind) {
  constexpr std::array<std::size_t, 10> kSizes{1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  return kSizes[static_cast<std::size_t>(kind)];
}

double number_at(const std::byte* at, Kind kind, std::endian order) {
  switch (kind) {
    case Kind::Int8:
      return load<std::int8_t>(at, order);
    case Kind::UInt8:
      return load<std::uint8_t>(at, order);
    case Kind::Int16:
      return load<std::int16_t>(at, order);
    case Kind::UInt16:
      return load<std::uint16_t>(at, order);
    case Kind::Int32:
      return load<std::int32_t>(at, order);
    case Kind::UInt32:
      return load<std::uint32_t>(at, order);
    case Kind::Int64:
      return static_cast<double>(load<std::int64_t>(at, order));
    case Kind::UInt64:
      return static_cast<double>(load<std::uint64_t>(at, order));
    case Kind::Float:
      return static_cast<double>(load<float>(at, order));
    case Kind::Double:
      return load<double>(at, order);
  }
  return 0;
}

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t");
  if (begin == text.npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t") - begin + 1);
}

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return result;
}

class NrrdReader {
 public:
  NrrdReader(const Source& source, std::optional<std::filesystem::path> folder)
      : source_(source), folder_(std::move(folder)), in_(source) {}

  LabelVolume read() {
    if (!in_.rest().starts_with("NRRD000")) fail(source_.name, "not NRRD: it does not begin with NRRD000");
    for (in_.skip_line(); !in_.at_end() && !in_.at_line_end(); in_.skip_line()) read_line(in_.rest_of_line());
    if (!in_.at_end()) in_.skip_line();
    finish_header();
    read_numbers();
    return std::move(volume_);
  }

 private:
  void read_line(std::string_view line) {
    if (line.starts_with('#')) return;
    if (const std::size_t at = line.find(":="); at != line.npos)
      return read_pair(line.substr(0, at), trimmed(line.substr(at + 2)));
    const std::size_t colon = line.find(':');
    if (colon == line.npos) in_.fail("expected a field such as `sizes: 64 64 32`, found '" + std::string(line) + "'");
    const std::string field = lower(trimmed(line.substr(0, colon)));
    const std::string_view value = trimmed(line.substr(colon + 1));
    if (field == "type") {
      kind_ = kind_named(lower(value));
      if (!kind_) in_.fail("type '" + std::string(value) + "' is none of numbers that are read");
    } else if (field == "dimension") {
      if (value != "3")
        in_.fail("dimension " + std::string(value) + ": labels in three dimensions are read, one layer");
    } else if (field == "sizes") {
      read_sizes(value);
    } else if (field == "encoding") {
      encoding_ = lower(value);
    } else if (field == "endian") {
      order_ = lower(value) == "big" ? std::endian::big : std::endian::little;
    } else if (field == "spacings") {
      const std::vector<double> along = numbers(value, 3);
      for (std::size_t i = 0; i < 3; ++i) set(volume_.steps[i], i, along[i]);
    } else if (field == "axis mins" || field == "axismins") {
      const std::vector<double> mins = numbers(value, 3);
      volume_.origin = {mins[0], mins[1], mins[2]};
    } else if (field == "space directions") {
      const std::vector<double> d = numbers(value, 9);
      for (std::size_t i = 0; i < 3; ++i) volume_.steps[i] = {d[3 * i], d[3 * i + 1], d[3 * i + 2]};
    } else if (field == "space origin") {
      const std::vector<double> o = numbers(value, 3);
      volume_.origin = {o[0], o[1], o[2]};
    } else if (field == "data file" || field == "datafile") {
      data_file_ = std::string(value);
    } else if (field == "byte skip" || field == "byteskip" || field == "line skip" || field == "lineskip") {
      if (value != "0") in_.fail(field + " is not read");
    }
  }

  static void set(Vec3d& step, std::size_t axis, double value) {
    step = {};
    (axis == 0 ? step.x : axis == 1 ? step.y : step.z) = value;
  }

  void read_sizes(std::string_view value) {
    std::size_t voxels = 1;
    const std::vector<double> sizes = numbers(value, 3);
    for (std::size_t i = 0; i < 3; ++i) {
      if (!(sizes[i] >= 1 && sizes[i] <= static_cast<double>(kMostAlong)) || sizes[i] != std::floor(sizes[i]))
        in_.fail("sizes must be whole numbers from 1");
      volume_.size[i] = static_cast<std::size_t>(sizes[i]);
      if (volume_.size[i] > kMostVoxels / voxels) in_.fail("more voxels than 2^30");
      voxels *= volume_.size[i];
    }
    voxels_ = voxels;
  }

  /// All numbers of a line, whatever brackets and commas stand between them.
  std::vector<double> numbers(std::string_view text, std::size_t count) const {
    std::vector<double> found;
    const char* at = text.data();
    const char* const end = at + text.size();
    while (at != end) {
      double value = 0;
      if (*at == ' ' || *at == '\t' || *at == '(' || *at == ')' || *at == ',') {
        ++at;
      } else if (parse_number(at, end, value) && std::isfinite(value)) {
        found.push_back(value);
      } else {
        in_.fail("expected numbers, found '" + std::string(text) + "'");
      }
    }
    if (found.size() != count)
      in_.fail("expected " + std::to_string(count) + " numbers, found '" + std::string(text) + "'");
    return found;
  }

  /// 3D Slicer's: Segment0_Name:=bone, Segment0_LabelValue:=1.
  void read_pair(std::string_view key, std::string_view value) {
    const std::size_t bar = key.find('_');
    if (!key.starts_with("Segment") || bar == key.npos) return;
    const std::string segment(key.substr(0, bar));
    auto place = std::find_if(segments_.begin(), segments_.end(), [&](const Segment& s) { return s.key == segment; });
    if (place == segments_.end()) place = segments_.insert(segments_.end(), {segment, {}, {}});
    if (key.substr(bar + 1) == "Name") place->name = std::string(value);
    if (key.substr(bar + 1) == "LabelValue") {
      std::int64_t number = 0;
      const char* at = value.data();
      if (parse_integer(at, at + value.size(), number) && number > 0 && number <= 0xFFFFFFFFLL)
        place->label = static_cast<std::uint32_t>(number);
    }
  }

  void finish_header() {
    if (!kind_ || voxels_ == 0) fail(source_.name, "its header lacks the type or the sizes");
    for (const Segment& s : segments_)
      if (s.label && !s.name.empty()) volume_.names.emplace_back(*s.label, s.name);
  }

  void read_numbers() {
    std::vector<std::byte> beside;
    std::span<const std::byte> bytes = source_.bytes.subspan(in_.offset());
    if (data_file_) {
      if (!folder_) fail(source_.name, "its numbers are in another file, which is not read here");
      if (data_file_->find_first_of("/\\ %") != std::string::npos)
        fail(source_.name, "data file '" + *data_file_ + "': one file beside the header is read");
      beside = read_whole_file(*folder_ / *data_file_);
      bytes = beside;
    }
    if (encoding_ == "ascii" || encoding_ == "text" || encoding_ == "txt") return read_text(bytes);
    std::string unpacked;
    if (encoding_ == "gzip" || encoding_ == "gz") {
      unpacked = gunzip(bytes);
      bytes = std::as_bytes(std::span(unpacked));
    } else if (encoding_ != "raw") {
      fail(source_.name, "encoding '" + encoding_ + "' is not read; raw, gzip and text are");
    }
    const std::size_t each = size_of(*kind_);
    if (bytes.size() / each < voxels_)
      fail(source_.name, "it is cut short: " + std::to_string(voxels_) + " numbers are missing some");
    for (std::size_t i = 0; i < voxels_; ++i) add(number_at(bytes.data() + each * i, *kind_, order_));
  }

  void read_text(std::span<const std::byte> bytes) {
    TextScanner text({bytes, source_.name});
    for (std::size_t i = 0; i < voxels_; ++i) {
      text.skip_space();
      if (text.at_end()) fail(source_.name, "it is cut short");
      add(text.number());
    }
  }

  std::string gunzip(std::span<const std::byte> bytes) const {
    const std::string_view packed(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    constexpr std::size_t kHeader = 10, kTrailer = 8;
    const auto damaged = [&] { fail(source_.name, "its packed numbers are damaged"); };
    if (packed.size() < kHeader + kTrailer || !packed.starts_with("\x1f\x8b\x08")) damaged();
    const auto flags = static_cast<unsigned char>(packed[3]);
    std::size_t at = kHeader;
    if ((flags & 4U) != 0) {
      at += 2 + static_cast<unsigned char>(packed[at]) + 256U * static_cast<unsigned char>(packed[at + 1]);
    }
    for (const unsigned flag : {8U, 16U}) {
      if ((flags & flag) == 0) continue;
      at = at < packed.size() ? packed.find('\0', at) : packed.npos;
      if (at == packed.npos) damaged();
      ++at;
    }
    if ((flags & 2U) != 0) at += 2;
    if (at >= packed.size()) damaged();
    auto out = inflate(packed.substr(at), voxels_ * size_of(*kind_) + 1);
    if (!out) damaged();
    return std::move(*out);
  }

  void add(double value) {
    if (value != std::floor(value) || value > 4294967295.0)
      fail(source_.name, "it holds " + std::to_string(value) +
                             ", which is no label but a grey value: segment it first, for instance by a threshold in "
                             "3D Slicer's Segment Editor");
    volume_.labels.push_back(value > 0 ? static_cast<std::uint32_t>(value) : 0);
  }

  struct Segment {
    std::string key, name;
    std::optional<std::uint32_t> label;
  };

  Source source_;
  std::optional<std::filesystem::path> folder_;
  TextScanner in_;
  LabelVolume volume_;
  std::optional<Kind> kind_;
  std::size_t voxels_ = 0;
  std::string encoding_ = "raw";
  std::endian order_ = std::endian::little;
  std::optional<std::string> data_file_;
  std::vector<Segment> segments_;
};

}  // namespace
}  // namespace readers

LabelVolume parse_label_volume(std::span<const std::byte> bytes, std::string_view name) {
  return readers::NrrdReader({bytes, name}, {}).read();
}

LabelVolume read_label_volume(const std::filesystem::path& path) {
  const std::vector<std::byte> bytes = readers::read_whole_file(path);
  const std::string name = path.string();
  return readers::NrrdReader({bytes, name}, path.parent_path()).read();
}

bool is_label_volume(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string first(7, ' ');
  return file.read(first.data(), static_cast<std::streamsize>(first.size())) && first == "NRRD000";
}

}  // namespace tetsoup
