#include "io/collada_document.h"

#include <algorithm>
#include <array>
#include <numbers>

#include "base/elementary.h"
#include "io/number_text.h"
#include "io/parse_number.h"
#include "io/xml_tags.h"

namespace tetsoup::readers::collada {
namespace {

std::string without_mark(std::string_view reference) {
  if (reference.starts_with('#')) reference.remove_prefix(1);
  return std::string(reference);
}

struct Array {
  std::vector<double> numbers;
  std::size_t stride = 3, offset = 0;
};

/// A right-handed turn about an axis of any length.
Affine turn(double x, double y, double z, double degrees) {
  const double size = length(Vec3d{x, y, z});
  if (!(size > 0)) return {};
  const Vec3d a = Vec3d{x, y, z} * (1 / size);
  const double angle = degrees * std::numbers::pi / 180, c = elementary::cos(angle), s = elementary::sin(angle);
  return {{{{c + a.x * a.x * (1 - c), a.x * a.y * (1 - c) - a.z * s, a.x * a.z * (1 - c) + a.y * s, 0},
            {a.y * a.x * (1 - c) + a.z * s, c + a.y * a.y * (1 - c), a.y * a.z * (1 - c) - a.x * s, 0},
            {a.z * a.x * (1 - c) - a.y * s, a.z * a.y * (1 - c) + a.x * s, c + a.z * a.z * (1 - c), 0}}}};
}

Affine of_rows(const std::vector<double>& numbers) {
  Affine result;
  for (std::size_t i = 0; i < 12; ++i) result.rows[i / 4][i % 4] = numbers[i];
  return result;
}

/// Reads tag by tag; what it stands in is what was opened last.
class Reader {
 public:
  explicit Reader(const Source& source)
      : name_(source.name), in_({reinterpret_cast<const char*>(source.bytes.data()), source.bytes.size()}, name_) {}

  Document read() {
    while (const auto tag = next_tag(in_)) {
      if (!read_asset(*tag) && !read_geometry(*tag) && !read_primitives(*tag) && !read_node(*tag)) read_rest(*tag);
    }
    return std::move(document_);
  }

 private:
  bool read_asset(const XmlTag& tag) {
    if (tag.name == "unit" && !in_library_) {
      const std::string_view metres = tag.attribute("meter");
      if (!metres.empty() && (!parse_real(metres, document_.metres) || !(document_.metres > 0)))
        fail("the unit is " + in_quotes(metres.substr(0, 32)) + " metres");
    } else if (tag.name == "up_axis" && !in_library_) {
      const std::string_view axis = text_before_tag(in_);
      if (axis.find("X_UP") != axis.npos) document_.upright.rows = {{{0, -1, 0, 0}, {0, 0, -1, 0}, {1, 0, 0, 0}}};
      if (axis.find("Y_UP") != axis.npos) document_.upright.rows = {{{1, 0, 0, 0}, {0, 0, -1, 0}, {0, 1, 0, 0}}};
    } else {
      if (tag.name.starts_with("library_")) in_library_ = true;
      return false;
    }
    return true;
  }

  bool read_geometry(const XmlTag& tag) {
    if (tag.name == "geometry" && !tag.empty) {
      geometry_ = &document_.geometries[std::string(tag.attribute("id"))];
      geometry_->name = unescaped_xml(tag.attribute("name"));
      arrays_.clear();
      positions_.clear();
    } else if (tag.name == "/geometry") {
      close_geometry();
    } else if (!geometry_) {
      return false;
    } else if (tag.name == "source") {
      array_ = &arrays_[std::string(tag.attribute("id"))];
    } else if (tag.name == "/source") {
      array_ = nullptr;
    } else if (tag.name == "float_array" && array_) {
      if (!tag.empty) array_->numbers = numbers();
    } else if (tag.name == "accessor" && array_) {
      array_->stride = whole(tag, "stride", 1);
      array_->offset = whole(tag, "offset", 0);
    } else if (tag.name == "input" && !primitives_) {
      if (tag.attribute("semantic") == "POSITION") positions_ = without_mark(tag.attribute("source"));
    } else {
      return false;
    }
    return true;
  }

