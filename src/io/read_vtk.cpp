// Legacy VTK unstructured grids up to version 5.1, ASCII and (big endian) binary.
#include <algorithm>
#include <cctype>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/number_stream.h"
#include "io/tet_readers.h"
#include "io/tet_scanner.h"

namespace tetsoup {

namespace {

constexpr std::int64_t kTetCell = 10;

class VtkReader {
 public:
  VtkReader(std::string_view text, const std::string& name) : in_(text, name) {}

  TetMesh read() {
    read_header();
    while (!in_.at_end() && !types_read_) {
      const std::string keyword(in_.word());
      if (keyword == "FIELD")
        read_field();
      else if (keyword == "METADATA")
        skip_metadata();
      else if (keyword == "POINTS")
        read_points();
      else if (keyword == "CELLS")
        read_cells();
      else if (keyword == "CELL_TYPES")
        read_types();
      else
        in_.fail("expected POINTS, CELLS or CELL_TYPES, found something else");
    }
    if (!types_read_) in_.fail("the file ends before CELL_TYPES");
    return std::move(mesh_).narrowed();
  }

 private:
  void read_header() {
    if (!in_.line().starts_with("# vtk DataFile"))
      in_.fail("not a legacy VTK file: it does not begin '# vtk DataFile'");
    in_.line();
    const std::string encoding(in_.word());
    if (encoding != "ASCII" && encoding != "BINARY") in_.fail("expected ASCII or BINARY");
    binary_ = encoding == "BINARY";
    if (in_.word() != "DATASET") in_.fail("expected DATASET");
    if (in_.word() != "UNSTRUCTURED_GRID") in_.fail("the data set is no UNSTRUCTURED_GRID, so it holds no tets");
  }

  // Numbers of a type begin on the line after its name.
  NumberStream numbers(std::optional<NumberType> type) {
    if (!binary_) return NumberStream(in_);
    if (!type) in_.fail("the type of these numbers is not known");
    in_.line();
    return NumberStream(in_, *type, ByteOrder::Big);
  }

