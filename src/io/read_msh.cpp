// Gmsh MSH 2.2 and 4.1, ASCII and binary. Elements name nodes by tags that may leave gaps.
#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/tet_readers.h"
#include "io/tet_scanner.h"

namespace tetsoup {

namespace {

constexpr std::int64_t kTetType = 4;

// Nodes of an element by Gmsh's type number, from 1.
constexpr std::array<int, 31> kNodesOfType{2,  3,  4,  4, 8,  6,  5,  3,  6,  9, 10, 27, 18, 14, 1, 8,
                                           20, 15, 13, 9, 10, 12, 15, 15, 21, 4, 5,  6,  20, 35, 56};

struct ElementKind {
  std::int64_t type;
  std::size_t nodes;
};

class MshReader {
 public:
  MshReader(std::string_view text, const std::string& name) : in_(text, name) {}

  TetMesh read() {
    while (!in_.at_end()) {
      const std::string section(in_.word());
      in_.line();
      if (section == "$MeshFormat")
        read_format();
      else if (section == "$Nodes")
        major() == 2 ? read_nodes_2() : read_nodes_4();
      else if (section == "$Elements")
        major() == 2 ? read_elements_2() : read_elements_4();
      else if (!section.starts_with('$'))
        in_.fail("expected a section such as $Nodes, found something else");
      if (!in_.skip_past("$End" + section.substr(1))) in_.fail("section " + section + " has no end");
    }
    if (!major_) in_.fail("there is no $MeshFormat section: not a Gmsh mesh");
    return std::move(mesh_).narrowed();
  }

 private:
  int major() const {
    if (!major_) in_.fail("a section stands before $MeshFormat");
    return *major_;
  }

  void read_format() {
    const std::string version(in_.word());
    if (version == "4.1")
      major_ = 4;
    else if (version == "2" || version.starts_with("2."))
      major_ = 2;
    else
      in_.fail("MSH version '" + version.substr(0, 8) + "' is not read, only 2.2 and 4.1");
    binary_ = in_.integer("file type") == 1;
    if (in_.integer("data size") != 8 && binary_) in_.fail("binary data sizes other than 8 are not read");
    in_.line();
    if (binary_ && in_.raw<std::int32_t>("byte order mark") != 1) in_.fail_byte("big endian files are not read");
  }

  // --- Numbers in either encoding ---

  std::int64_t read_int(const char* what) { return binary_ ? in_.raw<std::int32_t>(what) : in_.integer(what); }
  std::int64_t read_size(const char* what) { return binary_ ? in_.raw<std::int64_t>(what) : in_.integer(what); }
  double read_real(const char* what) { return binary_ ? in_.raw<double>(what) : in_.real(what); }
  Vec3d read_point() {
    Vec3d point;
    point.x = read_real("x coordinate");
    point.y = read_real("y coordinate");
    point.z = read_real("z coordinate");
    return point;
  }
  std::size_t count_of(std::int64_t claimed, const char* what, std::size_t text_bytes, std::size_t binary_bytes) {
    return in_.checked_count(claimed, what, binary_ ? binary_bytes : text_bytes);
  }
  [[noreturn]] void fail(const std::string& reason) const { binary_ ? in_.fail_byte(reason) : in_.fail(reason); }

  // --- Nodes ---

  void read_nodes_2() {
    const std::size_t count = count_of(in_.integer("number of nodes"), "number of nodes", 8, 28);
    if (binary_) in_.line();
    reserve_nodes(count);
    for (std::size_t i = 0; i < count; ++i) {
      add_tag(read_int("node number"));
      mesh_.vertices.push_back(read_point());
    }
    sort_tags();
  }

  void read_nodes_4() {
    const std::int64_t blocks = read_size("number of node blocks");
    const std::size_t count = count_of(read_size("number of nodes"), "number of nodes", 8, 32);
    read_size("least node tag");
    read_size("largest node tag");
    reserve_nodes(count);
    for (std::int64_t block = 0; block < blocks; ++block) read_node_block();
    sort_tags();
  }

  void read_node_block() {
    const std::int64_t dimension = read_int("dimension of the block's entity");
    read_int("tag of the block's entity");
    const bool parametric = read_int("parametric flag") != 0;
    const std::size_t count = count_of(read_size("number of nodes in the block"), "number of nodes", 8, 32);
    for (std::size_t i = 0; i < count; ++i) add_tag(read_size("node tag"));
    for (std::size_t i = 0; i < count; ++i) {
      mesh_.vertices.push_back(read_point());
      for (std::int64_t u = 0; parametric && u < std::min<std::int64_t>(dimension, 3); ++u) read_real("parameter");
    }
  }

