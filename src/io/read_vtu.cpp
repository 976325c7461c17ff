// VTK XML unstructured grids: arrays as text, as base64 within the tags, or appended (raw or base64). Not compressed.
#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "base/base64.h"
#include "io/number_stream.h"
#include "io/tet_readers.h"
#include "io/tet_scanner.h"
#include "io/xml_tags.h"

namespace tetsoup {

namespace {

constexpr std::int64_t kTetCell = 10;

struct DataArray {
  XmlTag tag;
  std::size_t begin = 0, end = 0;  // Of what stands between the tags.
};

struct Piece {
  XmlTag tag;
  std::optional<DataArray> points, connectivity, offsets, types;
};

struct AppendedData {
  bool base64 = false;
  std::size_t begin = 0;  // Behind the underscore.
};

class VtuReader {
 public:
  VtuReader(std::string_view text, const std::string& name) : in_(text, name), name_(name) {}

  TetMesh read() {
    read_structure();
    for (const Piece& piece : pieces_) read_piece(piece);
    return std::move(mesh_).narrowed();
  }

 private:
  // --- Where everything is ---

  void read_structure() {
    bool in_file = false;
    std::string_view group;
    while (const auto tag = next_tag(in_)) {
      if (tag->name == "VTKFile") {
        read_file_tag(*tag);
        in_file = true;
      } else if (tag->name == "Piece") {
        pieces_.push_back({*tag, {}, {}, {}, {}});
      } else if (tag->name == "Points" || tag->name == "Cells") {
        group = tag->name;
      } else if (tag->name == "/Points" || tag->name == "/Cells") {
        group = {};
      } else if (tag->name == "DataArray" && !group.empty() && !pieces_.empty()) {
        note_array(*tag, group);
      } else if (tag->name == "AppendedData") {
        if (!in_.skip_past("_")) in_.fail("the appended data does not begin with an underscore");
        appended_ = {tag->attribute("encoding") == "base64", in_.position()};
        break;  // Raw bytes follow, which are no XML.
      }
    }
    if (!in_file) in_.fail("not a VTK XML file: there is no <VTKFile>");
  }

  void read_file_tag(const XmlTag& tag) {
    if (tag.attribute("type") != "UnstructuredGrid")
      in_.fail("the file holds no UnstructuredGrid but '" + std::string(tag.attribute("type").substr(0, 40)) + "'");
    order_ = tag.attribute("byte_order") == "BigEndian" ? ByteOrder::Big : ByteOrder::Little;
    header_ = tag.attribute("header_type") == "UInt64" ? NumberType::UInt64 : NumberType::UInt32;
    compressed_ = !tag.attribute("compressor").empty();
  }

  void note_array(const XmlTag& tag, std::string_view group) {
    DataArray array{tag, in_.position(), in_.position()};
    if (!tag.empty) {
      const std::size_t end = in_.text().find('<', in_.position());
      if (end == std::string_view::npos) in_.fail("a DataArray has no end");
      array.end = end;
    }
    Piece& piece = pieces_.back();
    const std::string_view name = tag.attribute("Name");
    if (group == "Points")
      piece.points = array;
    else if (name == "connectivity")
      piece.connectivity = array;
    else if (name == "offsets")
      piece.offsets = array;
    else if (name == "types")
      piece.types = array;
  }

  // --- One piece ---

  void read_piece(const Piece& piece) {
    if (!piece.points || !piece.connectivity || !piece.offsets || !piece.types)
      in_.fail("a Piece lacks one of Points, connectivity, offsets and types");
    const std::size_t base = mesh_.vertices.size();
    const std::size_t point_count = read_points(piece);
    const auto corners = read_corners(*piece.connectivity, point_count);
    const auto types = read_types(*piece.types);
    read_tets(*piece.offsets, corners, types, static_cast<std::uint32_t>(base));
  }

  std::size_t read_points(const Piece& piece) {
    const std::int64_t count = integer_attribute(piece.tag, "NumberOfPoints");
    with_numbers(*piece.points, [&](TetScanner& source, NumberStream& numbers) {
      const std::size_t points = source.checked_count(count, "number of points", 3 * numbers.least_bytes());
      mesh_.vertices.reserve(mesh_.vertices.size() + points);
      for (std::size_t i = 0; i < points; ++i) {
        Vec3d point;
        point.x = numbers.real("x coordinate");
        point.y = numbers.real("y coordinate");
        point.z = numbers.real("z coordinate");
        mesh_.vertices.push_back(point);
      }
    });
    return static_cast<std::size_t>(count);
  }

  std::vector<std::uint32_t> read_corners(const DataArray& array, std::size_t point_count) {
    std::vector<std::uint32_t> corners;
    with_numbers(array, [&](TetScanner&, NumberStream& numbers) {
      while (!numbers.at_end()) corners.push_back(numbers.index("corner of a cell", point_count));
    });
    return corners;
  }

  std::vector<std::uint8_t> read_types(const DataArray& array) {
    std::vector<std::uint8_t> types;
    with_numbers(array, [&](TetScanner&, NumberStream& numbers) {
      while (!numbers.at_end()) types.push_back(numbers.integer("cell type") == kTetCell ? 1 : 0);
    });
    return types;
  }