  static std::optional<NumberType> type_named(std::string name) {
    std::transform(name.begin(), name.end(), name.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    static const std::pair<const char*, NumberType> kTypes[] = {
        {"char", NumberType::Int8},          {"unsigned_char", NumberType::UInt8},
        {"short", NumberType::Int16},        {"unsigned_short", NumberType::UInt16},
        {"int", NumberType::Int32},          {"unsigned_int", NumberType::UInt32},
        {"long", NumberType::Int64},         {"unsigned_long", NumberType::UInt64},
        {"float", NumberType::Float32},      {"double", NumberType::Float64},
        {"vtktypeint64", NumberType::Int64}, {"vtktypeuint64", NumberType::UInt64},
        {"vtktypeint32", NumberType::Int32}, {"vtkidtype", NumberType::Int32}};
    for (const auto& [known, type] : kTypes)
      if (name == known) return type;
    return std::nullopt;
  }
  std::optional<NumberType> read_type() { return type_named(std::string(in_.word())); }

  // "FIELD name arrays" and per array "name components tuples type" and the numbers: passed over.
  void read_field() {
    in_.word();
    const std::size_t arrays = in_.count("number of arrays", 8);
    for (std::size_t array = 0; array < arrays; ++array) {
      if (in_.word() == "METADATA") {
        skip_metadata();
        in_.word();
      }
      const std::size_t components = in_.count("number of components", 1);
      const std::size_t tuples = in_.count("number of tuples", 1);
      const std::string type_name(in_.word());
      const auto type = type_named(type_name);
      const std::size_t width = binary_ && type ? size_of(*type) : 1;
      if (components != 0 && tuples > in_.left() / width / components) in_.fail("a field claims too many numbers");
      const std::size_t values = components * tuples;
      if (binary_) in_.line();
      if (!binary_)
        for (std::size_t i = 0; i < values; ++i) in_.word();
      else if (type)
        in_.bytes(values * width, "a field");
      else if (type_name == "string")
        for (std::size_t i = 0; i < values; ++i) skip_binary_string();
      else
        in_.fail("the type of this field is not known");
    }
  }

  // The first two bits tell how many bytes hold the length: 8, 4, 2 or 1.
  void skip_binary_string() {
    const auto first = in_.raw<std::uint8_t>("a string's length");
    std::uint64_t length = first & 0x3FU;
    for (unsigned more = (8U >> (first >> 6U)) - 1; more > 0; --more)
      length = length << 8U | in_.raw<std::uint8_t>("a string's length");
    if (length > in_.left()) in_.fail_byte("the file ends within a string");
    in_.bytes(length, "a string");
  }

  // Ends at an empty line.
  void skip_metadata() {
    in_.line();
    while (in_.left() > 0 && !in_.line().empty()) {
    }
  }

  void read_points() {
    const std::int64_t claimed = in_.integer("number of points");
    if (!mesh_.vertices.empty()) in_.fail("there is a second POINTS");
    NumberStream stream = numbers(read_type());
    const std::size_t count = in_.checked_count(claimed, "number of points", 3 * stream.least_bytes());
    mesh_.vertices.resize(count);
    for (Vec3d& vertex : mesh_.vertices) {
      vertex.x = stream.real("x coordinate");
      vertex.y = stream.real("y coordinate");
      vertex.z = stream.real("z coordinate");
    }
  }

  void read_cells() {
    const std::int64_t first = in_.integer("number of cells");
    const std::int64_t second = in_.integer("size of the cell list");
    if (!corners_.empty() || !ends_.empty()) in_.fail("there is a second CELLS");
    if (in_.peek_word() == "OFFSETS")
      read_offset_cells(first, second);
    else
      read_counted_cells(first, second);
  }

  // Up to version 4: each cell is its number of corners, then the corners.
  void read_counted_cells(std::int64_t cells, std::int64_t size) {
    NumberStream stream = numbers(NumberType::Int32);
    const std::size_t count = in_.checked_count(cells, "number of cells", stream.least_bytes());
    const std::size_t list_size = in_.checked_count(size, "size of the cell list", stream.least_bytes());
    if (list_size < count) in_.fail("the size of the cell list is below the number of cells");
    const std::size_t corner_count = list_size - count;
    ends_.reserve(count);
    corners_.reserve(corner_count);
    for (std::size_t cell = 0; cell < count; ++cell) {
      const std::int64_t corners = stream.integer("number of a cell's corners");
      if (corners < 0 || static_cast<std::uint64_t>(corners) > corner_count - corners_.size())
        stream.fail("a cell has " + std::to_string(corners) + " corners, more than the cell list holds");
      for (std::int64_t i = 0; i < corners; ++i)
        corners_.push_back(stream.index("corner of a cell", mesh_.vertices.size()));
      ends_.push_back(corners_.size());
    }
  }

  // From version 5 on: where each cell begins and where the last ends, then the corners of all.
  void read_offset_cells(std::int64_t offsets, std::int64_t corners) {
    in_.word();
    NumberStream begin_stream = numbers(read_type());
    const std::size_t offset_count = in_.checked_count(offsets, "number of offsets", begin_stream.least_bytes());
    std::int64_t last = 0;
    for (std::size_t i = 0; i < offset_count; ++i) {
      const std::int64_t offset = begin_stream.integer("offset of a cell");
      if (offset < last || offset > corners || (i == 0 && offset != 0)) begin_stream.fail("the offsets do not rise");
      last = offset;
      if (i > 0) ends_.push_back(static_cast<std::size_t>(offset));
    }
    if (in_.word() != "CONNECTIVITY") in_.fail("expected CONNECTIVITY");
    NumberStream corner_stream = numbers(read_type());
    const std::size_t corner_count =
        in_.checked_count(corners, "length of the connectivity", corner_stream.least_bytes());
    corners_.reserve(corner_count);
    for (std::size_t i = 0; i < corner_count; ++i)
      corners_.push_back(corner_stream.index("corner of a cell", mesh_.vertices.size()));
  }

  void read_types() {
    const std::int64_t count = in_.integer("number of cell types");
    NumberStream stream = numbers(NumberType::Int32);
    if (count != std::ssize(ends_)) in_.fail("there are as many cell types as cells, but here not");
    std::size_t begin = 0;
    for (const std::size_t end : ends_) {
      if (stream.integer("cell type") == kTetCell) {
        if (end - begin != 4) stream.fail("a tet has " + std::to_string(end - begin) + " corners");
        mesh_.tets.push_back({corners_[begin], corners_[begin + 1], corners_[begin + 2], corners_[begin + 3]});
      }
      begin = end;
    }
    types_read_ = true;
  }

  TetScanner in_;
  WideTetMesh mesh_;
  bool binary_ = false;
  bool types_read_ = false;
  std::vector<std::uint32_t> corners_;  // Of all cells.
  std::vector<std::size_t> ends_;       // One past the cell's last corner.
};

}  // namespace

TetMesh parse_vtk(std::string_view text, const std::string& name) {
  return VtkReader(text, name).read();
}

}  // namespace tetsoup