  void close_geometry() {
    if (!geometry_) return;
    const auto found = arrays_.find(positions_);
    if (found != arrays_.end()) {
      const auto& [numbers, stride, offset] = found->second;
      if (stride < 3) fail("its vertices have fewer than three numbers each");
      for (std::size_t i = offset; i + 3 <= numbers.size(); i += stride)
        geometry_->vertices.push_back({numbers[i], numbers[i + 1], numbers[i + 2]});
    }
    geometry_ = nullptr;
    primitives_ = nullptr;
  }

  bool read_primitives(const XmlTag& tag) {
    constexpr std::array<std::string_view, 5> kNames = {"triangles", "polylist", "polygons", "tristrips", "trifans"};
    if (!geometry_) return false;
    if (std::find(kNames.begin(), kNames.end(), tag.name) != kNames.end()) {
      if (tag.empty) return true;
      primitives_ = &geometry_->primitives.emplace_back();
      primitives_->kind = tag.name == "tristrips" ? Kind::Strips : tag.name == "trifans" ? Kind::Fans : Kind::Polygons;
      primitives_->material = tag.attribute("material");
      triangles_ = tag.name == "triangles";
      counted_ = tag.name == "polylist";
      vertex_offset_ = 0;
      inputs_ = 1;
    } else if (tag.name.starts_with('/') &&
               std::find(kNames.begin(), kNames.end(), tag.name.substr(1)) != kNames.end()) {
      primitives_ = nullptr;
    } else if (!primitives_) {
      return false;
    } else if (tag.name == "input") {
      const std::size_t offset = whole(tag, "offset", 0);
      if (offset >= kMostInputs) fail("an input lies " + std::to_string(offset) + " numbers behind the first");
      inputs_ = std::max(inputs_, offset + 1);
      if (tag.attribute("semantic") == "VERTEX") vertex_offset_ = offset;
    } else if (tag.name == "vcount" && counted_) {
      for (const double size : numbers()) primitives_->sizes.push_back(vertex_index(size));
    } else if (tag.name == "p" && !tag.empty) {
      add_corners();
    }
    return true;
  }

  void add_corners() {
    const std::vector<double> indices = numbers();
    const std::size_t count = indices.size() / inputs_;
    for (std::size_t i = 0; i < count; ++i)
      primitives_->corners.push_back(vertex_index(indices[i * inputs_ + vertex_offset_]));
    if (triangles_) primitives_->sizes.insert(primitives_->sizes.end(), count / 3, 3);
    if (!triangles_ && !counted_) primitives_->sizes.push_back(static_cast<std::uint32_t>(count));
  }

  bool read_node(const XmlTag& tag) {
    if (tag.name == "node") {
      open_node(tag);
    } else if (tag.name == "/node") {
      if (!open_.empty()) open_.pop_back();
    } else if (open_.empty()) {
      return false;
    } else if (tag.name == "matrix" || tag.name == "translate" || tag.name == "rotate" || tag.name == "scale") {
      if (!tag.empty) move(document_.nodes[open_.back()], tag.name);
    } else if (tag.name == "instance_geometry") {
      show(document_.nodes[open_.back()].geometries, tag);
    } else if (tag.name == "instance_controller") {
      show(document_.nodes[open_.back()].controllers, tag);
    } else if (tag.name == "instance_node") {
      show(document_.nodes[open_.back()].nodes, tag);
    } else if (tag.name == "instance_material" && shown_in_) {
      shown_in_->back().materials[std::string(tag.attribute("symbol"))] = without_mark(tag.attribute("target"));
    } else {
      return false;
    }
    return true;
  }

  void open_node(const XmlTag& tag) {
    const std::size_t index = document_.nodes.size();
    document_.nodes.emplace_back().name = unescaped_xml(tag.attribute("name"));
    shown_in_ = nullptr;
    document_.node_of_id.try_emplace(std::string(tag.attribute("id")), index);
    if (!open_.empty())
      document_.nodes[open_.back()].children.push_back(index);
    else if (scene_)
      scene_->push_back(index);
    if (!tag.empty) open_.push_back(index);
  }