  void read_tets(const DataArray& offsets, const std::vector<std::uint32_t>& corners,
                 const std::vector<std::uint8_t>& is_tet, std::uint32_t base) {
    with_numbers(offsets, [&](TetScanner&, NumberStream& numbers) {
      std::size_t begin = 0;
      for (const std::uint8_t tet : is_tet) {
        const std::int64_t offset = numbers.integer("offset of a cell");
        const auto end = static_cast<std::size_t>(offset);
        if (offset < 0 || end < begin || end > corners.size()) numbers.fail("the offsets do not rise");
        if (tet != 0) {
          if (end - begin != 4) numbers.fail("a tet has " + std::to_string(end - begin) + " corners");
          const std::uint32_t* c = corners.data() + begin;
          mesh_.tets.push_back({base + c[0], base + c[1], base + c[2], base + c[3]});
        }
        begin = end;
      }
    });
  }

  // --- Arrays ---

  // Calls use(source, numbers) with the array's numbers, wherever they are.
  template <class Use>
  void with_numbers(const DataArray& array, const Use& use) {
    const std::string_view format = array.tag.attribute("format");
    in_.seek(array.begin);
    if (format == "ascii") {
      TetScanner source(in_.text().substr(0, array.end), name_);
      source.seek(array.begin);
      NumberStream numbers(source);
      return use(source, numbers);
    }
    in_.line();  // Failures from here on name the array's own line.
    if (compressed_) in_.fail("the file is compressed: save it uncompressed");
    const std::string line = std::to_string(in_.line_number());
    if (format == "binary")
      return use_bytes(array, decode(array.begin, array.end), 0, name_ + ": line " + line + ": base64 data", use);
    if (format != "appended") in_.fail("the format of a DataArray is neither ascii nor binary nor appended");
    const std::size_t begin = appended_begin(array);
    if (!appended_.base64) return use_bytes(array, in_.text(), begin, name_, use);
    use_bytes(array, decode_appended(begin), 0, name_ + ": line " + line + ": base64 data", use);
  }

  // The numbers behind the header that stands at `begin` and tells their bytes.
  template <class Use>
  void use_bytes(const DataArray& array, std::string_view bytes, std::size_t begin, const std::string& name,
                 const Use& use) {
    TetScanner source(bytes, name);
    source.seek(begin);
    const std::size_t length = read_length(source);
    TetScanner limited(bytes.substr(0, source.position() + length), name);
    limited.seek(source.position());
    NumberStream numbers(limited, type_of(array), order_);
    use(limited, numbers);
  }

  // Arrays that share bytes could make a small file fill the memory.
  std::size_t read_length(TetScanner& source) {
    NumberStream header(source, header_, order_);
    const std::size_t length = source.checked_count(header.integer("length of an array"), "length of an array", 1);
    if (length > source.left()) source.fail_byte("the file ends within an array");
    used_bytes_ += length;
    if (used_bytes_ > in_.text().size()) in_.fail("the arrays overlap");
    return length;
  }

  std::string decode(std::size_t begin, std::size_t end) const {
    auto bytes = decode_base64(in_.text().substr(begin, end - begin));
    if (!bytes) in_.fail("an array is no base64");
    return *std::move(bytes);
  }

  // All arrays follow each other without a mark between them, so the header has to tell where this one ends.
  std::string decode_appended(std::size_t begin) const {
    constexpr std::size_t kHeaderCharacters = 12;  // At least 8 bytes.
    const std::string head = decode(begin, begin + kHeaderCharacters);
    TetScanner source(head, name_);
    NumberStream header(source, header_, order_);
    const std::int64_t length = header.integer("length of an array");
    if (length < 0 || static_cast<std::uint64_t>(length) > in_.text().size())
      in_.fail("an array is longer than the file");
    const std::size_t bytes = size_of(header_) + static_cast<std::size_t>(length);
    return decode(begin, begin + (bytes + 2) / 3 * 4);
  }

  std::size_t appended_begin(const DataArray& array) const {
    const std::int64_t offset = integer_attribute(array.tag, "offset");
    if (appended_.begin == 0) in_.fail("there is no appended data");
    if (static_cast<std::uint64_t>(offset) > in_.text().size() - appended_.begin)
      in_.fail("an array begins behind the end of the file");
    return appended_.begin + static_cast<std::size_t>(offset);
  }

  // Never negative.
  std::int64_t integer_attribute(const XmlTag& tag, std::string_view key) const {
    const std::string_view text = tag.attribute(key);
    std::int64_t value = -1;
    const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
    if (result.ec != std::errc() || value < 0) in_.fail("a tag lacks a valid " + std::string(key));
    return value;
  }

  NumberType type_of(const DataArray& array) const {
    static const std::pair<std::string_view, NumberType> kTypes[] = {
        {"Int8", NumberType::Int8},       {"UInt8", NumberType::UInt8},    {"Int16", NumberType::Int16},
        {"UInt16", NumberType::UInt16},   {"Int32", NumberType::Int32},    {"UInt32", NumberType::UInt32},
        {"Int64", NumberType::Int64},     {"UInt64", NumberType::UInt64},  {"Float32", NumberType::Float32},
        {"Float64", NumberType::Float64}, {"vtkIdType", NumberType::Int64}};
    for (const auto& [name, type] : kTypes)
      if (array.tag.attribute("type") == name) return type;
    in_.fail("the type of a DataArray is not known");
  }

  TetScanner in_;
  const std::string& name_;
  WideTetMesh mesh_;
  ByteOrder order_ = ByteOrder::Little;
  NumberType header_ = NumberType::UInt32;
  bool compressed_ = false;
  std::vector<Piece> pieces_;
  AppendedData appended_;
  std::size_t used_bytes_ = 0;  // By the arrays read so far.
};

}  // namespace

TetMesh parse_vtu(std::string_view text, const std::string& name) {
  return VtuReader(text, name).read();
}

}  // namespace tetsoup