  void reserve_nodes(std::size_t count) {
    mesh_.vertices.reserve(mesh_.vertices.size() + count);
    tags_.reserve(tags_.size() + count);
  }

  void add_tag(std::int64_t tag) {
    const auto vertex = static_cast<std::uint32_t>(tags_.size());
    sequential_ = sequential_ && tag == std::int64_t{vertex} + 1;
    tags_.emplace_back(tag, vertex);
  }

  void sort_tags() {
    if (!sequential_) std::sort(tags_.begin(), tags_.end());
  }

  std::uint32_t read_vertex(bool as_int) {
    const std::int64_t tag = as_int ? read_int("node number") : read_size("node tag");
    if (sequential_) {
      if (tag >= 1 && static_cast<std::uint64_t>(tag) <= tags_.size()) return static_cast<std::uint32_t>(tag - 1);
    } else {
      const auto found = std::lower_bound(tags_.begin(), tags_.end(), std::pair(tag, std::uint32_t{0}));
      if (found != tags_.end() && found->first == tag) return found->second;
    }
    fail("an element names node " + std::to_string(tag) + ", which does not exist");
  }

  // --- Elements ---

  ElementKind element_kind(std::int64_t type) const {
    if (type < 1 || type > std::ssize(kNodesOfType)) fail("element type " + std::to_string(type) + " is not known");
    return {type, static_cast<std::size_t>(kNodesOfType[static_cast<std::size_t>(type - 1)])};
  }

  void read_tet(bool as_int) {
    Tet tet;
    for (std::uint32_t& vertex : tet) vertex = read_vertex(as_int);
    mesh_.tets.push_back(tet);
  }

  void read_elements_2() {
    const std::int64_t count = in_.integer("number of elements");
    if (binary_) {
      in_.line();
      return read_element_runs_2(count);
    }
    for (std::int64_t i = 0; i < count; ++i) {
      in_.integer("element number");
      const std::int64_t type = in_.integer("element type");
      const std::size_t tags = in_.count("number of element tags", 2);
      if (type == kTetType) {
        for (std::size_t tag = 0; tag < tags; ++tag) in_.integer("element tag");
        read_tet(true);
      }
      in_.line();
    }
  }

  void read_element_runs_2(std::int64_t count) {
    while (count > 0) {
      const ElementKind kind = element_kind(read_int("element type"));
      const std::int64_t run = read_int("number of elements in a row");
      const std::int64_t tags = read_int("number of element tags");
      const std::size_t tag_bytes = 4 * count_of(tags, "number of element tags", 4, 4);
      const std::size_t bytes = 4 + tag_bytes + 4 * kind.nodes;
      const std::size_t elements = in_.checked_count(run, "number of elements in a row", bytes);
      if (elements == 0) fail("a row of elements is empty");
      for (std::size_t i = 0; i < elements; ++i) {
        in_.bytes(4 + tag_bytes, "an element");
        kind.type == kTetType ? read_tet(true) : void(in_.bytes(4 * kind.nodes, "an element"));
      }
      count -= run;
    }
  }

  void read_elements_4() {
    const std::int64_t blocks = read_size("number of element blocks");
    read_size("number of elements");
    read_size("least element tag");
    read_size("largest element tag");
    for (std::int64_t block = 0; block < blocks; ++block) read_element_block();
  }

  void read_element_block() {
    read_int("dimension of the block's entity");
    read_int("tag of the block's entity");
    const ElementKind kind = element_kind(read_int("element type"));
    const std::size_t numbers = 1 + kind.nodes;
    const std::size_t count =
        count_of(read_size("number of elements in the block"), "number of elements", 2 * numbers, 8 * numbers);
    for (std::size_t i = 0; i < count; ++i) {
      read_size("element tag");
      if (kind.type == kTetType)
        read_tet(false);
      else
        for (std::size_t node = 0; node < kind.nodes; ++node) read_size("node tag");
    }
  }

  TetScanner in_;
  WideTetMesh mesh_;
  std::optional<int> major_;
  bool binary_ = false;
  bool sequential_ = true;                                    // Tags are 1, 2, 3, ...
  std::vector<std::pair<std::int64_t, std::uint32_t>> tags_;  // Tag, vertex.
};

}  // namespace

TetMesh parse_msh(std::string_view text, const std::string& name) {
  return MshReader(text, name).read();
}

}  // namespace tetsoup