  void move(Node& node, std::string_view how) {
    const std::vector<double> n = numbers();
    if (n.size() < (how == "matrix" ? 16U : how == "rotate" ? 4U : 3U)) fail("<" + std::string(how) + "> ends early");
    Affine step;
    if (how == "matrix") step = of_rows(n);
    if (how == "rotate") step = turn(n[0], n[1], n[2], n[3]);
    for (std::size_t i = 0; i < 3; ++i) {
      if (how == "translate") step.rows[i][3] = n[i];
      if (how == "scale") step.rows[i][i] = n[i];
    }
    node.place = node.place * step;
  }

  void show(std::vector<Shown>& list, const XmlTag& tag) {
    list.push_back({without_mark(tag.attribute("url")), {}});
    shown_in_ = &list;
  }

  void read_rest(const XmlTag& tag) {
    if (tag.name == "visual_scene" && !tag.empty)
      scene_ = &document_.scenes[std::string(tag.attribute("id"))];
    else if (tag.name == "/visual_scene")
      scene_ = nullptr;
    else if (tag.name == "instance_visual_scene")
      document_.scene = without_mark(tag.attribute("url"));
    else if (tag.name == "material")
      document_.materials[std::string(tag.attribute("id"))] = unescaped_xml(tag.attribute("name"));
    else if (tag.name == "controller")
      controller_ = &document_.controllers[std::string(tag.attribute("id"))];
    else if (tag.name == "/controller")
      controller_ = nullptr;
    else if ((tag.name == "skin" || tag.name == "morph") && controller_)
      controller_->geometry = without_mark(tag.attribute("source"));
    else if (tag.name == "bind_shape_matrix" && controller_ && !tag.empty)
      read_bind_shape();
  }

  void read_bind_shape() {
    const std::vector<double> n = numbers();
    if (n.size() < 16) fail("<bind_shape_matrix> ends early");
    controller_->bound = of_rows(n);
  }

  /// All that stand before the next tag.
  std::vector<double> numbers() const {
    const std::string_view text = text_before_tag(in_);
    std::vector<double> result;
    const char* at = text.data();
    const char* const end = at + text.size();
    const auto skip_blanks = [&] {
      while (at != end && static_cast<unsigned char>(*at) <= ' ') ++at;
    };
    for (skip_blanks(); at != end; skip_blanks()) {
      const char* const begin = at;
      double value = 0;
      if (!parse_number(at, end, value) || (at != end && static_cast<unsigned char>(*at) > ' ')) {
        const std::string_view rest(begin, static_cast<std::size_t>(end - begin));
        fail("expected a number, found " + in_quotes(rest.substr(0, std::min(rest.find_first_of(" \t\r\n"), kShown))));
      }
      result.push_back(value);
    }
    return result;
  }

  std::size_t whole(const XmlTag& tag, std::string_view key, std::size_t otherwise) const {
    const std::string_view text = tag.attribute(key);
    double value = 0;
    if (text.empty()) return otherwise;
    const std::uint32_t result = parse_real(text, value) ? vertex_index(value) : kNoVertex;
    if (result == kNoVertex) fail("'" + std::string(key) + "' is " + in_quotes(text.substr(0, 32)));
    return result;
  }

  [[noreturn]] void fail(const std::string& what) const { fail_at_line(name_, xml_line(in_), what); }

  static constexpr std::size_t kMostInputs = 64;
  static constexpr std::size_t kShown = 24;  // characters of what is no number

  std::string name_;
  TetScanner in_;
  Document document_;
  bool in_library_ = false;
  Geometry* geometry_ = nullptr;
  std::map<std::string, Array> arrays_;  ///< Of this geometry.
  Array* array_ = nullptr;
  std::string positions_;
  Primitives* primitives_ = nullptr;
  bool triangles_ = false, counted_ = false;
  std::size_t vertex_offset_ = 0, inputs_ = 1;
  std::vector<std::size_t> open_;  ///< Nodes within nodes.
  std::vector<Shown>* shown_in_ = nullptr;
  std::vector<std::size_t>* scene_ = nullptr;
  Controller* controller_ = nullptr;
};

}  // namespace

Document read_document(const Source& source) {
  return Reader(source).read();
}

}  // namespace tetsoup::readers::collada
